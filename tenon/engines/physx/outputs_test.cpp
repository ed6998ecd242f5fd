// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts, reactions, efforts, work and saved states against closed forms. PhysX computes in
// single precision, and its solver comes near what it solves within its iterations.
#include <cmath>

#include "tenon/engines/physx/test_scene.h"

namespace tenon::engines::physx {
namespace {

using scene::Dof;
using scene::Index;
using scene::JointKind;

std::unique_ptr<PhysxSimulation> watched(const scene::PhysicsScene& scene,
                                         double time_step = 0.002) {
  Diagnostics diagnostics;
  SimulationOptions options{.time_step = time_step};
  options.outputs = {
      .contacts = true, .efforts = true, .reactions = true, .accelerations = true, .work = true};
  auto made = PhysxSimulation::make(scene, options, diagnostics);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  return made.has_value() ? *std::move(made) : nullptr;
}

void expect_near(const Vec3d& value, const Vec3d& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(value[i], wanted[i], tolerance) << i;
  }
}

/// All joints of one articulation that hangs on the world.
void articulate(TestScene& scene) {
  scene::Articulation tree{named("tree"), scene.joints[0].path, true, {}, {}, {}, true};
  for (Index j = 0; j < scene.joints.size(); ++j) {
    scene.joints[j].articulation = 0;
    tree.joints.push_back(j);
  }
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    tree.links.push_back(b);
  }
  scene.articulations.push_back(tree);
}

// Boxes of 1 kg slide on ground that slopes by 45 degrees, with friction of 0.2 of the normal
// force; of five the solver takes four together.
TEST(PhysxContacts, FrictionActsAgainstSliding) {
  for (const int count : {1, 5}) {
    for (const bool plane_first : {true, false}) {
      SCOPED_TRACE(count);
      const double part = kG * std::sin(M_PI / 4);
      TestScene scene;
      scene.scenes[0].gravity = {{part, 0, -part}};
      scene.unbound.static_friction = scene.unbound.dynamic_friction = 0.2;
      if (plane_first) {
        scene.add_collider("plane", {}, ground());
      }
      for (int i = 0; i < count; ++i) {
        const Index body =
            scene.add_body("box" + std::to_string(i), {{0, 1.0 * i, 0.1}}, 1, {{0.01, 0.01, 0.01}});
        scene.add_collider("shape" + std::to_string(i), body, box({{0.1, 0.1, 0.1}}));
      }
      if (!plane_first) {
        scene.add_collider("plane", {}, ground());
      }
      const auto slide = watched(scene);
      run(*slide, 0.5);
      const double sign = plane_first ? 1 : -1;  // the box is collider 1, or 0
      std::vector<Vec3d> force(static_cast<std::size_t>(count));
      const std::vector<Contact> touching = *slide->contacts();
      for (const Contact& contact : touching) {
        force[*(plane_first ? contact.body1 : contact.body0)] += contact.force() * sign;
        EXPECT_NEAR(contact.normal[2], sign, 1e-3);
        EXPECT_NEAR(dot(contact.friction_force, contact.normal), 0, 1e-3);
      }
      for (Index b = 0; b < force.size(); ++b) {
        EXPECT_NEAR(force[b][2], part, 0.02 * part);
        EXPECT_NEAR(force[b][0], -0.2 * force[b][2], 1e-3 * part);
        EXPECT_NEAR(slide->body_acceleration(b)->linear[0], part + force[b][0], 2e-3);
      }
    }
  }
}

