// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::Dof;
using scene::JointKind;

// A bob 1 m below a hinge about the world's y at the origin.
TestScene pendulum(double start_angle) {
  TestScene scene;
  const auto bob = scene.add_body("Bob", {}, 1, {{1e-6, 1e-6, 1e-6}});
  auto& joint = scene.add_joint("Pivot", JointKind::Revolute, {}, bob, Axis::Y);
  joint.frame1.position = {{0, 0, 1}};
  scene.bodies[bob].pose.orientation = rotation_about({{0, 1, 0}}, start_angle);
  scene.bodies[bob].pose.position = rotate(scene.bodies[bob].pose.orientation, {{0, 0, -1}});
  return scene;
}

TEST(Joints, PendulumHasItsPeriod) {
  TestScene scene = pendulum(0.05);
  auto sim = simulation(scene, 0.0005);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.05, 1e-9);
  // Small swing: T = 2 pi sqrt(L / g) (1 + a^2 / 16).
  const double period = 2 * M_PI * std::sqrt(1 / kG) * (1 + 0.05 * 0.05 / 16);
  run(*sim, period);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.05, 1e-4);
  run(*sim, period / 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], -0.05, 1e-4);
}

TEST(Joints, ReversedJointIsTheMirroredCoordinate) {
  TestScene forward = pendulum(0.3);
  TestScene backward = pendulum(0.3);
  std::swap(backward.joints[0].body0, backward.joints[0].body1);
  std::swap(backward.joints[0].frame0, backward.joints[0].frame1);
  auto a = simulation(forward);
  auto b = simulation(backward);
  // q is the turn of body1 relative to body0: exchanged sides change its sign, not the motion.
  EXPECT_NEAR(b->joint_state(0).position[0], -0.3, 1e-9);
  run(*a, 1);
  run(*b, 1);
  EXPECT_NEAR(a->joint_state(0).position[0], -b->joint_state(0).position[0], 1e-9);
  EXPECT_NEAR(a->joint_state(0).velocity[0], -b->joint_state(0).velocity[0], 1e-9);
  EXPECT_NEAR(length(a->body_state(0).pose.position - b->body_state(0).pose.position), 0, 1e-9);
}

TEST(Joints, PrismaticJointRestsOnItsLimit) {
  TestScene scene;
  const auto slider = scene.add_body("Slider", {});
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, slider, Axis::Z);
  joint.lower = -0.3;
  auto sim = simulation(scene);
  run(*sim, 2);
  // E-110: at rest on the lower limit; one-sided limits leave the other side open.
  EXPECT_NEAR(sim->joint_state(0).position[0], -0.3, 2e-4);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 0, 1e-4);
}

TEST(Joints, RevoluteJointTurnsSeveralTimesUpToItsLimit) {
  TestScene scene(0);
  const auto wheel = scene.add_body("Wheel", {});
  auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
  joint.lower = -20;
  joint.upper = 17;
  joint.initial_velocity = 10;
  auto sim = simulation(scene);
  run(*sim, 1.5);
  // 15 rad after 1.5 s: more than two turns, unwrapped.
  EXPECT_NEAR(sim->joint_state(0).position[0], 15, 1e-6);
  run(*sim, 1.5);
  EXPECT_LT(sim->joint_state(0).position[0], 17.001);
  EXPECT_LE(std::fabs(sim->joint_state(0).velocity[0]), 10.0);
}

TEST(Joints, LimitsBringBackGentlyWhatStartsBeyondThem) {
  TestScene scene(0);
  const auto wheel = scene.add_body("Wheel", {});
  auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
  joint.lower = 0.5;
  joint.upper = 1;
  for (const double time_step : {0.002, 0.0005, 0.01}) {
    auto sim = simulation(scene, time_step);
    double fastest = 0;
    for (double t = 0; t < 0.5; t += time_step) {
      ASSERT_TRUE(sim->step());
      fastest = std::max(fastest, sim->joint_state(0).velocity[0]);
    }
    // Critically damped from x: at most x / (e T). With more damping less than half of it.
    const double time_constant = std::max(0.01, 5 * time_step);
    EXPECT_LT(fastest, 0.6 * 0.5 / (M_E * time_constant)) << time_step;
    EXPECT_GT(fastest, 0.3 * 0.5 / (M_E * time_constant)) << time_step;
    EXPECT_GT(sim->joint_state(0).position[0], 0.499) << time_step;
  }
}

