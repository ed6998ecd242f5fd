// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One scene on every engine of this build: where they have to agree, and how closely they do. The
// first engine, MuJoCo, is what the others are compared with; both are held to a closed form where
// there is one.
#include <algorithm>
#include <functional>

#include "tenon/engines/test_scene.h"
#include "tests/physics/scene_run.h"

namespace tenon {
namespace {

using engines::drive;
using engines::kG;
using engines::TestScene;
using scene::Axis;
using scene::Dof;
using scene::Index;
using scene::JointKind;

constexpr double kStep = 0.001;  // [s]

class Agreement : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<engines::Simulation> make(const scene::PhysicsScene& scene) {
    Diagnostics diagnostics;
    auto made = make_simulation(GetParam(), scene, {.time_step = kStep}, diagnostics);
    EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().to_string());
    return made ? *std::move(made) : nullptr;
  }
  static void run(engines::Simulation& simulation, double seconds) {
    const auto steps = std::lround(seconds / kStep);
    for (long i = 0; i < steps; ++i) {
      const Result<void> done = simulation.step();
      ASSERT_TRUE(done.has_value()) << done.error().to_string();
    }
  }
  static double angle(const engines::Simulation& simulation, Index joint) {
    return simulation.joint_state(joint).position.at(0);
  }
};
INSTANTIATE_TEST_SUITE_P(, Agreement, testing::ValuesIn(engines_here()),
                         [](const auto& engine) { return engine.param; });

/// A rod of 1 m and 1 kg that hangs on a hinge about y at its end and starts horizontally along x.
TestScene pendulum(bool articulated, bool reversed) {
  TestScene scene;
  const Index rod = scene.add_body("rod", {{0.5, 0, 3}}, 1, {{0.001, 1.0 / 12, 1.0 / 12}});
  const std::optional<Index> world;
  scene::Joint& hinge = reversed
                            ? scene.add_joint("hinge", JointKind::Revolute, rod, world, Axis::Y)
                            : scene.add_joint("hinge", JointKind::Revolute, world, rod, Axis::Y);
  (reversed ? hinge.frame1 : hinge.frame0).position = {{0, 0, 3}};
  (reversed ? hinge.frame0 : hinge.frame1).position = {{-0.5, 0, 0}};
  if (articulated) {
    hinge.articulation = 0;
    scene.articulations.push_back({engines::named("rod"), hinge.path, true, {rod}, {0}, {}, true});
  }
  return scene;
}

// A rod that falls from the horizontal passes the vertical with w^2 = 3 g / l.
TEST_P(Agreement, APendulumIsThatOfTheBooksWhetherATreeOrNot) {
  for (const bool articulated : {true, false}) {
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(std::string(articulated ? "articulated" : "maximal") +
                   (reversed ? ", reversed" : ""));
      const TestScene scene = pendulum(articulated, reversed);
      const auto simulation = make(scene);
      ASSERT_NE(simulation, nullptr);
      const double start = simulation->energy().total();
      const double sign = reversed ? -1 : 1;
      while (sign * angle(*simulation, 0) < M_PI / 2 && simulation->time() < 2) {
        run(*simulation, kStep);
      }
      // The quarter swing takes K(sin 45) sqrt(2 l / (3 g)).
      EXPECT_NEAR(simulation->time(), 1.8540747 * std::sqrt(2 / (3 * kG)), 2e-3);
      EXPECT_NEAR(sign * simulation->joint_state(0).velocity.at(0), std::sqrt(3 * kG), 0.02);
      EXPECT_NEAR(simulation->energy().total(), start, 0.02);
      EXPECT_NEAR(simulation->body_state(0).pose.position[2], 2.5, 2e-3);
    }
  }
}

/// Links of 0.1 kg and 0.1 m, hinged alternately about y and z, each driven to 0.2 rad.
TestScene chain(int count) {
  TestScene scene;
  std::optional<Index> parent;
  scene::Articulation tree{
      engines::named("link0"), engines::named("joint0"), true, {}, {}, {}, true};
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(10 + i);
    const Index link =
        scene.add_body("link" + number, {{0.05 + 0.1 * i, 0, 2}}, 0.1, {{1e-5, 1e-4, 1e-4}});
    scene::Joint& joint = scene.add_joint("joint" + number, JointKind::Revolute, parent, link,
                                          i % 2 == 0 ? Axis::Y : Axis::Z);
    joint.frame0.position = parent ? Vec3d{{0.05, 0, 0}} : Vec3d{{0, 0, 2}};
    joint.frame1.position = {{-0.05, 0, 0}};
    joint.drives = {drive(joint.dof(), 20, 1)};
    joint.drives[0].target_position = 0.2;
    joint.articulation = 0;
    tree.links.push_back(link);
    tree.joints.push_back(static_cast<Index>(i));
    parent = link;
  }
  tree.root = scene.joints[0].path;
  scene.articulations.push_back(tree);
  return scene;
}

