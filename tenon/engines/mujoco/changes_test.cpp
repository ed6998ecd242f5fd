// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::JointKind;
using scene::Switch;

constexpr double kDt = 0.001;

scene::SwitchTrack at_one_second(Switch what, scene::Index object, bool before) {
  const char first = before ? 1 : 0;
  return {what, object, {0, 1}, {first, static_cast<char>(1 - first)}};
}

TEST(Changes, KinematicBodySetFreeKeepsItsSpeed) {
  TestScene scene;
  const auto body = scene.add_body("Body", {});
  scene.bodies[body].kinematic = true;
  scene.pose_tracks.push_back({body, {}, {0, 2}, {Pose{}, Pose{{{4, 0, 0}}}}, false});
  scene.switch_tracks.push_back(at_one_second(Switch::BodyKinematic, body, true));
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 2, 1e-6);
  run(*sim, 0.5);
  // E-33: from 1 s on free flight at 2 m/s; z = -g t^2 / 2, semi-implicit: g t dt / 2 more.
  const BodyState state = sim->body_state(body);
  EXPECT_NEAR(state.pose.position[0], 3, 1e-6);
  EXPECT_NEAR(state.linear_velocity[0], 2, 1e-9);
  EXPECT_NEAR(state.pose.position[2], -kG * 0.125, kG * 0.5 * kDt);
}

TEST(Changes, FallingBodyMadeKinematicFollowsItsTrack) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 5}});
  scene.pose_tracks.push_back({body, {}, {0, 2}, {Pose{{{0, 0, 8}}}, Pose{{{0, 0, 6}}}}, false});
  scene.switch_tracks.push_back(at_one_second(Switch::BodyKinematic, body, false));
  auto sim = simulation(scene, kDt);
  run(*sim, 0.9);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 5 - kG * 0.405, 0.01);
  run(*sim, 0.6);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 6.5, 1e-9);  // 8 - 1 m/s 1.5 s
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -1, 1e-9);
}

TEST(Changes, DisabledBodyStandsUntilItIsEnabled) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 5}});
  scene.bodies[body].enabled = false;
  scene.bodies[body].kinematic = true;
  scene.switch_tracks.push_back(at_one_second(Switch::BodyEnabled, body, false));
  scene.switch_tracks.push_back({Switch::BodyKinematic, body, {0}, {0}});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 5, 1e-12);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 5 - kG / 2, kG * kDt);
}

// Two unit masses 2 m apart; samples switch the inner one off from 1 s to 2 s.
struct Nested : TestScene {
  Nested() : TestScene(0) {
    outer = add_body("Outer", {});
    inner = add_body("Outer/Inner", {{2, 0, 0}});
    bodies[inner].linear_velocity = {{0, 3, 0}};
    switch_tracks.push_back({Switch::BodyEnabled, inner, {0, 1, 2}, {1, 0, 1}});
    switch_tracks.push_back({Switch::BodyKinematic, inner, {0}, {0}});
    const scene::BodyMass one{1, {}, diagonal({{0.1, 0.1, 0.1}})};
    nesting_states.push_back({0, {}, {}});
    nesting_states.push_back({1, {{inner, outer}}, {{outer, one}, {inner, one}}});
    nesting_states.push_back({2, {}, {}});
  }
  scene::Index outer = 0;
  scene::Index inner = 0;
};