// A limit pushes alone: critically damped it would throw the wheel back with 0.14 of its speed.
TEST(Joints, LimitsTakeTheSpeedOfWhatHitsThem) {
  for (const double time_step : {0.002, 0.001, 0.0005}) {
    TestScene scene(0);
    const auto wheel = scene.add_body("Wheel", {});
    auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
    joint.upper = 0.1;
    joint.initial_velocity = 2;
    auto sim = simulation(scene, time_step);
    for (double t = 0; t < 0.5; t += time_step) {
      ASSERT_TRUE(sim->step());
    }
    EXPECT_LT(std::fabs(sim->joint_state(0).velocity[0]), 0.05 * 2) << time_step;
  }
}

TEST(Joints, LimitsGiveWayLittleUnderALoad) {
  for (const double load : {1.0, 100.0, 10000.0}) {  // [rad/s^2]
    TestScene scene(0);
    const auto wheel = scene.add_body("Wheel", {});
    auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
    joint.upper = 0.2;
    scene.bodies[wheel].pose.orientation = rotation_about({{0, 0, 1}}, 0.2);
    auto sim = simulation(scene);
    ASSERT_TRUE(sim->set_joint_efforts(0, std::vector<double>{0.1 * load}));
    run(*sim, 1);
    // a (1 - d) T^2 with d from 0.99 to 0.999.
    EXPECT_GT(sim->joint_state(0).position[0] - 0.2, load * 0.5e-3 * 1e-4) << load;
    EXPECT_LT(sim->joint_state(0).position[0] - 0.2, load * 1.1e-2 * 1e-4) << load;
  }
}

TEST(Joints, LimitsAreAsSoftAsTheAssetSays) {
  TestScene scene;
  const auto wheel = scene.add_body("Wheel", {});
  auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
  joint.upper = 1;
  const auto numbers = [&] {
    const auto sim = simulation(scene);
    const mjModel& m = sim->engine_model();
    return std::array{m.jnt_solref[0], m.jnt_solref[1], m.jnt_solimp[0], m.jnt_solimp[1]};
  };
  EXPECT_EQ(numbers(), (std::array{0.0044, 0.01 / 0.0044, 0.99, 0.999}));
  joint.parts.mujoco.solref_limit = {0.05, 0.8};
  EXPECT_EQ(numbers(), (std::array{0.05, 0.8, 0.9, 0.95}));  // MuJoCo's default for the other
  joint.parts.mujoco.solimp_limit = {0.7, 0.8, 0.002, 0.5, 2};
  EXPECT_EQ(numbers(), (std::array{0.05, 0.8, 0.7, 0.8}));
  joint.parts.mujoco.solref_limit = {};
  EXPECT_EQ(numbers(), (std::array{0.02, 1.0, 0.7, 0.8}));
}

struct LockCase {
  const char* name;
  double lower;
  double upper;
  double expected;
};

TEST(Joints, LockedLimitsHoldTheBody) {
  for (const LockCase& c : {LockCase{"crossed", 1, -1, 0.0}, LockCase{"equal", 0.4, 0.4, 0.4}}) {
    TestScene scene = pendulum(c.expected);
    scene.joints[0].lower = c.lower;
    scene.joints[0].upper = c.upper;
    auto sim = simulation(scene);
    run(*sim, 1);
    EXPECT_EQ(sim->dof_count(), 0u) << c.name;
    EXPECT_NEAR(sim->body_state(0).pose.position[0], -std::sin(c.expected), 1e-9) << c.name;
  }
}

TEST(Joints, InitialVelocityOfTheBodyBecomesThatOfTheJoint) {
  TestScene scene(0);
  const auto wheel = scene.add_body("Wheel", {});
  scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::X);
  scene.bodies[wheel].angular_velocity = {{3, 0, 0}};
  auto sim = simulation(scene);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 3, 1e-9);
}

TEST(Joints, JointStateOverridesThePose) {
  TestScene scene = pendulum(0);
  scene.joints[0].initial_position = 0.5;
  auto sim = simulation(scene);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.5, 1e-12);
  EXPECT_NEAR(sim->body_state(0).pose.position[0], -std::sin(0.5), 1e-9);
}

