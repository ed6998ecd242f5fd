// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// make_scenes FOLDER [--tiny]: writes the inputs of the benchmarks as text layers. With --tiny they
// have the same shape and a hundredth of the size.
#include <cstring>
#include <filesystem>

#include "bench/layer_builder.h"
#include "bench/measure.h"
#include "bench/scenes.h"
#include "tenon/formats/save_layer.h"

namespace tenon::bench {
namespace {

constexpr std::uint64_t kSeed = 20260711;

void write(const layer::Layer& layer, const std::filesystem::path& path) {
  if (auto written = formats::save_layer(layer, path.string()); !written) {
    fail(written.error().to_string());
  }
}

void make_scenes(const std::filesystem::path& folder, std::size_t divisor) {
  std::filesystem::create_directories(folder);
  write(make_prim_scene(20000 / divisor, kSeed), folder / "prims.usda");
  write(make_physics_scene(10000 / divisor, kSeed), folder / "physics.usda");
  write(make_pile_scene(200, kSeed), folder / "pile.usda");
  write(make_part_asset(), folder / "part.usda");
  write(make_fleet_scene(1000 / divisor, "./part.usda", false), folder / "fleet.usda");
  write(make_fleet_scene(1000 / divisor, "./part.usda", true), folder / "instances.usda");
  LayerBuilder one("one");
  one.prim(Path::absolute_root(), "World", "Xform");
  write(one.finish(), folder / "one_prim.usda");
  write(make_mesh_scene(divisor == 1 ? 1000 : 20), folder / "mesh.usda");
}

}  // namespace
}  // namespace tenon::bench

int main(int count, char** values) {
  const bool tiny = count == 3 && std::strcmp(values[2], "--tiny") == 0;
  if (count != 2 && !tiny) {
    tenon::bench::fail("usage: make_scenes FOLDER [--tiny]");
  }
  tenon::bench::make_scenes(values[1], tiny ? 100 : 1);
  return 0;
}