TEST(PhysxContacts, OfLinksOfArticulationsHaveTheirFriction) {
  TestScene scene;  // a sledge on a rail along x, pressed on the ground by its weight
  const Index body = scene.add_body("sledge", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  const Index lift = scene.add_body("lift", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_joint("rail", JointKind::Prismatic, {}, lift, scene::Axis::X).frame0.position = {
      {0, 0, 0.1}};
  scene.add_joint("slide", JointKind::Prismatic, lift, body, scene::Axis::Z);
  articulate(scene);
  scene.unbound.static_friction = scene.unbound.dynamic_friction = 0.3;
  scene.add_collider("ground", {}, ground());
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  const auto sledge = watched(scene);
  const double push = 10;
  ASSERT_TRUE(sledge->set_joint_efforts(0, {&push, 1}).has_value());
  run(*sledge, 0.5);
  Vec3d force;
  const std::vector<Contact> touching = *sledge->contacts();
  for (const Contact& contact : touching) {
    force += contact.force() * (contact.body1 == body ? 1 : -1);
  }
  EXPECT_NEAR(force[2], kG, 0.02 * kG);
  EXPECT_NEAR(force[0], -0.3 * force[2], 0.02);
  EXPECT_NEAR(sledge->body_acceleration(body)->linear[0], (push + force[0]) / 2, 0.02);
}

TEST(PhysxContacts, FrictionThatIsSetActsOnWhatLiesThere) {
  TestScene scene;
  scene.scenes[0].gravity = {{3, 0, -kG}};
  const Index body = scene.add_body("box", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("plane", {}, ground());
  const Index shape = scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  const auto lies = watched(scene);
  run(*lies, 1);
  EXPECT_LT(lies->body_state(body).linear_velocity[0], 1e-3);
  ASSERT_TRUE(lies->set_parameter({Parameter::ColliderFriction, shape, 0}, 0).has_value());
  run(*lies, 0.01);
  const double before = lies->body_state(body).linear_velocity[0];
  run(*lies, 0.5);  // the mean of 0 and the ground's 0.5
  EXPECT_NEAR(lies->body_state(body).linear_velocity[0] - before, 0.5 * (3 - 0.25 * kG), 0.02);
}

/// A pendulum of length 0.5 m about y; its hinge is body 0 of the joint, or body 1 where reversed.
TestScene pendulum(bool reversed, bool articulated) {
  TestScene scene;
  const double start = 0.8;
  const Vec3d position{{-0.5 * std::sin(start), 0, -0.5 * std::cos(start)}};
  const Index body = scene.add_body("bob", position, 2, {{0.02, 0.02, 0.02}});
  scene.bodies[body].pose.orientation = rotation_about({{0, 1, 0}}, start);
  scene::Joint& joint =
      reversed ? scene.add_joint("hinge", JointKind::Revolute, body, {}, scene::Axis::Y)
               : scene.add_joint("hinge", JointKind::Revolute, {}, body, scene::Axis::Y);
  (reversed ? joint.frame0 : joint.frame1).position = {{0, 0, 0.5}};
  if (articulated) {
    articulate(scene);
  }
  return scene;
}

// m a = F + m g of the bob; about the hinge nothing carries a torque.
TEST(PhysxReactions, OfAPendulumAreMassTimesAccelerationLessWeight) {
  for (const bool articulated : {true, false}) {
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(std::string(articulated ? "articulated" : "maximal") +
                   (reversed ? " reversed" : ""));
      const TestScene scene = pendulum(reversed, articulated);
      const auto swing = watched(scene);
      run(*swing, 0.3);
      const BodyState before = swing->body_state(0);
      run(*swing, 0.002);
      const BodyAcceleration acceleration = *swing->body_acceleration(0);
      const Vec3d arm = rotate(before.pose.orientation, {{0, 0, -0.5}});
      const Vec3d spin = before.angular_velocity;
      const Vec3d wanted = cross(acceleration.angular, arm) + cross(spin, cross(spin, arm));
      expect_near(acceleration.linear, wanted, 0.05);
      const double drift = articulated ? 0.02 : 0.05;  // constraints also bring back what is off
      const double angular =
          -2 * kG * 0.5 * std::sin(rotation_vector(before.pose.orientation)[1]) / (0.02 + 2 * 0.25);
      EXPECT_NEAR(acceleration.angular[1], angular, drift);
      EXPECT_NEAR((*swing->joint_acceleration(0))[0], (reversed ? -1 : 1) * angular, drift);
      const Vec3d on_bob = (acceleration.linear + Vec3d{{0, 0, kG}}) * 2;
      const Wrench reaction = *swing->joint_reaction(0);
      expect_near(reaction.force, on_bob * (reversed ? -1 : 1), 1e-3);
      expect_near(reaction.torque, {}, 0.03);
    }
  }
}

/// A horizontal beam of three pieces of 1 m and 1 kg on fixed joints, which begins at a wall. As a
/// loop its last joint is excluded from the tree.
TestScene beam(bool loop, bool articulated) {
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
    last = body;
  }
  if (articulated) {
    articulate(scene);
  }
  if (loop) {  // the last piece hangs in the tree elsewhere, on a joint that carries nothing
    scene.joints[2].exclude_from_articulation = true;
    scene.joints[2].articulation.reset();
    scene.add_joint("free", JointKind::D6, {}, *last).frame1.position = {{0.5, 0, 0}};
    scene.joints.back().frame0.position = {{3, 0, 0}};
  }
  return scene;
}

// Joint i carries n = 3 - i pieces: F = n m g, T = F n / 2 about y (r x F with r = n / 2 x).
TEST(PhysxReactions, OfABeamOfFixedJointsAreShearAndMoment) {
  for (const bool articulated : {true, false}) {
    for (const bool loop : {false, true}) {
      SCOPED_TRACE(std::string(articulated ? "articulated" : "maximal") + (loop ? " loop" : ""));
      const TestScene scene = beam(loop, articulated);
      const auto held = watched(scene);
      run(*held, 4);
      for (Index i = 0; i < 3; ++i) {
        const double n = 3 - i;
        const Wrench reaction = *held->joint_reaction(i);
        expect_near(reaction.force, {{0, 0, n * kG}}, 0.05);
        expect_near(reaction.torque, {{0, -n * kG * n / 2, 0}}, 0.3);
      }
    }
  }
}

TEST(PhysxReactions, OfADistanceJointPullAlongTheLine) {
  TestScene scene;
  const Index body = scene.add_body("hung", {{0, 0, -1}}, 2);
  scene::Joint& rope = scene.add_joint("rope", JointKind::Distance, {}, body);
  rope.upper = 1;
  const auto hung = watched(scene);
  run(*hung, 5);
  Vec3d mean;
  for (int i = 0; i < 100; ++i) {  // PhysX pulls where the rope is too long: not at every step
    run(*hung, 0.002);
    mean += hung->joint_reaction(0)->force * 0.01;
  }
  expect_near(mean, {{0, 0, 2 * kG}}, 0.5);
}

// At rest the drive carries the weight; the reaction has its torque.
TEST(PhysxEfforts, OfADriveAtRestCarryTheWeight) {
  for (const bool articulated : {true, false}) {
    // By acceleration PhysX looks at the inertia of the body alone, not of the body on its hinge.
    for (const bool acceleration : {false, articulated}) {
      SCOPED_TRACE(std::string(articulated ? "articulated" : "maximal") +
                   (acceleration ? " acceleration" : ""));
      TestScene scene = pendulum(false, articulated);
      scene.joints[0].drives.push_back(drive(Dof::RotY, 200, 20));
      scene.joints[0].drives[0].target_position = 1;
      scene.joints[0].drives[0].acceleration = acceleration;
      const auto held = watched(scene);
      run(*held, 8);
      const double q = held->joint_state(0).position[0];
      const double weight = 2 * kG * 0.5 * std::sin(q);
      double effort = 0;
      double torque = 0;
      for (int i = 0; i < 100; ++i) {
        run(*held, 0.002);
        effort += (*held->drive_efforts(0))[0] / 100;
        torque += held->joint_reaction(0)->torque[1] / 100;
      }
      EXPECT_NEAR(effort, weight, 0.05);
      EXPECT_NEAR(torque, weight, 0.05);
    }
  }
}

// I (v' - v) / dt = effort.
TEST(PhysxEfforts, OfADriveInMotionAreThoseThatMoved) {
  for (const double stiffness : {5.0, 3e3}) {
    TestScene scene(0);
    const Index body = scene.add_body("wheel", {}, 1, {{0.2, 0.2, 0.2}});
    scene.add_joint("hinge", JointKind::Revolute, {}, body)
        .drives.push_back(drive(Dof::RotX, stiffness, 3));
    scene.joints[0].axis = scene::Axis::X;
    scene.joints[0].drives[0].target_position = 0.5;
    articulate(scene);
    const auto wheel = watched(scene);
    for (int i = 0; i < 20; ++i) {
      const double before = wheel->joint_state(0).velocity[0];
      run(*wheel, 0.002);
      const double effort = 0.2 * (wheel->joint_state(0).velocity[0] - before) / 0.002;
      EXPECT_NEAR((*wheel->drive_efforts(0))[0], effort, 1e-3 * (1 + std::abs(effort))) << i;
    }
  }
}

/// A wheel whose drive and own spring pull it two ways, with a damper of its own.
TestScene sprung_wheel(double inertia, double damping, bool articulated) {
  TestScene scene(0);
  const Index body = scene.add_body("wheel", {}, 1, {{inertia, inertia, inertia}});
  scene::Joint& hinge = scene.add_joint("hinge", JointKind::Revolute, {}, body, scene::Axis::X);
  hinge.drives.push_back(drive(Dof::RotX, 200, 0));
  hinge.drives[0].target_position = 0.5;
  hinge.stiffness = 100;
  hinge.spring_reference = 0.2;
  hinge.damping = damping;
  if (articulated) {
    articulate(scene);
  }
  return scene;
}

// Between both targets, by exp(-(k1 + k2) t / d); d dt is four times the inertia, so beside the
// drive the damper would throw the wheel about.
TEST(PhysxEfforts, OfAStiffDamperBesideADriveHoldTheWheelBack) {
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    const TestScene scene = sprung_wheel(0.01, 20, articulated);
    const auto wheel = watched(scene);
    for (const double time : {0.05, 0.1, 0.15}) {
      run(*wheel, 0.05);
      const double place = wheel->joint_state(0).position[0];
      EXPECT_NEAR(place, 0.4 * (1 - std::exp(-15 * time)), 0.005) << time;
      EXPECT_NEAR((*wheel->drive_efforts(0))[0], 200 * (0.5 - place), 2) << time;
    }
  }
}

