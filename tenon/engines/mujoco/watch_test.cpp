// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulations that gain energy from nothing are unstable; those that are given it are not. Fast
// bodies that pass through others are told.
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/math/angle.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::Dof;
using scene::Index;
using scene::JointKind;

/// The error that ends a run of so many steps, if one does.
std::optional<Error> failure_within(MujocoSimulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) {
    if (Result<void> done = simulation.step(); !done) {
      return done.error();
    }
  }
  return std::nullopt;
}

// What springs of joints held before the first step counts, though that step gives most of it away.
TEST(EnergyWatch, AStiffSpringThatLetsGoMayMoveItsBody) {
  TestScene scene(0);
  const Index body = scene.add_body("Slider", {}, 1);
  scene::Joint& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::X);
  joint.stiffness = 1e7;
  joint.spring_reference = 0.1;
  joint.damping = 100;
  auto sim = simulation(scene);
  ASSERT_EQ(sim->engine_model().opt.integrator, mjINT_DISCRETE);
  const std::optional<Error> failure = failure_within(*sim, 100);
  EXPECT_FALSE(failure.has_value()) << failure->to_string();
}

/// Links of 0.2 m and 1 kg on hinges across each other, held by drives.
TestScene arm(int links, double stiffness) {
  TestScene scene;
  std::optional<Index> last;
  for (int i = 0; i < links; ++i) {
    const Index link = scene.add_body("Link" + std::to_string(i), {{0, 0, 0.1 + 0.2 * i}}, 1,
                                      {{4e-3, 4e-3, 1e-3}});
    auto& joint = scene.add_joint("Joint" + std::to_string(i), JointKind::Revolute, last, link,
                                  i % 2 == 0 ? Axis::Y : Axis::X);
    joint.frame0.position = {{0, 0, last ? 0.1 : 0}};
    joint.frame1.position = {{0, 0, -0.1}};
    joint.drives.push_back(drive(i % 2 == 0 ? Dof::RotY : Dof::RotX, stiffness, stiffness / 10));
    joint.drives.back().target_position = 0.5;
    last = link;
  }
  return scene;
}

TEST(EnergyWatch, AnArmOfTooLargeStepsIsUnstableWithBodyAndTime) {
  for (const double step : {1.0, 0.3, 0.1}) {
    TestScene scene = arm(6, 0);
    scene.scenes[0].gravity = {{4, 3, -8}};
    auto sim = simulation(scene, step);
    const std::optional<Error> failure = failure_within(*sim, 50);
    ASSERT_TRUE(failure.has_value()) << step;
    EXPECT_EQ(failure->code(), ErrorCode::Unstable);
    EXPECT_TRUE(failure->diagnostic().prim.starts_with("/Link")) << failure->to_string();
    EXPECT_NE(failure->message().find(" at "), std::string::npos);
    EXPECT_TRUE(std::isfinite(sim->energy().total()));
  }
}

TEST(EnergyWatch, TheSameArmWithSmallStepsIsStable) {
  const TestScene scene = arm(6, 10);
  auto sim = simulation(scene, 0.002);
  EXPECT_FALSE(failure_within(*sim, 1500).has_value());
}

// A spring of omega dt > 2 diverges with semi-implicit steps although its drive does the work.
TEST(EnergyWatch, ADriveThatIsTooStiffForTheStepIsUnstable) {
  TestScene scene(0);
  const Index body = scene.add_body("Mass", {{0.1, 0, 0}});
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::X);
  joint.drives.push_back(drive(Dof::TransX, 1e6, 0));
  Diagnostics diagnostics;
  auto made = MujocoSimulation::make(scene, {.time_step = 0.0021, .drives = DriveTerms::Explicit},
                                     diagnostics);
  ASSERT_TRUE(made.has_value());
  const std::unique_ptr<MujocoSimulation> sim = *std::move(made);
  const std::optional<Error> failure = failure_within(*sim, 400);
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->code(), ErrorCode::Unstable);
  EXPECT_EQ(failure->diagnostic().prim, "/Mass");
}

TEST(EnergyWatch, AMotorMaySpinUpAFlywheel) {
  TestScene scene(0);
  const Index wheel = scene.add_body("Wheel", {}, 1, {{0.01, 0.01, 0.01}});
  auto& joint = scene.add_joint("Axle", JointKind::Revolute, {}, wheel, Axis::Z);
  joint.drives.push_back(drive(Dof::RotZ, 0, 0.1));
  joint.drives.back().target_velocity = 500;
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 1000).has_value());
  EXPECT_GT(sim->energy().kinetic, 1000);
}

