// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "tenon/engines/jolt/test_run.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

SimulationOptions with_contacts() {
  SimulationOptions options;
  options.outputs.contacts = true;
  return options;
}

TestScene box_on_ground(double friction) {
  TestScene scene;
  scene.materials.push_back({named("material"), friction, friction});
  const Index box_body = scene.add_body("box", {{0, 0, 0.1}}, 2, {{0.01, 0.01, 0.01}});
  scene.add_collider("box/shape", box_body, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("ground", std::nullopt, ground());
  scene.colliders[0].material = scene.colliders[1].material = 0;
  return scene;
}

// Normal forces carry the weight, friction what pushes sideways.
TEST(JoltContacts, GiveTheForcesThatHoldABox) {
  const TestScene scene = box_on_ground(0.5);
  const auto simulation = make_run(scene, with_contacts());
  ASSERT_TRUE(simulation->set_body_wrench(0, {{{3, 0, 0}}, {}}).has_value());
  run_for(*simulation, 1);
  const std::vector<Contact> contacts = *simulation->contacts();
  ASSERT_EQ(contacts.size(), 4u);
  Vec3d total;
  for (const Contact& contact : contacts) {
    EXPECT_EQ(contact.collider0, 0u);
    EXPECT_EQ(contact.body0, 0u);
    EXPECT_NEAR(contact.normal[2], -1, 1e-4);  // from the box to the ground
    EXPECT_NEAR(contact.point[2], 0, 1e-3);
    EXPECT_GE(contact.normal_force, 0);
    total += contact.force();
  }
  EXPECT_NEAR(total[2], -2 * kG, 0.05);  // on the ground
  EXPECT_NEAR(total[0], 3, 0.05);
  EXPECT_NEAR(simulation->body_state(0).pose.position[0], 0, 1e-3);
}

// A box slides with g (sin a - mu cos a) where tan a > mu, and stays where it is less.
TEST(JoltContacts, FrictionHoldsUpToItsAngleAndSlidesBeyond) {
  const double angle = 0.5;  // tan 0.5 = 0.546
  for (const double friction : {0.3, 0.6}) {
    TestScene scene = box_on_ground(friction);
    scene.scenes[0].gravity = {{kG * std::sin(angle), 0, -kG * std::cos(angle)}};
    const auto simulation = make_run(scene);
    run_for(*simulation, 1);
    const double wanted =
        friction > std::tan(angle) ? 0 : kG * (std::sin(angle) - friction * std::cos(angle)) / 2;
    EXPECT_NEAR(simulation->body_state(0).pose.position[0], wanted, 0.01) << friction;
  }
}

// Held by static friction 0.8, it slides on with 0.2 once something has pushed it.
TEST(JoltContacts, FrictionIsLessOnceSurfacesSlide) {
  TestScene scene = box_on_ground(0.2);
  scene.materials[0].static_friction = 0.8;
  scene.scenes[0].gravity = {{kG * 0.4, 0, -kG * 0.9}};
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.5);
  EXPECT_NEAR(simulation->body_state(0).pose.position[0], 0, 1e-3);
  BodyState pushed = simulation->body_state(0);
  pushed.linear_velocity = {{0.5, 0, 0}};
  ASSERT_TRUE(simulation->set_body_state(0, pushed).has_value());
  run_for(*simulation, 1);
  EXPECT_NEAR(simulation->body_state(0).linear_velocity[0], 0.5 + kG * (0.4 - 0.2 * 0.9), 0.05);
}

TEST(JoltContacts, AFrictionThatIsSetCounts) {
  TestScene scene = box_on_ground(0.6);
  scene.scenes[0].gravity = {{kG * 0.4, 0, -kG * 0.9}};
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.2);
  EXPECT_NEAR(simulation->body_state(0).linear_velocity[0], 0, 1e-3);
  for (const Index collider : {0u, 1u}) {
    const ParameterKey key{Parameter::ColliderFriction, collider, 0};
    ASSERT_TRUE(simulation->set_parameter(key, 0).has_value());
  }
  run_for(*simulation, 1);
  EXPECT_NEAR(simulation->body_state(0).linear_velocity[0], kG * 0.4, 0.01);
}