// Where the chain rests on MuJoCo and, within the iterations of its solver, on others.
TEST_P(Agreement, ADrivenChainOfTwelveComesToRestAlike) {
  const TestScene scene = chain(12);
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 4);
  Diagnostics diagnostics;
  auto other = make_simulation("mujoco", scene, {.time_step = kStep}, diagnostics);
  ASSERT_TRUE(other.has_value());
  run(**other, 4);
  for (Index j = 0; j < 12; ++j) {
    EXPECT_NEAR(angle(*simulation, j), angle(**other, j), 1e-3) << j;
  }
}

// By acceleration a drive looks at the inertia that its joint moves, the links behind it included.
TEST_P(Agreement, ADriveByAccelerationMovesAChainAlike) {
  TestScene scene = chain(2);
  scene.scenes[0].gravity = {};
  scene.joints[1].drives.clear();
  scene.joints[0].drives[0] = drive(Dof::RotY, 57, 5.7);
  scene.joints[0].drives[0].acceleration = true;
  scene.joints[0].drives[0].target_position = 0.5;
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 0.25);
  Diagnostics diagnostics;
  auto other = make_simulation("mujoco", scene, {.time_step = kStep}, diagnostics);
  ASSERT_TRUE(other.has_value());
  run(**other, 0.25);
  for (Index j = 0; j < 2; ++j) {
    EXPECT_NEAR(angle(*simulation, j), angle(**other, j), 0.5 * M_PI / 180) << j;
  }
}

// Two hinges whose angles a tendon sums up against its rest length, within one articulation.
TEST_P(Agreement, AFixedTendonPullsItsJointsToItsLength) {
  if (GetParam() == "jolt") {
    return;  // has no tendons
  }
  TestScene scene = chain(2);
  scene.scenes[0].gravity = {};
  scene.joints[0].drives[0].target_position = 0;
  scene.joints[1].drives = {drive(scene.joints[1].dof(), 0, 0.05)};
  scene::Tendon tendon;
  tendon.path = engines::named("tendon");
  tendon.joints = {0, 1};
  tendon.coefficients = {1, -2};
  tendon.stiffness = 5;
  tendon.damping = 0.1;
  tendon.spring_length = {-0.4, -0.4};
  scene.tendons.push_back(tendon);
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  EXPECT_TRUE(simulation->not_mapped().empty());
  run(*simulation, 3);
  EXPECT_NEAR(angle(*simulation, 0) - 2 * angle(*simulation, 1), -0.4, 2e-3);
}

// What hangs on a joint whose frame is elsewhere from a sample on goes along, without a velocity.
TEST_P(Agreement, BodiesGoAlongWithTheFramesOfTheirJoints) {
  if (GetParam() == "jolt") {
    return;  // pulls them there by the joint, 5 cm behind MuJoCo's
  }
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    TestScene scene = pendulum(articulated, false);
    scene::ObjectTrack<scene::Joint> track;
    for (int i = 1; i <= 10; ++i) {
      scene::Joint later = scene.joints[0];
      later.frame0.position[2] += 0.05 * i;
      track.times.push_back(0.04 * i);
      track.states.push_back(later);
    }
    scene.joint_tracks.push_back(track);
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    run(*simulation, 0.6);
    Diagnostics diagnostics;
    auto other = make_simulation("mujoco", scene, {.time_step = kStep}, diagnostics);
    ASSERT_TRUE(other.has_value());
    run(**other, 0.6);
    const scene::BodyState one = simulation->body_state(0);
    const scene::BodyState two = (*other)->body_state(0);
    EXPECT_NEAR(length(one.pose.position - two.pose.position), 0, 5e-3);
    EXPECT_NEAR(length(one.linear_velocity - two.linear_velocity), 0, 0.05);
  }
}