TEST(EnergyWatch, ATargetThatMovesFarMayDriveFar) {
  TestScene scene(0);
  const Index body = scene.add_body("Mass", {});
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::X);
  joint.drives.push_back(drive(Dof::TransX, 1000, 10));
  scene.scalar_tracks.push_back(
      {scene::Animated::DriveTargetPosition, 0, 0, {0, 0.2, 0.4}, {0, 0, 40}, false});
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 250).has_value());
  EXPECT_GT(sim->energy().kinetic, 1000);
}

TEST(EnergyWatch, ForcesFromOutsideMayAccelerate) {
  TestScene scene(0);
  const Index body = scene.add_body("Rocket", {});
  auto sim = simulation(scene);
  ASSERT_TRUE(sim->set_body_wrench(body, {{{1000, 0, 0}}, {{0, 0, 5}}}).has_value());
  EXPECT_FALSE(failure_within(*sim, 500).has_value());
  EXPECT_GT(sim->energy().kinetic, 1e5);
}

TEST(EnergyWatch, KinematicBodiesMayThrowAndCarry) {
  TestScene scene;
  const Index cart = scene.add_body("Cart", {});
  const Index bob = scene.add_body("Bob", {{0, 0, -1}}, 1, {{1e-3, 1e-3, 1e-3}});
  const Index ball = scene.add_body("Ball", {{0.5, 0, 0}});
  scene.add_collider("CartShape", cart, box({{0.1, 0.3, 0.3}}));
  scene.add_collider("BallShape", ball, sphere(0.1));
  auto& joint = scene.add_joint("Pivot", JointKind::Revolute, cart, bob, Axis::Y);
  joint.frame1.position = {{0, 0, 1}};
  scene.bodies[cart].kinematic = true;
  scene::PoseTrack track{cart, {}, {}, {}, false};
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.01 * i;
    track.times.push_back(t);
    track.poses.push_back({{{10 * t * t, 0, 0}}, rotation_about({{0, 0, 1}}, 3 * t)});
  }
  scene.pose_tracks.push_back(track);
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 1000).has_value());
  EXPECT_NEAR(sim->body_state(ball).linear_velocity[0], 4.87, 0.06);  // as on PhysX and Jolt
}

TEST(EnergyWatch, FallsAndImpactsAreNoGrowth) {
  TestScene scene;
  for (int i = 0; i < 8; ++i) {
    const auto name = std::to_string(i);
    const Index body =
        scene.add_body("Box" + name, {{0.01 * i, 0, 40 + 0.5 * i}}, 1 + i, {{0.01, 0.01, 0.02}});
    scene.bodies.back().angular_velocity = {{5, 3.0 * i, 0}};
    scene.add_collider("Shape" + name, body, box({{0.1, 0.15, 0.2}}));
  }
  scene.add_collider("Ground", std::nullopt, ground());
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 3000).has_value());
}

// A limit pulls a box into the ground and the ground pushes it out: much work, no motion.
TEST(EnergyWatch, ALimitThatFightsAContactIsNoGrowth) {
  TestScene scene;
  const Index body = scene.add_body("Box", {{0, 0, 0.1}}, 0.1, {{1e-4, 1e-4, 1e-4}});
  scene.add_collider("BoxShape", body, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("Ground", std::nullopt, ground());
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::Z);
  joint.frame1.position = {{0, 0, -0.1}};
  joint.lower = -0.1;
  joint.upper = -0.05;
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 1500).has_value());
}

TEST(EnergyWatch, AStateThatIsSetIsJudgedAnew) {
  TestScene scene(0);
  const Index body = scene.add_body("Body", {});
  auto sim = simulation(scene);
  EXPECT_FALSE(failure_within(*sim, 40).has_value());
  ASSERT_TRUE(sim->set_body_state(body, {{}, {{1000, 0, 0}}, {}}).has_value());
  EXPECT_FALSE(failure_within(*sim, 80).has_value());
  ASSERT_TRUE(sim->set_gravity(0, {{0, 0, -1000}}).has_value());
  EXPECT_FALSE(failure_within(*sim, 80).has_value());
}