// Every shape comes to rest with its lowest point on a plane.
TEST(JoltContacts, EveryShapeRestsOnAPlane) {
  using scene::ShapeKind;
  for (const ShapeKind kind : {ShapeKind::Box, ShapeKind::Sphere, ShapeKind::Ellipsoid,
                               ShapeKind::Capsule, ShapeKind::Cylinder, ShapeKind::Cone}) {
    TestScene scene;
    scene::Shape shape;
    shape.kind = kind;
    shape.half_extents = {{0.1, 0.1, 0.1}};
    shape.radius = kind == ShapeKind::Capsule ? 0.05 : 0.1;
    shape.half_height = kind == ShapeKind::Capsule ? 0.05 : 0.1;
    const Index body = scene.add_body("body", {{0, 0, 0.15}}, 1, {{0.01, 0.01, 0.01}});
    scene.bodies[body].angular_damping = 5;
    scene.bodies[body].settings.locked_rotation = 7;
    scene.add_collider("body/shape", body, shape);
    scene.add_collider("ground", std::nullopt, ground());
    const auto simulation = make_run(scene);
    run_for(*simulation, 1);
    EXPECT_NEAR(simulation->body_state(0).pose.position[2], 0.1, 1e-3) << scene::shape_name(kind);
  }
}

// Colliders of one body are filtered one by one: the left foot passes through, the right one holds.
TEST(JoltContacts, PairsOfCollidersAreFilteredNotBodies) {
  for (const bool filtered : {false, true}) {
    TestScene scene;
    const Index body = scene.add_body("body", {{0, 0, 0.5}}, 1, {{0.01, 0.01, 0.01}});
    scene.bodies[body].settings.locked_rotation = 7;
    scene.add_collider("body/low", body, sphere(0.1), {{{0, 0, -0.2}}});
    scene.add_collider("body/high", body, sphere(0.1), {{{0, 0, 0.2}}});
    scene.add_collider("ground", std::nullopt, ground());
    if (filtered) {
      keep_pairs_apart(scene, {{0, 2}});
    }
    const auto simulation = make_run(scene);
    run_for(*simulation, 1.5);
    EXPECT_NEAR(simulation->body_state(0).pose.position[2], filtered ? -0.1 : 0.3, 2e-3);
  }
}

TEST(JoltContacts, ABodyThatSleepsStaysUntilItIsMet) {
  TestScene scene(0);
  const Index sleeper = scene.add_body("sleeper", {{0, 0, 0}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[sleeper].starts_asleep = true;
  scene.bodies[sleeper].linear_velocity = {{0, 1, 0}};
  scene.add_collider("sleeper/shape", sleeper, sphere(0.1));
  const Index ball = scene.add_body("ball", {{-1, 0, 0}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[ball].linear_velocity = {{2, 0, 0}};
  scene.add_collider("ball/shape", ball, sphere(0.1));
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.3);
  EXPECT_EQ(simulation->body_state(sleeper).pose.position, Vec3d{});
  run_for(*simulation, 0.4);
  EXPECT_GT(simulation->body_state(sleeper).linear_velocity[0], 0.5);
}

// 0.1 rad/s are 0.1 mrad in a step, below what an arc cosine in single precision tells apart.
TEST(JoltKinematics, ABodyTurnsEvenlyHoweverSlowly) {
  TestScene scene(0);
  const Index body = scene.add_body("body", {{0, 0, 0}});
  scene.bodies[body].kinematic = true;
  scene.add_collider("body/shape", body, sphere(0.1));
  const auto simulation = make_run(scene);
  for (int step = 1; step <= 50; ++step) {
    const double half = 0.1 * 1e-3 * step / 2;
    ASSERT_TRUE(
        simulation->move_kinematic(body, {{}, {0, 0, std::sin(half), std::cos(half)}}).has_value());
    ASSERT_TRUE(simulation->step().has_value());
    EXPECT_NEAR(simulation->body_state(body).angular_velocity[2], 0.1, 1e-3) << step;
  }
}

}  // namespace
}  // namespace tenon::engines::jolt