// The same with a bound on the drive's force, at which it stays until 200 (0.5 - q) is less.
TEST(PhysxEfforts, OfBoundedDrivesBesideAStiffDamperAreAtTheirBoundOrBelow) {
  const double below = std::log(0.8 / 0.6) / 5;  // [s] until q is 0.2
  for (const double bound : {15.0, 60.0}) {
    SCOPED_TRACE(bound);
    TestScene scene = sprung_wheel(0.01, 20, true);
    scene.joints[0].drives[0].max_force = bound;
    const auto wheel = watched(scene, 0.0005);
    for (double time = 0.025; time < 0.4; time += 0.025) {
      run(*wheel, 0.025);
      const double place = wheel->joint_state(0).position[0];
      const double wanted = bound < 20     ? 0.35 * (1 - std::exp(-5 * time))
                            : time < below ? 0.8 * (1 - std::exp(-5 * time))
                                           : 0.4 - 0.2 * std::exp(-15 * (time - below));
      EXPECT_NEAR(place, wanted, 0.006) << time;
      EXPECT_NEAR((*wheel->drive_efforts(0))[0], std::min(bound, 200 * (0.5 - wanted)), 3) << time;
    }
  }
}

// A finger as URDF has it: 1e-5 kg m^2 with a damper of 10, and a drive with more damping still.
TEST(PhysxEfforts, OfALightFingerMoveItAsFastAsItsDamperLetsThem) {
  TestScene scene = sprung_wheel(1e-5, 10, true);
  scene.joints[0].stiffness = 0;
  scene.joints[0].drives[0] = drive(Dof::RotX, 300, 20);
  scene.joints[0].drives[0].target_position = 1;
  scene.joints[0].drives[0].max_force = 15;
  const auto finger = watched(scene);
  for (int i = 0; i < 500; ++i) {
    run(*finger, 0.002);
    EXPECT_LT(std::abs(finger->joint_state(0).velocity[0]), 1.55) << i;
    EXPECT_LE(std::abs((*finger->drive_efforts(0))[0]), 15.01) << i;
  }
  EXPECT_NEAR(finger->joint_state(0).position[0], 1, 0.01);
}

