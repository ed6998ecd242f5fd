// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "tenon/engines/physx/physx_simulation.h"
#include "tenon/engines/test_scene.h"

/// For the tests of this folder only.
namespace tenon::engines::physx {

inline void run(PhysxSimulation& simulation, double seconds) {
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

}  // namespace tenon::engines::physx
