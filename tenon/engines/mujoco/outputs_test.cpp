// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts, reactions, efforts, accelerations and work against closed forms.
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Dof;
using scene::Index;
using scene::JointKind;

constexpr double kFine = 0.0005;  // [s]

std::unique_ptr<MujocoSimulation> watched(const scene::PhysicsScene& scene,
                                          double time_step = kFine) {
  Diagnostics diagnostics;
  SimulationOptions options{.time_step = time_step};
  options.outputs = {
      .contacts = true, .efforts = true, .reactions = true, .accelerations = true, .work = true};
  auto made = MujocoSimulation::make(scene, options, diagnostics);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  return made.has_value() ? *std::move(made) : nullptr;
}

void expect_ok_step(Simulation& simulation) {
  const Result<void> done = simulation.step();
  ASSERT_TRUE(done.has_value()) << done.error().to_string();
}

void expect_near(const Vec3d& value, const Vec3d& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(value[i], wanted[i], tolerance) << i;
  }
}

TEST(Contacts, OfARestingStackCarryItsWeight) {
  TestScene scene;
  double weight = 0;
  double height = 0;
  for (int i = 0; i < 4; ++i) {
    const double mass = 4 - i;
    const double half = 0.2 - 0.04 * i;
    const Index body = scene.add_body("b" + std::to_string(i), {{0, 0, height + half}}, mass,
                                      Vec3d{{1, 1, 1}} * (mass * half * half * 2 / 3));
    scene.add_collider("c" + std::to_string(i), body, box({{half, half, half}}));
    height += 2 * half;
    weight += mass * kG;
  }
  const Index ground_shape = scene.add_collider("ground", {}, ground());
  const auto stack = watched(scene, 0.002);
  run(*stack, 10);
  Vec3d on_ground;
  Vec3d on_lowest;
  const std::vector<Contact> touching = *stack->contacts();
  for (const Contact& contact : touching) {
    EXPECT_LT(contact.collider0, contact.collider1);
    EXPECT_EQ(contact.body0, scene.colliders[contact.collider0].body);
    EXPECT_EQ(contact.body1, scene.colliders[contact.collider1].body);
    EXPECT_GE(contact.normal_force, 0);
    EXPECT_NEAR(dot(contact.friction_force, contact.normal), 0, 1e-9);
    EXPECT_LT(std::abs(contact.depth), 0.005);
    if (contact.collider1 == ground_shape) {  // the normal leads down, out of the box
      EXPECT_NEAR(contact.normal[2], -1, 1e-9);
      EXPECT_NEAR(contact.point[2], 0, 0.005);
      on_ground += contact.force();
    } else if (contact.collider0 == 0) {
      on_lowest -= contact.force();
    }
  }
  EXPECT_NEAR(-on_ground[2], weight, 1e-6 * weight);
  EXPECT_NEAR(-on_lowest[2], weight - 4 * kG, 1e-6 * weight);
}