// Torques along the joints alone: k (x* - x) + d (v* - v) at rest against gravity.
TEST_P(Agreement, DrivesPushAsTheirLawSays) {
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    TestScene scene = pendulum(articulated, false);
    scene.joints[0].drives = {drive(Dof::RotY, 30, 3)};
    scene.joints[0].drives[0].target_position = -0.1;
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    run(*simulation, 5);
    const double q = angle(*simulation, 0);
    EXPECT_NEAR(30 * (-0.1 - q) + kG * 0.5 * std::cos(q), 0, 0.01);  // of 5 N m

    TestScene turning = pendulum(articulated, false);
    turning.scenes[0].gravity = {};
    turning.joints[0].drives = {drive(Dof::RotY, 0, 5)};
    turning.joints[0].drives[0].target_velocity = 1.5;
    const auto spun = make(turning);
    ASSERT_NE(spun, nullptr);
    run(*spun, 2);
    EXPECT_NEAR(spun->joint_state(0).velocity.at(0), 1.5, 1e-3);
  }
}

TEST_P(Agreement, LimitsHoldOnBothSides) {
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    TestScene scene = pendulum(articulated, false);
    scene.joints[0].lower = -0.3;
    scene.joints[0].upper = 0.5;
    scene.joints[0].damping = 0.2;
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    run(*simulation, 3);
    EXPECT_NEAR(angle(*simulation, 0), 0.5, 5e-3);
    ASSERT_TRUE(simulation->set_gravity(0, {{0, 0, kG}}).has_value());
    run(*simulation, 3);
    EXPECT_NEAR(angle(*simulation, 0), -0.3, 5e-3);
  }
}

// The follower's law holds while the leader is driven against a load.
TEST_P(Agreement, AMimicFollowsItsLeader) {
  TestScene scene = chain(2);
  scene.joints[1].drives.clear();
  scene::Mimic mimic;
  mimic.dof = Dof::RotZ;
  mimic.leader = 0;
  mimic.leader_dof = Dof::RotY;
  mimic.multiplier = -0.75;
  mimic.offset = 0.1;
  scene.joints[1].mimics = {mimic};
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 3);
  EXPECT_NEAR(angle(*simulation, 1), 0.1 - 0.75 * angle(*simulation, 0), 0.5 * M_PI / 180);
}

TEST_P(Agreement, EffortsActAlongTheirJointAndAgainstTheOtherBody) {
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    TestScene scene = pendulum(articulated, false);
    scene.scenes[0].gravity = {};
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    const double effort = 0.3;
    ASSERT_TRUE(simulation->set_joint_efforts(0, {&effort, 1}).has_value());
    run(*simulation, 1);
    EXPECT_NEAR(simulation->joint_state(0).velocity.at(0), 0.3 / (1.0 / 3), 5e-3);
  }
}

// A cone of 0.3 toward the next axis and 0.6 toward the one after: a rod that is pulled to either
// side stops there (S-96).
TEST_P(Agreement, ConesHaveTheirAnglesOnTheRightSides) {
  if (GetParam() == "mujoco") {
    return;  // says that its cones are round (MuJoCo's own tests)
  }
  const std::pair<Vec3d, double> pulls[] = {{{{0, 5, 0}}, 0.3}, {{{0, 0, 5}}, 0.6}};
  for (const auto& [pull, angle] : pulls) {
    TestScene scene;
    scene.scenes[0].gravity = pull;
    const Index rod = scene.add_body("rod", {{0.5, 0, 0}}, 1, {{0.01, 1.0 / 12, 1.0 / 12}});
    scene::Joint& ball = scene.add_joint("ball", JointKind::Spherical, std::nullopt, rod, Axis::X);
    ball.frame1.position = {{-0.5, 0, 0}};
    ball.cone_angle0 = 0.3;
    ball.cone_angle1 = 0.6;
    scene.bodies[rod].angular_damping = 5;
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    run(*simulation, 3);
    const Vec3d along = rotate(simulation->body_state(rod).pose.orientation, {{1, 0, 0}});
    EXPECT_NEAR(std::acos(along[0]), angle, 0.01);
  }
}