TEST(Changes, BodySwitchedOffInAnotherIsPartOfItWithItsMomentum) {
  const Nested scene;
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(scene.outer).pose.position[1], 0, 1e-12);
  run(*sim, 0.5);
  // S-23: a plastic impact at (2, 3); the path misses the common centre by 1 m.
  const BodyState outer = sim->body_state(scene.outer);
  const BodyState inner = sim->body_state(scene.inner);
  const Vec3d momentum = outer.linear_velocity + inner.linear_velocity;
  EXPECT_NEAR(momentum[0], 0, 2e-4);  // of the integration of the turn
  EXPECT_NEAR(momentum[1], 3, 2e-4);
  const double apart = std::sqrt(13);
  const double spin = 3 / (2 * 13.0 / 4 + 0.2);
  EXPECT_NEAR(outer.angular_velocity[2], spin, 1e-4);
  EXPECT_NEAR(inner.angular_velocity[2], spin, 1e-4);
  EXPECT_NEAR(length(inner.pose.position - outer.pose.position), apart, 1e-9);
  run(*sim, 1.5);
  // On again: each flies along its tangent with what it has.
  const BodyState freed = sim->body_state(scene.inner);
  const BodyState left = sim->body_state(scene.outer);
  EXPECT_NEAR((freed.linear_velocity + left.linear_velocity)[1], 3, 2e-4);
  EXPECT_GT(length(freed.pose.position - left.pose.position), apart + 0.1);
}

TEST(Changes, WhatABodyBecomesPartOfMayHangOnAJoint) {
  Nested scene;
  scene.add_joint("Hinge", JointKind::Revolute, {}, scene.outer);
  auto sim = simulation(scene, kDt);
  run(*sim, 1.2);
  // Angular momentum about the hinge: 3 * 2 = (0.2 + |(2, 3)|^2) w.
  EXPECT_NEAR(sim->body_state(scene.outer).angular_velocity[2], 6 / 13.2, 1e-6);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 6 / 13.2, 1e-6);
}

TEST(Changes, SwitchedOffColliderLetsTheBodyThrough) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 0.5}}, 1, {{1.0 / 6, 1.0 / 6, 1.0 / 6}});
  const auto shape = scene.add_collider("Shape", body, box({{0.5, 0.5, 0.5}}));
  scene.add_collider("Ground", {}, ground());
  scene.switch_tracks.push_back(at_one_second(Switch::ColliderEnabled, shape, true));
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.5, 1e-3);
  run(*sim, 0.5);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.5 - kG * 0.125, 0.01);
}

TEST(Changes, JointSwitchedOffLetsGoAlongTheTangent) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {{1, 0, 0}});
  scene::Joint& joint = scene.add_joint("Pivot", JointKind::Revolute, {}, body);
  joint.frame1.position = {{-1, 0, 0}};
  scene.bodies[body].linear_velocity = {{0, M_PI / 2, 0}};
  scene.bodies[body].angular_velocity = {{0, 0, M_PI / 2}};
  scene.switch_tracks.push_back(at_one_second(Switch::JointEnabled, 0, true));
  auto sim = simulation(scene, kDt);
  run(*sim, 2);
  // A quarter turn at pi/2 per second to (0, 1); then for a second straight on along -x, turning on
  // as before: momentum and angular momentum stay.
  const BodyState state = sim->body_state(body);
  EXPECT_NEAR(state.pose.position[0], -M_PI / 2, 5e-3);
  EXPECT_NEAR(state.pose.position[1], 1, 5e-3);
  EXPECT_NEAR(state.linear_velocity[0], -M_PI / 2, 1e-3);
  EXPECT_NEAR(state.angular_velocity[2], M_PI / 2, 1e-3);
}

TEST(Changes, OtherJointsKeepTheirTurnsThroughAChange) {
  TestScene scene(0);
  const auto wheel = scene.add_body("Wheel", {});
  const auto other = scene.add_body("Other", {{3, 0, 0}});
  scene.add_joint("Axle", JointKind::Revolute, {}, wheel);
  scene.add_joint("Held", JointKind::Fixed, {}, other).frame0.position = {{3, 0, 0}};
  scene.bodies[wheel].angular_velocity = {{0, 0, 10}};
  scene.switch_tracks.push_back(at_one_second(Switch::JointEnabled, 1, true));
  auto sim = simulation(scene, kDt);
  run(*sim, 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], 20, 1e-6);  // three turns and more
}