// A drive of bounded force has no room for the spring and the damper, which act all the same, also
// where the bound comes and goes.
TEST(PhysxEfforts, OfSpringsBesideDrivesAreTheSameWhateverBoundsThese) {
  const TestScene scene = sprung_wheel(0.2, 3, true);
  TestScene scene_with_bound = scene;
  scene_with_bound.joints[0].drives[0].max_force = 1e4;
  const auto free = watched(scene, 0.0005);
  const auto bounded = watched(scene_with_bound, 0.0005);
  const auto changed = watched(scene, 0.0005);
  for (int i = 0; i < 10; ++i) {
    const double bound = i % 2 == 0 ? 1e4 : scene::kUnlimited;
    ASSERT_TRUE(changed->set_parameter({Parameter::DriveMaxForce, 0, 0}, bound).has_value());
    for (const auto& wheel : {&free, &bounded, &changed}) {
      run(**wheel, 0.02);
    }
    const double place = free->joint_state(0).position[0];
    EXPECT_NEAR(bounded->joint_state(0).position[0], place, 0.01) << i;
    EXPECT_NEAR(changed->joint_state(0).position[0], place, 0.01) << i;
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

/// What an integrator of first order has to show: half the error at half the step.
void expect_closes(const scene::PhysicsScene& scene, double seconds, double bound) {
  EXPECT_LT(imbalance(scene, 0.002, seconds), bound);
  EXPECT_LT(imbalance(scene, 0.0005, seconds), bound / 3);
}

TEST(PhysxWork, ClosesForDrivesDampingAndLimits) {
  for (const bool articulated : {true, false}) {
    SCOPED_TRACE(articulated ? "articulated" : "maximal");
    TestScene scene = pendulum(false, false);
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
    scene.joints[1].friction = 0.05;
    scene.joints[1].armature = articulated ? 0.02 : 0;
    scene.bodies[second].linear_damping = 0.2;
    if (articulated) {
      articulate(scene);
    }
    expect_closes(scene, 1.5, 0.05);
  }
}

TEST(PhysxWork, ClosesForContacts) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  const Index body = scene.add_body("box", {{0, 0, 0.3}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[body].linear_velocity = {{2, 0, 0}};
  scene.bodies[body].angular_damping = 0.5;
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  expect_closes(scene, 1, 0.03);
}

TEST(PhysxWork, ClosesWhenGravityIsAnimated) {
  TestScene scene = pendulum(false, true);
  scene::GravityTrack gravity;
  gravity.times = {0, 1};
  gravity.gravity = {{{0, 0, -kG}}, {{0, 3, -2}}};
  scene.gravity_tracks.push_back(gravity);
  expect_closes(scene, 1, 0.05);
}

// What PhysX keeps between steps of contacts is in a state: the steps after it are the same.
TEST(PhysxStates, OfAPileThatIsPushedContinueBitForBit) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  for (int i = 0; i < 6; ++i) {
    const Index body = scene.add_body("box" + std::to_string(i), {{0.01 * i, 0, 0.1 + 0.21 * i}}, 1,
                                      {{0.01, 0.01, 0.01}});
    scene.add_collider("shape" + std::to_string(i), body, box({{0.1, 0.1, 0.1}}));
  }
  const auto one = watched(scene);
  run(*one, 0.4);
  ASSERT_TRUE(one->set_body_wrench(5, {{{3, 1, 0}}, {}}).has_value());
  run(*one, 0.2);
  const Result<std::string> state = one->save_state();
  ASSERT_TRUE(state.has_value());
  const auto other = watched(scene);
  ASSERT_TRUE(other->restore_state(*state).has_value());
  run(*one, 0.5);
  run(*other, 0.5);
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    EXPECT_EQ(one->body_state(b).pose, other->body_state(b).pose);
    EXPECT_EQ(one->body_state(b).angular_velocity, other->body_state(b).angular_velocity);
  }
  EXPECT_EQ(one->work()->total(), other->work()->total());
}

}  // namespace
}  // namespace tenon::engines::physx