// Two bodies on one joint that nothing else touches keep the momentum that they start with.
TEST_P(Agreement, JointedBodiesKeepTheirMomentum) {
  for (const JointKind kind : {JointKind::Fixed, JointKind::Spherical, JointKind::Revolute}) {
    TestScene scene(0);
    const Index a = scene.add_body("a", {{0, 0, 0}}, 1);
    const Index b = scene.add_body("b", {{1, 0, 0}}, 2);
    scene::Joint& joint = scene.add_joint("joint", kind, a, b, Axis::Z);
    joint.frame0.position = {{0.5, 0, 0}};
    joint.frame1.position = {{-0.5, 0, 0}};
    scene.bodies[b].linear_velocity = {{0, 1, 0}};
    const auto simulation = make(scene);
    ASSERT_NE(simulation, nullptr);
    run(*simulation, 1);
    const Vec3d momentum = simulation->body_state(a).linear_velocity * 1 +
                           simulation->body_state(b).linear_velocity * 2;
    EXPECT_NEAR(momentum[1], 2, 2e-3) << joint_kind_name(kind);
    EXPECT_NEAR(momentum[0], 0, 2e-3) << joint_kind_name(kind);
  }
}

// A kinematic plate at 1 m/s takes a box along.
TEST_P(Agreement, AKinematicBodyPushesWhatItMeets) {
  TestScene scene(0);
  const Index plate = scene.add_body("plate", {{0, 0, 0}});
  const Index load = scene.add_body("load", {{0.3, 0, 0}}, 2);
  scene.bodies[plate].kinematic = true;
  scene.add_collider("plate/box", plate, engines::box({{0.1, 0.1, 0.1}}));
  scene.add_collider("load/box", load, engines::box({{0.1, 0.1, 0.1}}));
  scene.pose_tracks.push_back({plate, {}, {0, 1}, {{{{0, 0, 0}}}, {{{1, 0, 0}}}}, false, {}, 0});
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 0.8);
  EXPECT_NEAR(simulation->body_state(plate).pose.position[0], 0.8, 1e-4);
  EXPECT_NEAR(simulation->body_state(load).linear_velocity[0], 1, 0.03);
  EXPECT_NEAR(simulation->body_state(load).pose.position[0], 1.0, 0.02);
}

// A belt at 0.5 m/s along x carries a box of friction 0.5.
TEST_P(Agreement, ASurfaceThatMovesCarriesWhatLiesOnIt) {
  TestScene scene;
  const Index load = scene.add_body("load", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("load/box", load, engines::box({{0.1, 0.1, 0.1}}));
  const Index body = scene.add_body("belt", {{0, 0, -0.5}});
  scene.bodies[body].kinematic = true;
  const Index belt = scene.add_collider("belt/box", body, engines::box({{5, 5, 0.5}}));
  scene.colliders[belt].settings.surface_velocity = {{{0.5, 0, 0}}, {}, true};
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 1);
  EXPECT_NEAR(simulation->body_state(load).linear_velocity[0], 0.5, 0.02);
  EXPECT_NEAR(simulation->body_state(load).pose.position[2], 0.1, 2e-3);
}

TEST_P(Agreement, TriggersTouchNothingAndTell) {
  TestScene scene;
  const Index ball = scene.add_body("ball", {{0, 0, 2}});
  scene.add_collider("ball/shape", ball, engines::sphere(0.1));
  const Index zone =
      scene.add_collider("zone", std::nullopt, engines::box({{1, 1, 0.2}}), {{{0, 0, 1}}});
  scene.colliders[zone].settings.trigger = true;
  const auto simulation = make(scene);
  ASSERT_NE(simulation, nullptr);
  run(*simulation, 0.8);
  EXPECT_NEAR(simulation->body_state(ball).pose.position[2], 2 - kG * 0.64 / 2, 0.01);
  ASSERT_EQ(simulation->events().size(), 2u);
  EXPECT_EQ(simulation->events()[0].prim.str(), "/zone");
  // In when the ball's lower side reaches z = 1.2, out when its upper side leaves z = 0.8.
  EXPECT_NEAR(simulation->events()[0].time, std::sqrt(2 * 0.7 / kG), 5e-3);
  EXPECT_NEAR(simulation->events()[1].time, std::sqrt(2 * 1.3 / kG), 5e-3);
}

TEST_P(Agreement, RunsAreTheSameBitForBit) {
  const TestScene scene = chain(5);
  const auto one = make(scene);
  const auto other = make(scene);
  ASSERT_TRUE(one != nullptr && other != nullptr);
  run(*one, 1);
  run(*other, 1);
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    EXPECT_EQ(one->body_state(b).pose, other->body_state(b).pose);
    EXPECT_EQ(one->body_state(b).angular_velocity, other->body_state(b).angular_velocity);
  }
}

}  // namespace
}  // namespace tenon
