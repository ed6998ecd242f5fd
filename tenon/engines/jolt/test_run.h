// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>

#include "tenon/engines/jolt/jolt_engine.h"
#include "tenon/engines/test_scene.h"

/// Runs of scenes made by hand, for the tests of the Jolt adapter.
namespace tenon::engines::jolt {

inline std::unique_ptr<Simulation> make_run(const scene::PhysicsScene& scene,
                                            SimulationOptions options = {}) {
  options.time_step = options.time_step > 0 ? options.time_step : 0.001;
  Diagnostics diagnostics;
  auto made = make_simulation(scene, options, diagnostics);
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().to_string());
  return made ? *std::move(made) : nullptr;
}

inline void run_for(Simulation& simulation, double seconds) {
  const long steps = std::lround(seconds / simulation.time_step());
  for (long i = 0; i < steps; ++i) {
    const Result<void> done = simulation.step();
    ASSERT_TRUE(done.has_value()) << done.error().to_string();
  }
}

/// A wheel of 0.5 kg m^2 about z that hangs in the world on a joint; no gravity.
inline TestScene wheel() {
  TestScene scene(0);
  const scene::Index body = scene.add_body("wheel", {{0, 0, 1}}, 2, {{0.3, 0.3, 0.5}});
  scene.add_joint("axle", scene::JointKind::Revolute, std::nullopt, body).frame0.position = {
      {0, 0, 1}};
  return scene;
}

}  // namespace tenon::engines::jolt
