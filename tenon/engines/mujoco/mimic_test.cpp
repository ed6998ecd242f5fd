// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::Dof;
using scene::JointKind;

constexpr double kHalfDegree = 0.5 * M_PI / 180;

// A finger of light links (5 g, 1e-7 kg m^2, 2 cm long) hanging sideways on a fixed palm.
TestScene finger(int links) {
  TestScene scene;
  std::optional<scene::Index> parent;
  for (int i = 0; i < links; ++i) {
    const auto link =
        scene.add_body("Link" + std::to_string(i), {{0.02 * i, 0, 0}}, 0.005, {{1e-7, 1e-7, 1e-7}});
    scene.bodies[link].center_of_mass = {{0.01, 0, 0}};
    auto& joint =
        scene.add_joint("Joint" + std::to_string(i), JointKind::Revolute, parent, link, Axis::Y);
    joint.frame0.position = {{i == 0 ? 0.0 : 0.02, 0, 0}};
    joint.lower = -0.2;
    joint.upper = 1.2;
    parent = link;
  }
  return scene;
}

void follow(TestScene& scene, scene::Index follower, scene::Index leader, double multiplier,
            double offset = 0) {
  scene::Mimic mimic;
  mimic.schema = "NewtonMimicAPI";
  mimic.dof = scene.joints[follower].dof();
  mimic.leader = leader;
  mimic.leader_dof = scene.joints[leader].dof();
  mimic.multiplier = multiplier;
  mimic.offset = offset;
  scene.joints[follower].mimics.push_back(mimic);
}

TEST(Mimic, LimpChainOfFollowersKeepsItsLaw) {
  TestScene scene = finger(3);
  follow(scene, 1, 0, 0.6);
  follow(scene, 2, 1, 0.9);  // a follower of a follower
  auto sim = simulation(scene);
  for (int i = 0; i < 2500; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    const double leader = sim->joint_state(0).position[0];
    const double first = sim->joint_state(1).position[0];
    const double second = sim->joint_state(2).position[0];
    ASSERT_NEAR(first, 0.6 * leader, kHalfDegree) << sim->time();
    ASSERT_NEAR(second, 0.9 * first, kHalfDegree) << sim->time();
  }
}

TEST(Mimic, DrivenChainClosesAndOpens) {
  TestScene scene = finger(3);
  follow(scene, 1, 0, 0.7508, 0.001745);
  follow(scene, 2, 0, 0.5);
  scene::Drive d = drive(Dof::RotY, 0.5, 0.02);
  d.max_force = 1;
  scene.joints[0].drives.push_back(d);
  scene.scalar_tracks.push_back(
      {scene::Animated::DriveTargetPosition, 0, 0, {0, 1, 2}, {0, 1.0, 0.1}, false});
  auto sim = simulation(scene);
  for (int i = 0; i < 1500; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    const double leader = sim->joint_state(0).position[0];
    // At the start the offset is not met yet; from then on within half a degree.
    ASSERT_NEAR(sim->joint_state(1).position[0], 0.7508 * leader + 0.001745, kHalfDegree);
    ASSERT_NEAR(sim->joint_state(2).position[0], 0.5 * leader, kHalfDegree);
  }
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.1, 0.05);
}

TEST(Mimic, FollowerAtItsLimitStopsTheLeader) {
  TestScene scene = finger(2);
  scene.joints[1].upper = 0.3;
  follow(scene, 1, 0, 1);
  auto sim = simulation(scene);
  run(*sim, 3);
  EXPECT_NEAR(sim->joint_state(1).position[0], 0.3, 2 * kHalfDegree);
  EXPECT_NEAR(sim->joint_state(0).position[0], sim->joint_state(1).position[0], kHalfDegree);
}

TEST(Mimic, PolynomialLaw) {
  TestScene scene = finger(2);
  follow(scene, 1, 0, 0.2, 0.05);
  scene.joints[1].mimics[0].higher = {0.3, 0, 0};
  auto sim = simulation(scene);
  run(*sim, 3);
  const double x = sim->joint_state(0).position[0];
  EXPECT_NEAR(sim->joint_state(1).position[0], 0.05 + 0.2 * x + 0.3 * x * x, kHalfDegree);
}