TEST(Joints, FramesApartAreReportedAndBroughtTogether) {
  TestScene scene = pendulum(0);
  scene.bodies[0].pose.position[0] += 0.01;
  Diagnostics findings;
  auto sim = simulation(scene, 0.002, &findings);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.items()[0].rule, "joint.frames-apart");
  EXPECT_NEAR(sim->body_state(0).pose.position[0], 0, 1e-9);
  simulation(scene, 0.002, &findings);
  EXPECT_EQ(findings.size(), 1u) << "once is enough";
}

TEST(Joints, FixedJointsCarryBodiesAlong) {
  TestScene scene;
  const auto base = scene.add_body("Base", {{0, 0, 1}});
  const auto top = scene.add_body("Top", {{0, 0, 2}});
  scene.add_joint("Ground", JointKind::Fixed, {}, base).frame0.position = {{0, 0, 1}};
  scene.add_joint("Weld", JointKind::Fixed, base, top).frame0.position = {{0, 0, 1}};
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_EQ(sim->dof_count(), 0u);
  EXPECT_NEAR(sim->body_state(top).pose.position[2], 2, 1e-12);
}

TEST(Joints, SphericalJointSwingsFreely) {
  TestScene scene;
  const auto bob = scene.add_body("Bob", {}, 1, {{1e-4, 1e-4, 1e-4}});
  auto& joint = scene.add_joint("Ball", JointKind::Spherical, {}, bob, Axis::Z);
  joint.frame1.position = {{0, 0, 1}};
  const Quatd tilt = rotation_about(normalized(Vec3d{{1, 1, 0}}), 0.1);
  scene.bodies[bob].pose = {rotate(tilt, {{0, 0, -1}}), tilt};
  auto sim = simulation(scene, 0.0005);
  EXPECT_EQ(sim->dof_count(), 3u);
  const JointState start = sim->joint_state(0);
  EXPECT_NEAR(start.position[0], 0.1 / std::sqrt(2), 1e-9);
  // Physical pendulum: T = 2 pi sqrt((m L^2 + I) / (m g L)) (1 + a^2 / 16).
  run(*sim, 2 * M_PI * std::sqrt(1.0001 / kG) * (1 + 0.01 / 16) / 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], -start.position[0], 2e-3);
  EXPECT_NEAR(length(sim->body_state(bob).pose.position), 1, 1e-9);
}

// A rod on a spherical joint with cone axis Z falls over to the cone's edge, twist stays free.
TEST(Joints, CircularConeBoundsTheTiltAndNotTheTwist) {
  TestScene scene;
  const auto rod = scene.add_body("Rod", {}, 1, {{0.01, 0.01, 0.01}});
  auto& joint = scene.add_joint("Cone", JointKind::Spherical, {}, rod, Axis::Z);
  joint.frame1.position = {{0, 0, -0.5}};
  joint.cone_angle0 = joint.cone_angle1 = 0.5;
  joint.damping = 0.5;
  const Quatd tilt = rotation_about({{1, 0, 0}}, 0.2) * rotation_about({{0, 0, 1}}, 2.5);
  scene.bodies[rod].pose = {rotate(tilt, {{0, 0, 0.5}}), tilt};
  auto sim = simulation(scene);
  run(*sim, 10);
  const Vec3d axis = rotate(sim->body_state(rod).pose.orientation, {{0, 0, 1}});
  EXPECT_NEAR(std::acos(axis[2]), 0.5, 0.005);
}

struct ConeCase {
  Vec3d push;  // direction in which the axis X falls
  double expected;
};

// S-96: angle0 bounds X toward Y, angle1 X toward Z.
TEST(Joints, EllipticConeBoundsEachWay) {
  for (const ConeCase& c : {ConeCase{{{0, 1, 0}}, 0.3}, ConeCase{{{0, 0, 1}}, 0.6}}) {
    TestScene scene(0);
    scene.scenes[0].gravity = c.push * kG;
    const auto rod = scene.add_body("Rod", {}, 1, {{0.01, 0.01, 0.01}});
    auto& joint = scene.add_joint("Cone", JointKind::Spherical, {}, rod, Axis::X);
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.cone_angle0 = 0.3;
    joint.cone_angle1 = 0.6;
    joint.damping = 0.5;
    scene.bodies[rod].pose.position = {{0.5, 0, 0}};
    auto sim = simulation(scene);
    run(*sim, 10);
    const Vec3d axis = rotate(sim->body_state(rod).pose.orientation, {{1, 0, 0}});
    EXPECT_NEAR(std::acos(axis[0]), c.expected, 0.005) << c.expected;
    EXPECT_TRUE(mentions(sim->not_mapped(), "/Cone", "physics:coneAngle0Limit"));
  }
}