TEST(Changes, LimitsMoveWhatRestsOnThem) {
  TestScene scene;
  const auto body = scene.add_body("Body", {});
  scene::Joint& joint = scene.add_joint("Slide", JointKind::Prismatic, {}, body, scene::Axis::Z);
  joint.lower = -0.3;
  scene::JointBounds low;
  low.lower = -0.3;
  scene::JointBounds high;
  high.lower = -0.1;
  scene.bounds_tracks.push_back({0, {0, 1, 2}, {low, low, high}, false});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->joint_state(0).position[0], -0.3, 2e-3);
  run(*sim, 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], -0.1, 2e-3);
}

TEST(Changes, LockedJointIsSetFreeByItsLimits) {
  TestScene scene;
  const auto body = scene.add_body("Body", {});
  scene::Joint& joint = scene.add_joint("Slide", JointKind::Prismatic, {}, body, scene::Axis::Z);
  joint.lower = 0;
  joint.upper = 0;
  scene::JointBounds locked;
  locked.lower = 0;
  locked.upper = 0;
  scene.bounds_tracks.push_back({0, {0, 1}, {locked, scene::JointBounds{}}, true});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0, 1e-9);
  run(*sim, 0.5);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], -kG * 0.125, 0.01);
}

TEST(Changes, GravityFollowsItsSamples) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {});
  scene.gravity_tracks.push_back({0, {0, 2}, {Vec3d{{0, 0, 0}}, Vec3d{{0, 0, -6}}}, false});
  auto sim = simulation(scene, kDt);
  run(*sim, 2);
  // v = -int_0^2 3 t dt = -6, z = -t^3 / 2 = -4.
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -6, 0.01);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], -4, 0.01);
}

TEST(Changes, GravityOfASecondSceneFollowsToo) {
  TestScene scene;
  scene.scenes.push_back({named("Other"), {}, {}});
  const auto body = scene.add_body("Body", {});
  scene.bodies[body].scene = 1;
  scene.gravity_tracks.push_back({1, {0, 1}, {Vec3d{}, Vec3d{{2, 0, 0}}}, true});
  auto sim = simulation(scene, kDt);
  run(*sim, 2);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 2, 0.01);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], 0, 1e-9);
}

TEST(Changes, GroupsThatStopTouchingLetTheBodyThrough) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("Ball", body, sphere(0.1));
  scene.add_collider("Ground", {}, ground());
  scene.filter.group_paths = {named("A"), named("B")};
  scene.filter.groups_of_collider = {{0}, {1}};
  scene.filter.group_pair_off.assign(4, 0);
  scene.filter.ungrouped_off.assign(2, 0);
  scene.group_states.push_back({1, {0, 1, 1, 0}, {0, 0}});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.1, 2e-3);
  run(*sim, 1);
  EXPECT_LT(sim->body_state(body).pose.position[2], -4);
}

TEST(Changes, AnchorOnAMovingPrimCarriesTheBody) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, -1}});
  scene::Joint& joint = scene.add_joint("Held", JointKind::Fixed, {}, body);
  joint.frame1.position = {{0, 0, 1}};
  scene::PoseTrack track{{}, {}, {0, 2}, {Pose{}, Pose{{{4, 0, 0}}}}, false};
  track.joint = 0;
  scene.pose_tracks.push_back(track);
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 2, 1e-3);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], -1, 1e-3);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 2, 1e-3);
}

TEST(Changes, FrictionThatRisesStopsWhatSlides) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 0.1}}, 2, {{0.03, 0.03, 0.05}});
  scene.bodies[body].linear_velocity = {{2, 0, 0}};
  const auto shape = scene.add_collider("Shape", body, box({{0.2, 0.2, 0.1}}));
  const auto floor = scene.add_collider("Ground", {}, ground());
  scene::Material ice;
  ice.path = named("Ice");
  scene.materials = {ice};
  scene.colliders[shape].material = scene.colliders[floor].material = 0;
  ice.dynamic_friction = ice.static_friction = 0.8;
  scene.material_tracks.push_back({0, {1}, {ice}});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 2, 1e-3);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 2, 1e-3);
  run(*sim, 1);
  // v^2 / (2 mu g) further.
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 2 + 4 / (2 * 0.8 * kG), 0.01);
}

