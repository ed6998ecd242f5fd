// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Prints the membership of every collection of the stages given, for membership.py: one line per
// fact, words separated by blanks.
//   file PATH
//   members PRIM NAME PATH...      what a traversal meets
//   contains PRIM NAME PATH...     which of all prims and properties belong, proxies included
#include <cstdio>
#include <string>
#include <vector>

#include "tenon/open_stage.h"
#include "tenon/stage/collections/collection.h"

namespace {

using tenon::Path;
using tenon::stage::Collection;
using tenon::stage::Prim;

std::vector<Prim> all_prims(const tenon::stage::Stage& stage) {
  std::vector<Prim> result;
  std::vector<Prim> pending = stage.pseudo_root().children();
  while (!pending.empty()) {
    const Prim prim = pending.back();
    pending.pop_back();
    result.push_back(prim);
    const std::vector<Prim> children = prim.children();
    pending.insert(pending.end(), children.begin(), children.end());
  }
  return result;
}

void print(const char* what, const Prim& prim, const std::string& name,
           const std::vector<Path>& paths) {
  std::printf("%s %s %s", what, prim.path().str().c_str(), name.c_str());
  for (const Path path : paths) {
    std::printf(" %s", path.str().c_str());
  }
  std::printf("\n");
}

void print_collections(const tenon::stage::Stage& stage) {
  const std::vector<Prim> prims = all_prims(stage);
  for (const Prim& prim : prims) {
    for (const tenon::Token name : prim.api_instances("CollectionAPI")) {
      const Collection collection = Collection::read(prim, name);
      print("members", prim, name.str(), collection.members(stage));
      std::vector<Path> contained;
      for (const Prim& other : prims) {
        if (collection.contains(other.path())) {
          contained.push_back(other.path());
        }
        for (const tenon::Token property : other.property_names()) {
          if (collection.contains(other.path().property(property))) {
            contained.push_back(other.path().property(property));
          }
        }
      }
      print("contains", prim, name.str(), contained);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  int result = 0;
  for (int i = 1; i < argc; ++i) {
    tenon::Diagnostics diagnostics;
    const auto stage = tenon::open(argv[i], {}, diagnostics);
    std::printf("file %s\n", argv[i]);
    if (stage) {
      print_collections(*stage);
    } else {
      result = 1;
    }
  }
  return result;
}
