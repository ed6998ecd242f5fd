// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The example hand under control from outside, as a program does it.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/make_simulation.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

using engines::World;
using scene::Index;

scene::PhysicsScene hand(const std::string& file) {
  Diagnostics diagnostics;
  const auto stage = tenon::open(std::string(TENON_SOURCE_DIR) + "/examples/inspire_hand/" + file,
                                 {}, diagnostics);
  EXPECT_TRUE(stage.has_value());
  return physics::read_physics(*stage, {}, diagnostics);
}

World world_of(const scene::PhysicsScene& scene, const engines::SimulationOptions& options) {
  Diagnostics diagnostics;
  auto made = make_world("mujoco", scene, options, diagnostics);
  EXPECT_TRUE(made.has_value());
  return *std::move(made);
}

scene::PhysicsScene without_drives(scene::PhysicsScene scene) {
  for (scene::Joint& joint : scene.joints) {
    joint.drives.clear();
  }
  return scene;
}

double target_of(Index joint, double time) { return 0.3 + 0.2 * std::sin(3 * time + joint); }

// A drive is k (x* - q) + d (v* - v) within its largest force. Worked out outside of the engine, of
// what can be read at the beginning of each step, it moves the hand as the drive itself does that
// takes its force then.
TEST(SteeredHand, APdLoopOutsideEqualsTheDrivesOfTheAsset) {
  const scene::PhysicsScene driven_scene = hand("inspire_hand.usda");
  const scene::PhysicsScene looped_scene = without_drives(driven_scene);
  const engines::SimulationOptions options{.time_step = 1e-4,
                                           .drives = engines::DriveTerms::Explicit};
  World driven = world_of(driven_scene, options);
  World looped = world_of(looped_scene, options);
  double apart = 0;
  double moved = 0;
  std::size_t drives = 0;
  for (int step = 0; step < 5000; ++step) {
    for (Index j = 0; j < driven_scene.joints.size(); ++j) {
      for (Index d = 0; d < driven_scene.joints[j].drives.size(); ++d) {
        const scene::Drive& drive = driven_scene.joints[j].drives[d];
        ASSERT_FALSE(drive.acceleration);
        const double target = target_of(j, driven.time());
        ASSERT_TRUE(driven.set_drive_target(j, d, {target, 0}).has_value());
        const engines::JointState state = looped.joint_state(j);
        const double effort =
            drive.stiffness * (target - state.position[0]) - drive.damping * state.velocity[0];
        const std::vector<double> efforts{std::clamp(effort, -drive.max_force, drive.max_force)};
        ASSERT_TRUE(looped.set_joint_efforts(j, efforts).has_value());
        ++drives;
      }
    }
    ASSERT_TRUE(driven.step().has_value());
    ASSERT_TRUE(looped.step().has_value());
    for (Index j = 0; j < driven_scene.joints.size(); ++j) {
      const engines::JointState a = driven.joint_state(j);
      const engines::JointState b = looped.joint_state(j);
      for (std::size_t i = 0; i < a.position.size(); ++i) {
        apart = std::max(apart, std::abs(a.position[i] - b.position[i]));
        moved = std::max(moved, std::abs(a.position[i]));
      }
    }
  }
  EXPECT_LT(apart, 1e-9);
  EXPECT_GT(moved, 0.1);
  EXPECT_GE(drives, 5000u);
  RecordProperty("apart", std::to_string(apart));
}

TEST(SteeredHand, AGraspContinuesBitForBitFromASavedState) {
  const scene::PhysicsScene scene = hand("grasp.usda");
  World one = world_of(scene, {});
  ASSERT_TRUE(one.step(300).has_value());
  const Result<std::string> state = one.save_state();
  ASSERT_TRUE(state.has_value());
  World other = world_of(scene, {});
  const Result<void> restored = other.restore_state(*state);
  ASSERT_TRUE(restored.has_value()) << restored.error().to_string();
  ASSERT_TRUE(one.step(300).has_value());
  ASSERT_TRUE(other.step(300).has_value());
  EXPECT_EQ(*one.save_state(), *other.save_state());
}

TEST(SteeredHand, EnvironmentsComeOutTheSameForAnyNumberOfThreads) {
  const scene::PhysicsScene scene = hand("grasp.usda");
  std::vector<std::string> states;
  for (const std::size_t threads : {1u, 3u}) {
    Diagnostics diagnostics;
    auto all = make_environments("mujoco", scene, {.count = 4, .threads = threads}, diagnostics);
    ASSERT_TRUE(all.has_value());
    for (std::size_t i = 0; i < all->size(); ++i) {
      ASSERT_TRUE((*all)[i]
                      .set_parameter({engines::Parameter::ColliderFriction, 0, 0},
                                     0.2 + 0.1 * static_cast<double>(i))
                      .has_value());
    }
    EXPECT_EQ(all->step(200), 0u);
    std::string together;
    for (std::size_t i = 0; i < all->size(); ++i) {
      together += *(*all)[i].save_state();
    }
    states.push_back(std::move(together));
  }
  EXPECT_EQ(states[0], states[1]);
}

}  // namespace
}  // namespace tenon