TEST(Changes, AJointWhoseFrameMovesTakesItsBodyAlong) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, -1}});
  scene::Joint& joint = scene.add_joint("Held", JointKind::Fixed, {}, body);
  joint.frame1.position = {{0, 0, 1}};
  scene::Joint later = joint;
  later.frame0.position = {{0.5, 0, 0}};
  scene.joint_tracks.push_back({0, {1}, {later}});
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 0, 1e-6);
  run(*sim, 0.5);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 0.5, 1e-6);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], -1, 1e-6);
}

TEST(Changes, AFloorThatGrowsCatchesWhatWouldFallBesideIt) {
  for (const bool grows : {false, true}) {
    TestScene scene;
    const auto body = scene.add_body("Body", {{3, 0, 1}});
    scene.add_collider("Ball", body, sphere(0.1));
    const auto floor = scene.add_collider("Floor", {}, box({{1, 1, 0.5}}), {{{0, 0, -0.5}}});
    if (grows) {
      scene::Collider wide = scene.colliders[floor];
      wide.shape.half_extents = {{5, 5, 0.5}};
      scene.collider_tracks.push_back({floor, {0.2}, {wide}});
    }
    auto sim = simulation(scene, kDt);
    run(*sim, 2);
    const double height = sim->body_state(body).pose.position[2];
    EXPECT_EQ(height > 0, grows) << height;
  }
}

TEST(Changes, SettingsOfBodiesFollowTheirStates) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {});
  scene.bodies[body].linear_velocity = {{1, 0, 0}};
  scene::Body damped = scene.bodies[body];
  damped.linear_damping = 2;
  damped.pose.position = {{100, 0, 0}};  // the run knows better
  damped.linear_velocity = {};
  scene.body_tracks.push_back({body, {1}, {damped}});
  auto sim = simulation(scene, kDt);
  run(*sim, 2);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], std::exp(-2.0), 2e-3);
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 1 + (1 - std::exp(-2.0)) / 2, 2e-3);
  ASSERT_TRUE(sim->reset());
  run(*sim, 0.5);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 1, 1e-9);
}

/// 10 kg on a joint to the world, as E-104.
TestScene hanging(JointKind kind, double break_force) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, -1}}, 10);
  scene::Joint& joint = scene.add_joint("Hook", kind, {}, body);
  joint.frame1.position = {{0, 0, 1}};
  joint.break_force = break_force;
  return scene;
}

/// A body of 2 kg whose ball of 0.1 m moves from its origin to `end` at 0.2 s, its mass with it.
TestScene body_with_moving_ball(double gravity, const Vec3d& end) {
  TestScene scene(gravity);
  const auto body = scene.add_body("Body", {{0, 0, 1}}, 2, {{0.02, 0.02, 0.02}});
  const auto ball = scene.add_collider("Ball", body, sphere(0.1));
  scene::ShapesTrack track;
  track.body = body;
  track.colliders = {ball};
  track.times = {0, 0.2};
  const Mat3d inertia = scene.bodies[body].inertia;
  track.shapes = {{{Pose{}}, {sphere(0.1)}, 2, {}, inertia},
                  {{Pose{end}}, {sphere(0.1)}, 2, end, inertia}};
  scene.shapes_tracks.push_back(track);
  return scene;
}

TEST(Changes, ShapesThatMoveInABodyTakeItsMassAlong) {
  TestScene scene = body_with_moving_ball(kG, {{0, 0, -0.5}});
  scene.add_collider("Ground", {}, ground());
  auto sim = simulation(scene, kDt);
  run(*sim, 0.25);
  // S-37: the body falls on as it fell, z = 1 - g t^2 / 2, semi-implicit: g t dt / 2 more.
  EXPECT_NEAR(sim->body_state(0).pose.position[2], 1 - kG * 0.03125, kG * 0.25 * kDt);
  EXPECT_NEAR(sim->body_state(0).linear_velocity[2], -kG * 0.25, 1e-6);
  run(*sim, 2);
  EXPECT_NEAR(sim->body_state(0).pose.position[2], 0.6, 5e-3);  // the ball is half a metre below
}

