// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Two engines that have nothing in common: MuJoCo and free bodies in closed form.
#include <gtest/gtest.h>

#include "tenon/engines/mujoco/mujoco_engine.h"
#include "tenon/engines/test_free_bodies.h"

namespace tenon::engines {
namespace {

struct MujocoEngine {
  static constexpr double kRounding = 0;
  static Engine engine() {
    return {&mujoco::info, &mujoco::make_simulation, &mujoco::make_simulations};
  }
};
struct FreeBodiesEngine {
  static constexpr double kRounding = 0;
  static Engine engine() { return free_bodies_engine(); }
};
using TestedEngines = testing::Types<MujocoEngine, FreeBodiesEngine>;

}  // namespace
}  // namespace tenon::engines

#include "tenon/engines/test_interface.h"
