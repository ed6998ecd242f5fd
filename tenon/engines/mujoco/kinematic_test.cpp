// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::JointKind;

void move_along_x(TestScene& scene, scene::Index body, double speed, double seconds) {
  scene.bodies[body].kinematic = true;
  Pose end = scene.bodies[body].pose;
  end.position[0] += speed * seconds;
  scene.pose_tracks.push_back({body, {}, {0, seconds}, {scene.bodies[body].pose, end}, false});
}

TEST(Kinematic, PushesASphereAtItsSpeed) {
  TestScene scene(0);
  const auto pusher = scene.add_body("Pusher", {{-0.5, 0, 0}});
  const auto ball = scene.add_body("Ball", {{0, 0, 0}});
  scene.add_collider("PusherShape", pusher, box({{0.1, 0.3, 0.3}}));
  scene.add_collider("BallShape", ball, sphere(0.1));
  move_along_x(scene, pusher, 1, 2);
  auto sim = simulation(scene);
  run(*sim, 1.5);
  // E-30: the pushed body goes at least at the pusher's 1 m/s; the pusher's pose is exact.
  EXPECT_GE(sim->body_state(ball).linear_velocity[0], 0.99);
  EXPECT_NEAR(sim->body_state(pusher).pose.position[0], -0.5 + 1.5, 1e-9);
  EXPECT_NEAR(sim->body_state(pusher).linear_velocity[0], 1, 1e-9);
}

TEST(Kinematic, CarriesABoxByFriction) {
  TestScene scene;
  const auto belt = scene.add_body("Belt", {{0, 0, 0}});
  const auto load = scene.add_body("Load", {{0, 0, 0.2}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("BeltShape", belt, box({{5, 1, 0.1}}));
  scene.add_collider("LoadShape", load, box({{0.1, 0.1, 0.1}}));
  move_along_x(scene, belt, 0.5, 4);
  auto sim = simulation(scene);
  run(*sim, 2);
  // Dragged up to speed within v / (mu g) = 0.1 s, then at rest on the belt.
  EXPECT_NEAR(sim->body_state(load).linear_velocity[0], 0.5, 5e-3);
}

TEST(Kinematic, PendulumFeelsTheAccelerationOfItsPivot) {
  TestScene scene;
  const auto cart = scene.add_body("Cart", {});
  const auto bob = scene.add_body("Bob", {{0, 0, -1}}, 1, {{1e-4, 1e-4, 1e-4}});
  auto& joint = scene.add_joint("Pivot", JointKind::Revolute, cart, bob, scene::Axis::Y);
  joint.frame1.position = {{0, 0, 1}};
  joint.damping = 3;
  scene.bodies[cart].kinematic = true;
  // x = a t^2 / 2 with a = 2 m/s^2, sampled densely.
  scene::PoseTrack track{cart, {}, {}, {}, false};
  for (int i = 0; i <= 4000; ++i) {
    const double t = 0.001 * i;
    track.times.push_back(t);
    track.poses.push_back({{{t * t, 0, 0}}, kIdentityRotation});
  }
  scene.pose_tracks.push_back(track);
  auto sim = simulation(scene, 0.001);
  run(*sim, 3.9);
  // Hanging at rest in the accelerated frame: tan(angle) = a / g, backwards (a turn about +y).
  EXPECT_NEAR(sim->joint_state(0).position[0], std::atan(2 / kG), 5e-3);
}

TEST(Kinematic, StillBodyIsAnAnchor) {
  TestScene scene;
  const auto hook = scene.add_body("Hook", {{0, 0, 2}});
  const auto load = scene.add_body("Load", {{0, 0, 1}});
  scene.bodies[hook].kinematic = true;
  auto& joint = scene.add_joint("Rope", JointKind::Spherical, hook, load);
  joint.frame1.position = {{0, 0, 1}};
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_EQ(sim->dof_count(), 3u);
  EXPECT_NEAR(sim->body_state(load).pose.position[2], 1, 1e-9);
}

TEST(Kinematic, RotatingBodyFollowsItsTrack) {
  TestScene scene(0);
  const auto wheel = scene.add_body("Wheel", {});
  scene.bodies[wheel].kinematic = true;
  const Quatd quarter = rotation_about({{0, 0, 1}}, M_PI / 2);
  scene.pose_tracks.push_back({wheel, {}, {0, 1}, {Pose{}, {{{1, 0, 0}}, quarter}}, false});
  auto sim = simulation(scene);
  run(*sim, 0.5);
  const BodyState state = sim->body_state(wheel);
  EXPECT_NEAR(rotation_vector(state.pose.orientation)[2], M_PI / 4, 1e-9);
  EXPECT_NEAR(state.angular_velocity[2], M_PI / 2, 1e-6);
  run(*sim, 1);
  EXPECT_NEAR(length(sim->body_state(wheel).linear_velocity), 0, 1e-9);  // after the last sample
}

TEST(Kinematic, AnimatedStaticColliderMovesAway) {
  TestScene scene;
  const auto box_body = scene.add_body("Box", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("BoxShape", box_body, box({{0.1, 0.1, 0.1}}));
  const auto floor = scene.add_collider("Floor", {}, box({{1, 1, 0.1}}), {{{0, 0, -0.1}}, {}});
  scene.colliders[floor].pose.orientation = kIdentityRotation;
  const Pose away{{{10, 0, -0.1}}, kIdentityRotation};
  scene.pose_tracks.push_back({{}, floor, {0, 1}, {scene.colliders[floor].pose, away}, true});
  auto sim = simulation(scene);
  run(*sim, 0.9);
  EXPECT_NEAR(sim->body_state(box_body).pose.position[2], 0.1, 2e-3);
  run(*sim, 0.6);
  EXPECT_LT(sim->body_state(box_body).pose.position[2], -0.5);
}

}  // namespace
}  // namespace tenon::engines::mujoco