TEST(Changes, ASpinningBodyIsNotPushedByWhatMovesInIt) {
  TestScene scene = body_with_moving_ball(0, {{0.5, 0, 0}});
  scene.bodies[0].angular_velocity = {{0, 0, 1}};
  auto sim = simulation(scene, kDt);
  run(*sim, 0.201);
  const BodyState state = sim->body_state(0);
  EXPECT_NEAR(length(state.pose.position - Vec3d{{0, 0, 1}}), 0, 1e-3);
  // The new centre of mass moves as the point of the body that it is: w x r.
  EXPECT_NEAR(state.linear_velocity[0], -0.5 * std::sin(0.2), 2e-3);
  EXPECT_NEAR(state.linear_velocity[1], 0.5 * std::cos(0.2), 2e-3);
}

TEST(Breaking, JointsGiveWayAboveTheirForceOnly) {
  for (const JointKind kind : {JointKind::Fixed, JointKind::Revolute, JointKind::Spherical}) {
    // 10 kg weigh 98.1 N: 50 N breaks at once, 150 N holds.
    const TestScene weak = hanging(kind, 50);
    auto falls = simulation(weak, kDt);
    run(*falls, 1);
    EXPECT_NEAR(falls->body_state(0).pose.position[2], -1 - kG / 2, 0.02);
    ASSERT_EQ(falls->events().size(), 1u);
    EXPECT_NEAR(falls->events()[0].time, kDt, 1e-9);
    EXPECT_EQ(falls->events()[0].prim.str(), "/Hook");
    const TestScene strong = hanging(kind, 150);
    auto holds = simulation(strong, kDt);
    run(*holds, 1);
    EXPECT_NEAR(holds->body_state(0).pose.position[2], -1, 1e-6);
    EXPECT_TRUE(holds->events().empty());
  }
}

TEST(Breaking, LimitsFollowTheirStates) {
  TestScene scene = hanging(JointKind::Fixed, 150);
  scene::Joint weaker = scene.joints[0];
  for (const double limit : {140.0, 120.0, 90.0}) {
    weaker.break_force = limit;
    scene.joint_tracks.resize(1);
    scene.joint_tracks[0].times.push_back(0.2 + (150 - limit) / 100);
    scene.joint_tracks[0].states.push_back(weaker);
  }
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  ASSERT_EQ(sim->events().size(), 1u);
  EXPECT_NEAR(sim->events()[0].time, 0.8, 2 * kDt);
}

TEST(Breaking, TorqueIsThatAboutTheAnchor) {
  // A bar of 2 kg held at one end, its centre 0.5 m away: 2 g 0.5 = 9.81 N m.
  for (const double limit : {9.0, 10.0}) {
    TestScene scene;
    const auto bar = scene.add_body("Bar", {{0.5, 0, 0}}, 2);
    scene::Joint& joint = scene.add_joint("Clamp", JointKind::Fixed, {}, bar);
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.break_torque = limit;
    auto sim = simulation(scene, kDt);
    run(*sim, 0.5);
    EXPECT_EQ(sim->events().size(), limit < 9.81 ? 1u : 0u) << limit;
  }
}

TEST(Breaking, RopeTearsInTheFall) {
  // A ball falls 0.5 m into a rope: far more than its weight of 9.81 N.
  for (const double limit : {20.0, 1e6}) {
    TestScene scene;
    const auto ball = scene.add_body("Ball", {{0, 0, -0.5}}, 1, {{0.01, 0.01, 0.01}});
    scene::Joint& joint = scene.add_joint("Rope", JointKind::Distance, {}, ball);
    joint.upper = 1;
    joint.break_force = limit;
    auto sim = simulation(scene, kDt);
    run(*sim, 2);
    EXPECT_EQ(sim->events().size(), limit < 100 ? 1u : 0u) << limit;
    EXPECT_EQ(sim->body_state(ball).pose.position[2] < -5, limit < 100) << limit;
  }
}

