// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/test_scene.h"
#include "tenon/scene/physics_scene.h"

/// Neutral scenes made by hand, for the tests of this folder only.
namespace tenon::engines::mujoco {

/// A simulation that is known to be possible; a failed test and nullptr otherwise.
inline std::unique_ptr<MujocoSimulation> simulation(const scene::PhysicsScene& scene,
                                                    double time_step = 0.002,
                                                    Diagnostics* findings = nullptr) {
  Diagnostics own;
  auto made = MujocoSimulation::make(scene, {.time_step = time_step},
                                     findings == nullptr ? own : *findings);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  return made.has_value() ? *std::move(made) : nullptr;
}

inline void run(MujocoSimulation& simulation, double seconds) {
  const auto steps = static_cast<int>(std::lround(seconds / simulation.time_step()));
  for (int i = 0; i < steps; ++i) {
    const Result<void> result = simulation.step();
    ASSERT_TRUE(result.has_value()) << result.error().to_string();
  }
}

inline bool mentions(const std::vector<NotMapped>& list, const std::string& prim,
                     const std::string& property) {
  for (const NotMapped& entry : list) {
    if (entry.prim.str() == prim && entry.property == property) {
      return true;
    }
  }
  return false;
}

}  // namespace tenon::engines::mujoco
