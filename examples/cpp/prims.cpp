// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Opens an asset, walks its prims, reads a value, and changes it in the file that owns it.
//   prims hand.usda     (a copy: its files are written to)
#include <cstdio>
#include <filesystem>
#include <vector>

#include "example.h"

#include "tenon/tenon.h"

namespace {

/// This prim and all below it.
std::vector<tenon::stage::Prim> walk(const tenon::stage::Prim& top) {
  std::vector<tenon::stage::Prim> open{top};
  std::vector<tenon::stage::Prim> found;
  while (!open.empty()) {
    const tenon::stage::Prim prim = open.back();
    open.pop_back();
    found.push_back(prim);
    const auto children = prim.children();
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return found;
}

/// Masses that the asset names [kg], and the first attribute that does.
double authored_mass(const tenon::stage::Stage& stage, tenon::Path& first) {
  double sum = 0;
  for (const tenon::stage::Prim& prim : walk(stage.pseudo_root())) {
    const tenon::stage::Attribute mass = prim.attribute("physics:mass");
    if (mass.has_authored_value()) {
      first = first.empty() ? mass.path() : first;
      sum += static_cast<double>(mass.get_as<float>().value_or(0));
    }
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: prims ASSET\n");
    return 2;
  }
  tenon::Path attribute;
  {
    const tenon::stage::Stage stage = or_exit(tenon::open(argv[1]));
    std::printf("prims: %zu\n", walk(stage.pseudo_root()).size());
    std::printf("default prim: %s\n", stage.default_prim().path().str().c_str());
    std::printf("authored mass: %.6f kg\n", authored_mass(stage, attribute));
    tell(stage.diagnostics());
  }

  tenon::Diagnostics diagnostics;
  const tenon::AssetEdit edit{.object = attribute, .value = "0.5"};
  const tenon::EditedAsset edited = or_exit(tenon::edit_asset(argv[1], {edit}, {}, diagnostics));
  for (const tenon::EditedPlace& place : edited.places) {
    const std::string file = std::filesystem::path(place.file).filename().string();
    std::printf("%s: %s -> %s in %s\n", attribute.str().c_str(), place.before.c_str(),
                place.after.c_str(), file.c_str());
  }
  or_exit(tenon::write_files(edited.files));

  const tenon::stage::Stage stage = or_exit(tenon::open(argv[1]));
  tenon::Path same;
  std::printf("authored mass now: %.6f kg\n", authored_mass(stage, same));
  tell(diagnostics);
}