// A box slides down a plane at 45 degrees: friction of 0.2 of the normal force pushes it up. The
// plane is the collider that comes first, or last.
TEST(Contacts, FrictionActsAgainstSliding) {
  for (const bool plane_first : {true, false}) {
    const double part = kG * std::sin(M_PI / 4);
    TestScene scene;
    scene.scenes[0].gravity = {{part, 0, -part}};
    scene.unbound.dynamic_friction = 0.2;
    const Index body = scene.add_body("box", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
    if (plane_first) {
      scene.add_collider("plane", {}, ground());
    }
    scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
    if (!plane_first) {
      scene.add_collider("plane", {}, ground());
    }
    const auto slide = watched(scene, 0.002);
    run(*slide, 0.2);
    const double sign = plane_first ? 1 : -1;  // the box is collider 1, or 0
    constexpr int kSteps = 200;                // the box chatters: means are looked at
    Vec3d force;
    double acceleration = 0;
    for (int i = 0; i < kSteps; ++i) {
      expect_ok_step(*slide);
      acceleration += slide->body_acceleration(body)->linear[0] / kSteps;
      const std::vector<Contact> touching = *slide->contacts();
      for (const Contact& contact : touching) {
        force += contact.force() * (sign / kSteps);
        EXPECT_NEAR(contact.normal[2], sign, 1e-3);
      }
    }
    EXPECT_NEAR(force[2], part, 0.1 * part);
    EXPECT_NEAR(force[0], -0.2 * force[2], 1e-3 * part);
    EXPECT_NEAR(acceleration, part + force[0], 1e-9);
  }
}

/// A pendulum of length 0.5 m about y; its hinge is body 0 of the joint, or body 1 where reversed.
TestScene pendulum(bool reversed) {
  TestScene scene;
  const double start = 0.8;
  const Vec3d position{{-0.5 * std::sin(start), 0, -0.5 * std::cos(start)}};
  const Index body = scene.add_body("bob", position, 2, {{0.02, 0.02, 0.02}});
  scene.bodies[body].pose.orientation = rotation_about({{0, 1, 0}}, start);
  scene::Joint& joint =
      reversed ? scene.add_joint("hinge", JointKind::Revolute, body, {}, scene::Axis::Y)
               : scene.add_joint("hinge", JointKind::Revolute, {}, body, scene::Axis::Y);
  (reversed ? joint.frame0 : joint.frame1).position = {{0, 0, 0.5}};
  return scene;
}

// m a = F + m g of the bob; about the hinge nothing carries a torque.
TEST(Reactions, OfAPendulumAreMassTimesAccelerationLessWeight) {
  for (const bool reversed : {false, true}) {
    const TestScene scene = pendulum(reversed);
    const auto swing = watched(scene);
    run(*swing, 0.3);
    const BodyState before = swing->body_state(0);
    expect_ok_step(*swing);
    const BodyAcceleration acceleration = *swing->body_acceleration(0);
    // a = w' x r + w x (w x r), of the pose at the beginning of the step.
    const Vec3d arm = rotate(before.pose.orientation, {{0, 0, -0.5}});
    const Vec3d spin = before.angular_velocity;
    const Vec3d wanted = cross(acceleration.angular, arm) + cross(spin, cross(spin, arm));
    expect_near(acceleration.linear, wanted, 1e-9);
    const double angular =
        -2 * kG * 0.5 * std::sin(rotation_vector(before.pose.orientation)[1]) / (0.02 + 2 * 0.25);
    EXPECT_NEAR(acceleration.angular[1], angular, 1e-9);
    EXPECT_NEAR((*swing->joint_acceleration(0))[0], (reversed ? -1 : 1) * angular, 1e-9);
    const Vec3d on_bob = (acceleration.linear + Vec3d{{0, 0, kG}}) * 2;
    const Wrench reaction = *swing->joint_reaction(0);
    expect_near(reaction.force, on_bob * (reversed ? -1 : 1), 1e-9);
    expect_near(reaction.torque, {}, 1e-9);
  }
}

/// A horizontal beam of three pieces of 1 m and 1 kg on fixed joints, which begins at a wall.
TestScene beam(bool loop) {
  TestScene scene;
  std::optional<Index> last;
  for (int i = 0; i < 3; ++i) {
    const Index body =
        scene.add_body("b" + std::to_string(i), {{i + 0.5, 0, 0}}, 1, {{0.01, 0.1, 0.1}});
    scene::Joint& joint = scene.add_joint("j" + std::to_string(i), JointKind::Fixed, last, body);
    joint.frame0.position = {{last ? 0.5 : 0, 0, 0}};
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.frame1.orientation = rotation_about({{0, 0, 1}}, 0.7);
    joint.frame0.orientation = joint.frame1.orientation;
    joint.exclude_from_articulation = loop && i == 2;
    last = body;
  }
  if (loop) {  // the last piece hangs in the tree elsewhere, on a joint that carries nothing
    scene.add_joint("free", JointKind::D6, {}, *last).frame1.position = {{0.5, 0, 0}};
    scene.joints.back().frame0.position = {{3, 0, 0}};
  }
  return scene;
}

// Joint i carries n = 3 - i pieces: F = n m g, T = F n / 2 about y (r x F with r = n / 2 x).
TEST(Reactions, OfABeamOfFixedJointsAreShearAndMoment) {
  for (const bool loop : {false, true}) {
    const TestScene scene = beam(loop);
    const auto held = watched(scene, 0.002);
    run(*held, loop ? 4 : 0.1);
    for (Index i = 0; i < 3; ++i) {
      const double n = 3 - i;
      const Wrench reaction = *held->joint_reaction(i);
      const double tolerance = loop ? 1e-3 : 1e-9;
      expect_near(reaction.force, {{0, 0, n * kG}}, tolerance);
      expect_near(reaction.torque, {{0, -n * kG * n / 2, 0}}, tolerance);
    }
  }
}

TEST(Reactions, OfADistanceJointPullAlongTheLine) {
  TestScene scene;
  const Index body = scene.add_body("hung", {{0, 0, -1}}, 2);
  scene::Joint& rope = scene.add_joint("rope", JointKind::Distance, {}, body);
  rope.upper = 1;
  const auto hung = watched(scene, 0.002);
  run(*hung, 5);
  expect_near(hung->joint_reaction(0)->force, {{0, 0, 2 * kG}}, 1e-4);
}

// At rest the drive carries the weight; the reaction has its torque.
TEST(Efforts, OfADriveAtRestCarryTheWeight) {
  TestScene scene = pendulum(false);
  scene.joints[0].drives.push_back(drive(Dof::RotY, 200, 20));
  scene.joints[0].drives[0].target_position = 1;
  const auto held = watched(scene, 0.002);
  run(*held, 8);
  const double q = held->joint_state(0).position[0];
  const double effort = 200 * (1 - q);
  EXPECT_NEAR(effort, 2 * kG * 0.5 * std::sin(q), 1e-6);
  EXPECT_NEAR((*held->drive_efforts(0))[0], effort, 1e-9);
  EXPECT_NEAR(held->joint_reaction(0)->torque[1], effort, 1e-6);
}

// I (v' - v) / dt = effort: what drives exert in truth, though the integrator is implicit.
TEST(Efforts, OfADriveInMotionAreThoseThatMoved) {
  for (const double stiffness : {5.0, 3e5}) {  // the second one asks for the step implicit in q
    TestScene scene(0);
    const Index body = scene.add_body("wheel", {}, 1, {{0.2, 0.2, 0.2}});
    scene.add_joint("hinge", JointKind::Revolute, {}, body)
        .drives.push_back(drive(Dof::RotX, stiffness, 3));
    scene.joints[0].axis = scene::Axis::X;
    scene.joints[0].damping = 0.4;
    scene.joints[0].drives[0].target_position = 0.5;
    const auto wheel = watched(scene, 0.002);
    for (int i = 0; i < 20; ++i) {
      const double before = wheel->joint_state(0).velocity[0];
      expect_ok_step(*wheel);
      const double after = wheel->joint_state(0).velocity[0];
      const double effort = 0.2 * (after - before) / 0.002 + 0.4 * after;
      EXPECT_NEAR((*wheel->drive_efforts(0))[0], effort, 1e-9 * (1 + std::abs(effort))) << i;
    }
  }
}

/// What the balance of energy lacks after a run, relative to what was turned over.
double imbalance(const scene::PhysicsScene& scene, double time_step, double seconds) {
  const auto simulation = watched(scene, time_step);
  const double start = simulation->energy().total();
  run(*simulation, seconds);
  const Work work = *simulation->work();
  const double turned_over = std::abs(work.drives) + std::abs(work.contacts) +
                             std::abs(work.damping) + std::abs(work.constraints) +
                             std::abs(work.applied) + std::abs(work.changes);
  EXPECT_GT(turned_over, 0.1);
  return std::abs(simulation->energy().total() - start - work.total()) / turned_over;
}

/// What MuJoCo's integrator, of first order, has to show: half the error at half the step.
void expect_closes(const scene::PhysicsScene& scene, double seconds, double bound) {
  const double coarse = imbalance(scene, 0.002, seconds);
  const double fine = imbalance(scene, 0.0005, seconds);
  EXPECT_LT(coarse, bound);
  EXPECT_LT(fine, bound / 3);
}

TEST(WorkBalance, ClosesForDrivesDampingAndLimits) {
  TestScene scene = pendulum(false);
  const Quatd turn = scene.bodies[0].pose.orientation;
  const Index second =
      scene.add_body("second", rotate(turn, {{0, 0, -1}}), 1, {{0.05, 0.05, 0.05}});
  scene.bodies[second].pose.orientation = turn;
  scene::Joint& elbow = scene.add_joint("elbow", JointKind::Revolute, 0, second, scene::Axis::Y);
  elbow.frame0.position = {{0, 0, -0.2}};
  elbow.frame1.position = {{0, 0, 0.3}};
  elbow.lower = -0.4;
  elbow.upper = 0.4;
  scene.joints[0].drives.push_back(drive(Dof::RotY, 15, 0.6));
  scene.joints[0].drives[0].target_position = -1;
  scene.joints[0].damping = 0.2;
  scene.joints[1].friction = 0.05;
  scene.bodies[second].linear_damping = 0.2;
  expect_closes(scene, 1.5, 0.03);
}

TEST(WorkBalance, ClosesForContacts) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  const Index body = scene.add_body("box", {{0, 0, 0.3}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[body].linear_velocity = {{2, 0, 0}};
  scene.bodies[body].angular_damping = 0.5;
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  expect_closes(scene, 1, 0.03);
}

TEST(WorkBalance, ClosesWhenGravityIsAnimated) {
  TestScene scene = pendulum(false);
  scene::GravityTrack gravity;
  gravity.times = {0, 1};
  gravity.gravity = {{{0, 0, -kG}}, {{0, 3, -2}}};
  scene.gravity_tracks.push_back(gravity);
  expect_closes(scene, 1, 0.03);
}

TEST(WorkBalance, OfWhatABodyThatIsMovedPushesIsThatOfTheContact) {
  TestScene scene(0);
  const Index free = scene.add_body("free", {{0.25, 0, 0}}, 2);
  const Index pusher = scene.add_body("pusher", {});
  scene.bodies[pusher].kinematic = true;
  scene.add_collider("a", free, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("b", pusher, box({{0.1, 0.1, 0.1}}));
  const auto pushed = watched(scene, kFine);
  for (int i = 1; i <= 1000; ++i) {
    ASSERT_TRUE(pushed->move_kinematic(pusher, {{{i * 0.0005, 0, 0}}}).has_value());
    expect_ok_step(*pushed);
  }
  EXPECT_GT(pushed->energy().kinetic, 0.9);
  EXPECT_NEAR(pushed->work()->contacts, pushed->energy().kinetic, 1e-3);
}

}  // namespace
}  // namespace tenon::engines::mujoco