/// A wheel that runs into its limit, in degrees/s.
TestScene stopped_wheel(double speed) {
  TestScene scene(0);
  const Index wheel = scene.add_body("Wheel", {});
  auto& joint = scene.add_joint("Axle", JointKind::Revolute, std::nullopt, wheel, Axis::Z);
  joint.upper = 1;
  joint.initial_velocity = speed * kRadians;
  return scene;
}

TEST(LimitWatch, AJointThatItsLimitThrowsBackIsToldOnce) {
  const TestScene scene = stopped_wheel(600);
  auto sim = simulation(scene);
  run(*sim, 1);
  ASSERT_EQ(sim->events().size(), 1u);
  const Event& event = sim->events()[0];
  EXPECT_EQ(event.kind, EventKind::ThrownBack);
  EXPECT_EQ(event.prim.str(), "/Axle");
  EXPECT_NE(event.what.find("of 600 degrees/s"), std::string::npos) << event.what;
}

TEST(LimitWatch, ASlowJointIsNotToldNorOneWithAuthoredSoftness) {
  auto slow = simulation(stopped_wheel(30));
  run(*slow, 4);
  EXPECT_TRUE(slow->events().empty());
  TestScene scene = stopped_wheel(600);
  scene.joints[0].parts.mujoco.solref_limit = {0.02, 1};
  auto soft = simulation(scene);
  run(*soft, 1);
  EXPECT_TRUE(soft->events().empty());
}

/// A ball of 3 cm that flies at a wall of 2 cm.
TestScene bullet(double speed) {
  TestScene scene(0);
  const Index ball = scene.add_body("Ball", {}, 0.1, {{1e-4, 1e-4, 1e-4}});
  scene.add_collider("BallShape", ball, sphere(0.03));
  scene.add_collider("Wall", std::nullopt, box({{0.01, 2, 2}}), {{{2, 0, 0}}, kIdentityRotation});
  scene.bodies[ball].linear_velocity = {{speed, 0, 0}};
  return scene;
}

TEST(PassageWatch, ABulletThatPassesAWallIsTold) {
  const TestScene scene = bullet(200);
  auto sim = simulation(scene);
  run(*sim, 0.1);
  ASSERT_EQ(sim->events().size(), 1u);
  const Event& event = sim->events()[0];
  EXPECT_EQ(event.kind, EventKind::PassedThrough);
  EXPECT_EQ(event.prim.str(), "/Ball");
  EXPECT_EQ(event.other.str(), "/Wall");
  EXPECT_NEAR(event.time, 0.01, 0.0021);  // 2 m at 200 m/s
  EXPECT_GT(sim->body_state(0).pose.position[0], 3);
}

TEST(PassageWatch, ABallThatBouncesIsNotTold) {
  for (const auto& [speed, step] : {std::pair(5.0, 0.002), std::pair(200.0, 0.0001)}) {
    const TestScene scene = bullet(speed);
    auto sim = simulation(scene, step);
    run(*sim, 0.6);
    EXPECT_TRUE(sim->events().empty()) << speed;
    EXPECT_LT(sim->body_state(0).pose.position[0], 2) << speed;
  }
}

// One flies behind the other, and both are where the other was a step before; so are links.
TEST(PassageWatch, WhatFliesAlongIsNotPassed) {
  TestScene scene = bullet(200);
  const Index next = scene.add_body("Next", {{0.2, 0, 0}}, 0.1, {{1e-4, 1e-4, 1e-4}});
  scene.add_collider("NextShape", next, sphere(0.03));
  const Index link = scene.add_body("Link", {{-0.2, 0, 0}}, 0.1, {{1e-4, 1e-4, 1e-4}});
  scene.add_collider("LinkShape", link, sphere(0.03));
  scene.add_joint("Hinge", JointKind::Revolute, Index{0}, link).frame0.position = {{-0.2, 0, 0}};
  for (scene::Body& body : scene.bodies) {
    body.linear_velocity = {{-200, 0, 0}};
  }
  auto sim = simulation(scene);
  run(*sim, 0.1);
  EXPECT_TRUE(sim->events().empty());
  EXPECT_LT(sim->body_state(next).pose.position[0], -10);
}

TEST(PassageWatch, WhatDoesNotCollideMayBePassed) {
  TestScene scene = bullet(200);
  keep_pairs_apart(scene, {{0, 1}});
  auto sim = simulation(scene);
  run(*sim, 0.1);
  EXPECT_TRUE(sim->events().empty());
  EXPECT_NEAR(sim->body_state(0).pose.position[0], 20, 1e-6);
}

}  // namespace
}  // namespace tenon::engines::mujoco