TEST(Joints, DistanceJointBoundsBothWays) {
  TestScene scene;
  const auto ball = scene.add_body("Ball", {{0.9, 0, 0}}, 0.1);
  auto& joint = scene.add_joint("Rope", JointKind::Distance, {}, ball);
  joint.lower = -1;
  joint.upper = 1;
  scene.bodies[ball].linear_damping = 1;
  auto sim = simulation(scene);
  double largest = 0;
  for (int i = 0; i < 6000; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    largest = std::max(largest, length(sim->body_state(ball).pose.position));
  }
  // E-113: never longer than 1.005 m; at rest straight below the anchor.
  EXPECT_LT(largest, 1.005);
  EXPECT_NEAR(sim->body_state(ball).pose.position[0], 0, 0.02);
  EXPECT_NEAR(sim->joint_state(0).position[0], 1, 1e-3);
}

TEST(Joints, DistanceJointLeavesAViolatedMinimumGently) {
  TestScene scene(0);
  const auto ball = scene.add_body("Ball", {{0.02, 0, 0}}, 0.1);
  auto& joint = scene.add_joint("Rod", JointKind::Distance, {}, ball);
  joint.lower = 0.1;
  joint.upper = 0.5;
  auto sim = simulation(scene);
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    ASSERT_LT(length(sim->body_state(ball).linear_velocity), 1.0);  // S-101
  }
  EXPECT_GT(length(sim->body_state(ball).pose.position), 0.099);
}

TEST(Joints, D6WithFreeTranslationsAndOneTurn) {
  TestScene scene;
  const auto body = scene.add_body("Stage", {{0.1, 0.2, 0}});
  auto& joint = scene.add_joint("Gantry", JointKind::D6, {}, body);
  for (const Dof dof : {Dof::TransZ, Dof::RotX, Dof::RotY}) {
    joint.limits.push_back({dof, 1, -1});
  }
  scene.bodies[body].linear_velocity = {{1, 2, 0}};
  scene.bodies[body].angular_velocity = {{0, 0, 3}};
  auto sim = simulation(scene);
  EXPECT_EQ(sim->dof_count(), 3u);
  run(*sim, 1);
  const JointState state = sim->joint_state(0);
  // Free axes: x = x0 + v t in Dof order; the locked ones hold against gravity.
  EXPECT_NEAR(state.position[0], 1.1, 1e-6);
  EXPECT_NEAR(state.position[1], 2.2, 1e-6);
  EXPECT_NEAR(state.position[2], 3, 1e-6);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0, 1e-9);
}

TEST(Joints, D6WithoutLimitsHoldsNothing) {
  TestScene scene;
  const auto body = scene.add_body("Free", {});
  scene.add_joint("Nothing", JointKind::D6, {}, body);
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_EQ(sim->dof_count(), 6u);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -kG, 1e-9);  // E-115
}

TEST(Joints, WhatMuJoCoCannotExpressIsReported) {
  TestScene scene = pendulum(0);
  scene.joints[0].limits.push_back({Dof::TransX, -1, 1});
  const auto ball = scene.add_body("Hung", {});
  scene.add_joint("Ball", JointKind::Spherical, {}, ball).velocity_limit = 1;
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Ball", "velocityLimit"));
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Pivot", "limit:transX"));
}

TEST(Joints, SpringAndFrictionOfTheJointAct) {
  TestScene scene(0);
  const auto body = scene.add_body("Mass", {{0.2, 0, 0}}, 1);
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::X);
  joint.stiffness = 100;
  joint.spring_reference = 0.1;
  joint.armature = 3;
  auto sim = simulation(scene, 0.0005);
  // (m + armature) x'' = -k (x - x0): omega = sqrt(100 / 4) = 5, half a period later mirrored.
  run(*sim, M_PI / 5);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.0, 1e-3);
}

}  // namespace
}  // namespace tenon::engines::mujoco