TEST(Breaking, LoopsBreakToo) {
  // A bar held at both ends by two joints, 4 kg: each carries about half of 39.24 N.
  for (const double limit : {15.0, 35.0}) {
    TestScene scene;
    const auto bar = scene.add_body("Bar", {}, 4);
    scene.add_joint("Left", JointKind::Revolute, {}, bar, scene::Axis::Y);
    scene.joints[0].frame0.position = {{-1, 0, 0}};
    scene.joints[0].frame1.position = {{-1, 0, 0}};
    scene.add_joint("Right", JointKind::Spherical, {}, bar, scene::Axis::Y);
    scene.joints[1].frame0.position = {{1, 0, 0}};
    scene.joints[1].frame1.position = {{1, 0, 0}};
    scene.joints[1].break_force = limit;
    auto sim = simulation(scene, kDt);
    run(*sim, 0.2);
    EXPECT_EQ(sim->events().size(), limit < 19.6 ? 1u : 0u) << limit;
  }
}

TEST(Breaking, WeldsInLoopsCarryTorque) {
  // A rod of 4 kg and 1 m held at its left end by a hinge and by a fixed joint: m g l / 2 = 19.6.
  for (const double limit : {15.0, 25.0}) {
    TestScene scene;
    const auto rod = scene.add_body("Rod", {{0.5, 0, 0}}, 4, {{0.01, 0.33, 0.33}});
    scene.add_joint("Hinge", JointKind::Revolute, {}, rod, scene::Axis::Y);
    scene.joints[0].frame1.position = {{-0.5, 0, 0}};
    scene.add_joint("Weld", JointKind::Fixed, {}, rod);
    scene.joints[1].frame1.position = {{-0.5, 0, 0}};
    scene.joints[1].break_torque = limit;
    auto sim = simulation(scene, kDt);
    run(*sim, 0.3);
    EXPECT_EQ(sim->events().size(), limit < 19.6 ? 1u : 0u) << limit;
  }
}

TEST(Breaking, ConeLimitsCarryTorque) {
  // The same rod on a ball joint rests on its cone of 30 degrees: m g l / 2 cos 30 = 17.0, and
  // twice that when it comes to a stop in one step.
  for (const double limit : {15.0, 45.0}) {
    TestScene scene;
    const double tilt = 30 * M_PI / 180;
    const auto rod = scene.add_body("Rod", {{0.5 * std::cos(tilt), 0, -0.5 * std::sin(tilt)}}, 4,
                                    {{0.01, 0.33, 0.33}});
    scene.bodies[rod].pose.orientation = rotation_about({{0, 1, 0}}, tilt);
    scene.add_joint("Ball", JointKind::Spherical, {}, rod, scene::Axis::X);
    scene.joints[0].frame1.position = {{-0.5, 0, 0}};
    scene.joints[0].cone_angle0 = tilt;
    scene.joints[0].cone_angle1 = tilt;
    scene.joints[0].break_torque = limit;
    auto sim = simulation(scene, kDt);
    run(*sim, 0.5);
    EXPECT_EQ(sim->events().size(), limit < 17 ? 1u : 0u) << limit;
  }
}

TEST(Breaking, WhatAJointKeptApartMayTouchWhenItIsBroken) {
  TestScene scene;
  const auto body = scene.add_body("Body", {{0, 0, 0.05}}, 10, {{0.1, 0.1, 0.1}});
  const auto shape = scene.add_collider("Shape", body, sphere(0.1));
  const auto floor = scene.add_collider("Floor", {}, ground());
  scene::Joint& joint = scene.add_joint("Hook", JointKind::Fixed, {}, body);
  joint.frame0.position = {{0, 0, 0.05}};
  joint.break_force = 50;
  make_each_a_set(scene);
  scene.filter.joint_pairs.push_back({0, {{shape, floor}}});
  scene.update_joint_pairs();
  auto sim = simulation(scene, kDt);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.1, 2e-3);  // pushed out of the floor
}

}  // namespace
}  // namespace tenon::engines::mujoco
