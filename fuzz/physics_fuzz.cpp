// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: text layers (layers_of_input.h) that compose to a stage with physics. Reading gives finite
// masses and indices that lie inside of their lists, or leaves things out.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/layers_of_input.h"
#include "tenon/physics/read_physics.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tenon::fuzz::LayersOfInput layers(
      std::string_view(reinterpret_cast<const char*>(data), size));
  if (layers.root() == nullptr) {
    return 0;
  }
  const auto stage = layers.open_stage();
  if (!stage) {
    return 0;
  }
  tenon::Diagnostics diagnostics;
  tenon::physics::ReadOptions options;
  options.mesh_tools = tenon::scene::MeshTools{};  // libraries of others have fuzzers of their own
  const tenon::scene::PhysicsScene scene =
      tenon::physics::read_physics(*stage, options, diagnostics);
  for (const auto& body : scene.bodies) {
    if (!std::isfinite(body.mass)) {
      std::abort();
    }
  }
  return 0;
}
