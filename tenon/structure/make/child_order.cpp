// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/make/child_order.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "tenon/layer/fields.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;
using layer::Layer;

}  // namespace

void put_robot_order_first(Layer& content) {
  std::set<Path> named;
  for (const Path& prim : prims_below(content)) {
    if (has_opinion_of(content, prim, Role::Robot)) {
      for (Path at = prim; at.is_prim() && named.insert(at).second; at = at.parent()) {
      }
    }
  }
  for (const Path& prim : named) {
    std::vector<Token> names = content.children(prim, fields::primChildren);
    if (!names.empty()) {
      std::stable_partition(names.begin(), names.end(),
                            [&](Token name) { return named.contains(prim.child(name)); });
      make_prim(content, prim).set(fields::primChildren, std::move(names));
    }
  }
}

void order_like(Layer& content, const Layer& like) {
  for (const Path& prim : prims_below(content)) {
    const std::vector<Token> old = content.children(prim, fields::primChildren);
    if (old.size() < 2 || !like.has(prim)) {
      continue;
    }
    std::vector<Token> names;
    const std::set<Token> there(old.begin(), old.end());
    for (const Token name : like.children(prim, fields::primChildren)) {
      if (there.contains(name)) {
        names.push_back(name);
      }
    }
    const std::set<Token> first(names.begin(), names.end());
    std::copy_if(old.begin(), old.end(), std::back_inserter(names),
                 [&](Token name) { return !first.contains(name); });
    if (names != old) {
      make_prim(content, prim).set(fields::primChildren, std::move(names));
    }
  }
}

}  // namespace tenon::structure