TEST(Mimic, CompliantMimicStaysNearItsLaw) {
  TestScene scene = finger(2);
  follow(scene, 1, 0, 0.75);
  scene.joints[1].mimics[0].natural_frequency = 25;
  scene.joints[1].mimics[0].damping_ratio = 0.5;
  auto sim = simulation(scene);
  run(*sim, 5);
  EXPECT_NEAR(sim->joint_state(1).position[0], 0.75 * sim->joint_state(0).position[0], kHalfDegree);
}

// A ball-like wrist of light links at the tip of a finger of one joint, both without gravity.
TestScene wrist(const std::vector<Dof>& locked) {
  TestScene scene(0);
  const auto arm = scene.add_body("Arm", {{0, 0, 0}}, 0.01, {{1e-6, 1e-6, 1e-6}});
  const auto hand = scene.add_body("Hand", {{0.02, 0, 0}}, 0.01, {{1e-6, 1e-6, 1e-6}});
  scene.add_joint("Arm", JointKind::Revolute, std::nullopt, arm, Axis::Y);
  scene.joints[0].drives.push_back(drive(Dof::RotY, 0.5, 0.02));
  scene.joints[0].drives[0].target_position = 0.4;
  auto& ball = scene.add_joint("Wrist", JointKind::D6, arm, hand);
  ball.frame0.position = {{0.02, 0, 0}};
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ}) {
    ball.limits.push_back({dof, 1, -1});
  }
  for (const Dof dof : locked) {
    ball.limits.push_back({dof, 1, -1});
  }
  return scene;
}

void follow_along(TestScene& scene, scene::Index follower, Dof dof, scene::Index leader,
                  Dof leader_dof, double multiplier, double offset = 0) {
  scene::Mimic mimic;
  mimic.schema = "PhysxMimicJointAPI";
  mimic.dof = dof;
  mimic.leader = leader;
  mimic.leader_dof = leader_dof;
  mimic.multiplier = multiplier;
  mimic.offset = offset;
  scene.joints[follower].mimics.push_back(mimic);
}

TEST(Mimic, TwoAxesOfOneJointFollowEachByItsLaw) {
  for (const auto& locked : {std::vector<Dof>{Dof::RotX}, std::vector<Dof>{}}) {
    TestScene scene = wrist(locked);
    follow_along(scene, 1, Dof::RotY, 0, Dof::RotY, 0.5);
    follow_along(scene, 1, Dof::RotZ, 0, Dof::RotY, -0.25, 0.1);
    auto sim = simulation(scene);
    EXPECT_TRUE(sim->not_mapped().empty());
    run(*sim, 2);
    const double leader = sim->joint_state(0).position[0];
    EXPECT_NEAR(leader, 0.4, 0.05);
    const std::vector<double> turns = sim->joint_state(1).position;
    ASSERT_EQ(turns.size(), 3 - locked.size());
    EXPECT_NEAR(turns[turns.size() - 2], 0.5 * leader, kHalfDegree);
    EXPECT_NEAR(turns.back(), 0.1 - 0.25 * leader, kHalfDegree);
  }
}

TEST(Mimic, OneAxisOfABallLeads) {
  TestScene scene = wrist({});
  follow_along(scene, 0, Dof::RotY, 1, Dof::RotX, 0.5);
  auto sim = simulation(scene);
  EXPECT_TRUE(sim->not_mapped().empty());
  run(*sim, 2);
  ASSERT_EQ(sim->joint_state(1).position.size(), 3u);
  EXPECT_GT(sim->joint_state(0).position[0], 0.1);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.5 * sim->joint_state(1).position[0], kHalfDegree);
}

TEST(Mimic, AnAxisThatIsLockedFollowsNone) {
  TestScene scene = wrist({Dof::RotX});
  follow_along(scene, 1, Dof::RotX, 0, Dof::RotY, 0.5);
  follow_along(scene, 1, Dof::RotY, 0, Dof::RotY, 0.5);
  auto sim = simulation(scene);
  EXPECT_EQ(sim->not_mapped().size(), 1u);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Wrist", "PhysxMimicJointAPI:rotX"));
}

TEST(Mimic, WithoutACoordinateItIsReported) {
  TestScene scene = finger(2);
  scene.joints[0].lower = 1;
  scene.joints[0].upper = -1;
  follow(scene, 1, 0, 1);
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Joint1", "NewtonMimicAPI"));
}

}  // namespace
}  // namespace tenon::engines::mujoco
