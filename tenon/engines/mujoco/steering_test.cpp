// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Control and saved states where MuJoCo's adapter does more than pass them on.
#include <cmath>

#include "tenon/engines/environments.h"
#include "tenon/engines/mujoco/mujoco_engine.h"
#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/scene/fields/wire_form.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Dof;
using scene::Index;
using scene::JointKind;

constexpr double kStep = 0.001;  // [s]

/// An arm on a hinge about y in the world, its centre of mass 0.5 m below the hinge.
TestScene arm(double g = kG) {
  TestScene scene(g);
  const Index body = scene.add_body("arm", {{0, 0, -0.5}}, 1, {{0.1, 0.1, 0.1}});
  scene::Joint& joint = scene.add_joint("hinge", JointKind::Revolute, {}, body, scene::Axis::Y);
  joint.frame1.position = {{0, 0, 0.5}};
  return scene;
}

void expect_ok(const Result<void>& done) {
  EXPECT_TRUE(done.has_value()) << (done.has_value() ? "" : done.error().to_string());
}

double angle(const Simulation& simulation) { return simulation.joint_state(0).position[0]; }

void expect_same(const Simulation& a, const Simulation& b, const scene::PhysicsScene& scene) {
  EXPECT_EQ(a.time(), b.time());
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_EQ(a.body_state(i).pose, b.body_state(i).pose) << i;
    EXPECT_EQ(a.body_state(i).linear_velocity, b.body_state(i).linear_velocity) << i;
  }
  ASSERT_EQ(a.events().size(), b.events().size());
  for (std::size_t i = 0; i < a.events().size(); ++i) {
    EXPECT_EQ(a.events()[i].time, b.events()[i].time);
    EXPECT_EQ(a.events()[i].what, b.events()[i].what);
  }
}

/// Runs to `seconds`, restores that into another simulation, and runs both on.
void expect_continues(const scene::PhysicsScene& scene, double seconds, double further) {
  const auto one = simulation(scene, kStep);
  run(*one, seconds);
  const Result<std::string> state = one->save_state();
  ASSERT_TRUE(state.has_value());
  const auto other = simulation(scene, kStep);
  expect_ok(other->restore_state(*state));
  expect_same(*one, *other, scene);
  run(*one, further);
  run(*other, further);
  expect_same(*one, *other, scene);
  expect_ok(one->reset());
  run(*one, seconds);
  EXPECT_EQ(*one->save_state(), *state) << "after a reset";
}

// I a = T about the hinge: I = 0.1 + 1 * 0.5^2.
TEST(Steering, AJointEffortTurnsTheArm) {
  const TestScene scene = arm(0);
  const auto arm = simulation(scene, kStep);
  expect_ok(arm->set_joint_efforts(0, std::vector<double>{0.7}));
  run(*arm, 0.1);
  EXPECT_NEAR(arm->joint_state(0).velocity[0], 0.1 * 0.7 / 0.35, 1e-9);
  EXPECT_EQ(arm->set_joint_efforts(0, std::vector<double>{1, 2}).error().code(),
            ErrorCode::Invalid);
}

// The same joint closing a loop: bodies on free joints, held by equalities.
TEST(Steering, AnEffortOfALoopJointIsAForcePairOnItsBodies) {
  TestScene scene(0);
  const Index a = scene.add_body("a", {{0, 0, 0}}, 1, {{0.1, 0.1, 0.1}});
  const Index b = scene.add_body("b", {{0, 0, 0}}, 1, {{0.3, 0.3, 0.3}});
  scene::Joint& joint = scene.add_joint("hinge", JointKind::Revolute, a, b, scene::Axis::Y);
  joint.exclude_from_articulation = true;
  scene.add_joint("ground", JointKind::Spherical, {}, a);
  scene.add_joint("ground2", JointKind::Spherical, {}, b);
  const auto pair = simulation(scene, kStep);
  expect_ok(pair->set_joint_efforts(0, std::vector<double>{0.6}));
  run(*pair, 0.1);
  EXPECT_NEAR(pair->body_state(a).angular_velocity[1], -0.1 * 0.6 / 0.1, 1e-3);
  EXPECT_NEAR(pair->body_state(b).angular_velocity[1], 0.1 * 0.6 / 0.3, 1e-3);
}

// A torque in the axes of frame 0 on a ball with inertia I: w = t T / I, whatever way it is turned.
TEST(Steering, AnEffortOfABallIsInTheAxesOfFrame0) {
  for (const bool reversed : {false, true}) {
    TestScene scene(0);
    const Index body = scene.add_body("ball", {}, 1, {{0.2, 0.2, 0.2}});
    scene::Joint& joint = reversed ? scene.add_joint("ball", JointKind::Spherical, body, {})
                                   : scene.add_joint("ball", JointKind::Spherical, {}, body);
    const Quatd turn = rotation_about({{0, 0, 1}}, M_PI / 2);
    joint.frame0.orientation = turn;  // x of frame 0 is y of the world, or of the body
    joint.frame1.orientation = turn;
    const auto ball = simulation(scene, kStep);
    expect_ok(ball->set_joint_efforts(0, std::vector<double>{0.4, 0, 0}));
    run(*ball, 0.05);
    EXPECT_NEAR(ball->body_state(body).angular_velocity[1], (reversed ? -1 : 1) * 0.05 * 0.4 / 0.2,
                1e-9);
  }
}

TEST(Steering, ATargetWinsOverTimeSamples) {
  TestScene scene = arm(0);
  scene.joints[0].drives.push_back(drive(Dof::RotY, 100, 20));
  scene::ScalarTrack track;
  track.times = {0, 1};
  track.values = {0.5, 0.5};
  scene.scalar_tracks.push_back(track);
  const auto driven = simulation(scene, kStep);
  run(*driven, 3);
  EXPECT_NEAR(angle(*driven), 0.5, 1e-6);
  expect_ok(driven->set_drive_target(0, 0, {-0.25, 0}));
  run(*driven, 3);
  EXPECT_NEAR(angle(*driven), -0.25, 1e-6);
  expect_ok(driven->reset());
  run(*driven, 3);
  EXPECT_NEAR(angle(*driven), 0.5, 1e-6);
}

TEST(Steering, ADriveWithoutGainsCannotBeSteered) {
  TestScene scene = arm(0);
  scene.joints[0].drives.push_back(drive(Dof::RotY, 0, 0));
  const auto driven = simulation(scene, kStep);
  EXPECT_EQ(driven->set_drive_target(0, 0, {1, 0}).error().code(), ErrorCode::Unsupported);
}

// At rest k (x* - q) = m g l sin(q), with the stiffness that is set.
TEST(Steering, GainsThatAreSetHoldTheArm) {
  TestScene scene = arm();
  scene.joints[0].drives.push_back(drive(Dof::RotY, 1, 5));
  const auto driven = simulation(scene, kStep);
  expect_ok(driven->set_drive_target(0, 0, {0.4, 0}));
  expect_ok(driven->set_parameter({Parameter::DriveStiffness, 0, 0}, 50));
  run(*driven, 10);
  const double q = angle(*driven);
  EXPECT_NEAR(50 * (0.4 - q), kG * 0.5 * std::sin(q), 1e-6);
}

TEST(Steering, JointParametersAct) {
  const TestScene scene = arm(0);
  const auto driven = simulation(scene, kStep);
  expect_ok(driven->set_parameter({Parameter::JointArmature, 0, 0}, 0.65));
  expect_ok(driven->set_joint_efforts(0, std::vector<double>{1}));
  run(*driven, 0.1);
  EXPECT_NEAR(driven->joint_state(0).velocity[0], 0.1, 1e-9);
  expect_ok(driven->set_parameter({Parameter::JointDamping, 0, 0}, 2));
  run(*driven, 10);
  EXPECT_NEAR(driven->joint_state(0).velocity[0], 0.5, 1e-6);
}

// Friction holds a joint the sooner, the more it has to hold.
TEST(Steering, AnArmatureThatIsSetIsOneOfTheScene) {
  double velocities[2] = {};
  for (const int at : {0, 1}) {
    TestScene scene = arm(0);
    scene.joints[0].friction = 0.4;
    scene.joints[0].armature = at == 0 ? 20 : 0;
    const auto driven = simulation(scene, kStep);
    if (at == 1) {
      expect_ok(driven->set_parameter({Parameter::JointArmature, 0, 0}, 20));
    }
    expect_ok(driven->set_joint_efforts(0, std::vector<double>{0.5}));
    run(*driven, 0.5);
    velocities[at] = driven->joint_state(0).velocity[0];
  }
  EXPECT_NEAR(velocities[1], velocities[0], 1e-9);
}

// A box on the ground under a push of 0.3 m g stays or slides by the friction that is set.
TEST(Steering, FrictionOfOneColliderDecidesWhetherItSlides) {
  TestScene scene;
  const Index body = scene.add_body("box", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("ground", {}, ground());
  const auto pushed = simulation(scene, kStep);
  run(*pushed, 0.5);
  expect_ok(pushed->set_body_wrench(body, {{{0.3 * kG, 0, 0}}, {}}));
  run(*pushed, 0.5);
  EXPECT_LT(pushed->body_state(body).linear_velocity[0], 0.01);
  // Both surfaces average: (0.1 + 0.1) / 2.
  expect_ok(pushed->set_parameter({Parameter::ColliderFriction, 0, 0}, 0.1));
  expect_ok(pushed->set_parameter({Parameter::ColliderFriction, 1, 0}, 0.1));
  run(*pushed, 0.5);
  EXPECT_NEAR(pushed->body_state(body).linear_velocity[0], 0.5 * 0.2 * kG, 0.05);
}

TEST(Steering, AKinematicBodyPushesWhatItTouches) {
  TestScene scene(0);
  const Index free = scene.add_body("free", {{0.5, 0, 0}});
  const Index pusher = scene.add_body("pusher", {});
  scene.bodies[pusher].kinematic = true;
  scene.add_collider("a", free, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("b", pusher, box({{0.1, 0.1, 0.1}}));
  const auto pushed = simulation(scene, kStep);
  for (int i = 1; i <= 1000; ++i) {
    expect_ok(pushed->move_kinematic(pusher, {{{i * 0.0005, 0, 0}}}));
    expect_ok(pushed->step());
  }
  EXPECT_NEAR(pushed->body_state(pusher).pose.position[0], 0.5, 1e-12);
  EXPECT_NEAR(pushed->body_state(free).pose.position[0], 0.7, 0.02);
}

TEST(Steering, JointStatesThatAreSetAreReadBack) {
  TestScene scene = arm();
  const Index ball = scene.add_body("ball", {{3, 0, 0}});
  scene.add_joint("socket", JointKind::Spherical, {}, ball).frame0 = {
      {{3, 0, 0}}, rotation_about({{1, 0, 0}}, 0.4)};
  const auto steered = simulation(scene, kStep);
  const JointState wanted{{0.1, -0.2, 0.3}, {1, 2, -1}};
  expect_ok(steered->set_joint_state(1, wanted));
  expect_ok(steered->set_joint_state(0, {{0.7}, {0.1}}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(steered->joint_state(1).position[i], wanted.position[i], 1e-12);
    EXPECT_NEAR(steered->joint_state(1).velocity[i], wanted.velocity[i], 1e-12);
  }
  EXPECT_NEAR(angle(*steered), 0.7, 1e-12);
}

// The law of a drive, computed outside and set as an effort, moves the arm as the drive itself does
// when that takes its force at the beginning of steps.
TEST(Steering, APdLoopOutsideEqualsExplicitDrives) {
  constexpr double kStiffness = 30;
  constexpr double kDamping = 4;
  constexpr double kTarget = 0.6;
  TestScene with = arm();
  with.joints[0].drives.push_back(drive(Dof::RotY, kStiffness, kDamping));
  with.joints[0].drives[0].target_position = kTarget;
  const TestScene without = arm();
  Diagnostics diagnostics;
  const SimulationOptions options{.time_step = kStep, .drives = DriveTerms::Explicit};
  const auto driven = *MujocoSimulation::make(with, options, diagnostics);
  const auto looped = *MujocoSimulation::make(without, options, diagnostics);
  for (int i = 0; i < 1000; ++i) {
    const JointState state = looped->joint_state(0);
    expect_ok(looped->set_joint_efforts(
        0, std::vector<double>{kStiffness * (kTarget - state.position[0]) -
                               kDamping * state.velocity[0]}));
    expect_ok(driven->step());
    expect_ok(looped->step());
    ASSERT_NEAR(angle(*driven), angle(*looped), 1e-12);
  }
  EXPECT_GT(angle(*driven), 0.3);
}

TEST(SavedStates, OfContactsContinue) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  for (int i = 0; i < 4; ++i) {
    const Index body = scene.add_body("b" + std::to_string(i), {{0.02 * i, 0, 0.2 + 0.25 * i}}, 1,
                                      {{0.01, 0.01, 0.01}});
    scene.add_collider("c" + std::to_string(i), body, box({{0.1, 0.1, 0.1}}));
  }
  expect_continues(scene, 0.4, 0.5);
}

TEST(SavedStates, OfSleepingBodiesContinue) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  const Index asleep = scene.add_body("asleep", {{0, 0, 0.0999}}, 1, {{0.01, 0.01, 0.01}});
  scene.bodies[asleep].starts_asleep = true;
  scene.add_collider("a", asleep, box({{0.1, 0.1, 0.1}}));
  const Index falling = scene.add_body("falling", {{0.05, 0, 0.8}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("b", falling, box({{0.1, 0.1, 0.1}}));
  expect_continues(scene, 0.1, 0.6);
}

TEST(SavedStates, OfAccelerationDrivesContinue) {
  TestScene scene = arm();
  const Index second = scene.add_body("second", {{0, 0, -1.5}}, 1, {{0.1, 0.1, 0.1}});
  scene::Joint& elbow = scene.add_joint("elbow", JointKind::Revolute, 0, second, scene::Axis::Y);
  elbow.frame0.position = {{0, 0, -0.5}};
  elbow.frame1.position = {{0, 0, 0.5}};
  for (scene::Joint& joint : scene.joints) {
    joint.drives.push_back(drive(Dof::RotY, 40, 3));
    joint.drives[0].acceleration = true;
    joint.drives[0].target_position = 0.9;
  }
  scene.bodies[second].linear_damping = 0.3;
  expect_continues(scene, 0.2, 0.4);
}

/// A weight on a fixed joint that breaks under it when gravity grows, and a switch at 0.3 s.
TestScene breaking_scene() {
  TestScene scene(1);
  const Index hung = scene.add_body("hung", {{0, 0, 1}}, 2);
  scene::Joint& joint = scene.add_joint("holds", JointKind::Fixed, {}, hung);
  joint.frame0.position = {{0, 0, 1}};
  joint.break_force = 10;
  const Index switched = scene.add_body("switched", {{2, 0, 1}});
  scene.bodies[switched].kinematic = true;
  scene::SwitchTrack track;
  track.what = scene::Switch::BodyKinematic;
  track.object = switched;
  track.times = {0, 0.3};
  track.values = {1, 0};
  scene.switch_tracks.push_back(track);
  scene::GravityTrack gravity;
  gravity.times = {0, 1};
  gravity.gravity = {{{0, 0, -1}}, {{0, 0, -11}}};
  scene.gravity_tracks.push_back(gravity);
  return scene;
}

TEST(SavedStates, OfBrokenAndSwitchedThingsContinue) {
  const TestScene scene = breaking_scene();
  const auto whole = simulation(scene, kStep);
  run(*whole, 1);
  ASSERT_EQ(whole->events().size(), 1u);
  EXPECT_NEAR(whole->events()[0].time, 0.4, 0.01);  // 2 kg (1 + 10 t) = 10 N
  for (const double seconds : {0.1, 0.35, 0.6}) {
    expect_continues(scene, seconds, 0.5);
  }
}

TEST(SavedStates, OfMovedBodiesAndParametersContinueAfterTheModelWasMadeAnew) {
  const TestScene scene = breaking_scene();
  const auto one = simulation(scene, kStep);
  expect_ok(one->set_parameter({Parameter::BodyMass, 0, 0}, 4));
  expect_ok(one->move_kinematic(1, {{{2, 0.001, 1}}}));
  run(*one, 0.5);
  ASSERT_EQ(one->events().size(), 1u);
  EXPECT_NEAR(one->events()[0].time, 0.15, 0.01);  // 4 kg (1 + 10 t) = 10 N
  const std::string state = *one->save_state();
  const auto other = simulation(scene, kStep);
  expect_ok(other->restore_state(state));
  expect_ok(other->set_body_wrench(1, {{{1, 0, 0}}, {}}));
  expect_ok(one->set_body_wrench(1, {{{1, 0, 0}}, {}}));
  run(*one, 0.3);
  run(*other, 0.3);
  expect_same(*one, *other, scene);
  expect_ok(one->reset());
  const auto fresh = simulation(scene, kStep);
  run(*one, 0.5);
  run(*fresh, 0.5);
  expect_same(*one, *fresh, scene);
}

// Bytes that are whole but lie: the digest is right, what it covers is not.
TEST(SavedStates, ThatLieAreRefused) {
  const TestScene scene = breaking_scene();
  const auto one = simulation(scene, kStep);
  run(*one, 0.6);
  const StateOwner owner{"mujoco", std::string(one->engine_objects().version),
                         scene::scene_hash(scene), kStep};
  const std::string body = *open_state(owner, *one->save_state());
  for (std::size_t at = 0; at < body.size(); at += 101) {
    for (const char value : {'\xff', '\x7f', '\0'}) {
      std::string lie = body;
      lie[at] = value;
      if (one->restore_state(seal_state(owner, std::move(lie))).has_value()) {
        (void)one->step();  // may be unstable, must not crash
      }
    }
  }
}

// Filtered pairs need the filter of the model on every thread that steps it.
TEST(Environments, KeepFilteredPairsApartOnEveryThread) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  for (int i = 0; i < 2; ++i) {
    const Index body =
        scene.add_body("b" + std::to_string(i), {{0, 0, 0.1 + 0.02 * i}}, 1, {{0.01, 0.01, 0.01}});
    scene.add_collider("c" + std::to_string(i), body, box({{0.1, 0.1, 0.1}}));
    scene.add_collider("d" + std::to_string(i), body, sphere(0.05), {{{0.3, 0, 0}}});
  }
  keep_pairs_apart(scene, {{1, 3}, {1, 4}, {2, 4}});  // not all of the bodies: needs the callback
  std::vector<std::string> states;
  for (const std::size_t threads : {1u, 4u}) {
    Diagnostics diagnostics;
    auto made = engines::Environments::make(
        {&info, &make_simulation, &make_simulations}, scene,
        {.count = 8, .threads = threads, .simulation = {.time_step = kStep}}, diagnostics);
    ASSERT_TRUE(made.has_value());
    EXPECT_EQ(made->step(500), 0u);
    std::string together;
    for (std::size_t i = 0; i < made->size(); ++i) {
      together += *(*made)[i].save_state();
      EXPECT_NEAR((*made)[i].body_state(1).pose.position[2], 0.1, 0.002);
    }
    states.push_back(std::move(together));
  }
  EXPECT_EQ(states[0], states[1]);
}

TEST(Environments, ShareTheModelUntilOneHasValuesOfItsOwn) {
  const TestScene scene = arm();
  Diagnostics diagnostics;
  auto made = engines::Environments::make({&info, &make_simulation, &make_simulations}, scene,
                                          {.count = 3, .threads = 1}, diagnostics);
  ASSERT_TRUE(made.has_value());
  engines::Environments& all = *made;
  EXPECT_EQ(all[0].engine_objects().model, all[2].engine_objects().model);
  expect_ok(all[1].set_parameter({Parameter::JointDamping, 0, 0}, 1));
  EXPECT_EQ(all[0].engine_objects().model, all[2].engine_objects().model);
  EXPECT_NE(all[0].engine_objects().model, all[1].engine_objects().model);
}

TEST(Environments, StepWithDataThatTheyLendEachOther) {
  TestScene scene;
  scene.add_collider("ground", {}, ground());
  const Index body = scene.add_body("box", {{0, 0, 0.11}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  scene.bodies[body].angular_damping = 0.5;
  const auto alone = simulation(scene, kStep);
  Diagnostics diagnostics;
  auto made = engines::Environments::make(
      {&info, &make_simulation, &make_simulations}, scene,
      {.count = 3, .threads = 2, .simulation = {.time_step = kStep}}, diagnostics);
  ASSERT_TRUE(made.has_value());
  World& one = (*made)[1];
  const Wrench push{{{0.5, 0, 0}}, {{0, 0, 0.1}}};
  for (int i = 0; i < 200; ++i) {
    if (i == 50) {
      expect_ok(alone->set_body_wrench(body, push));
      expect_ok(one.set_body_wrench(body, push));
    }
    expect_ok(alone->step());
    EXPECT_EQ(made->step(), 0u);
    ASSERT_EQ(one.contact_count(), alone->contact_count()) << i;
    ASSERT_EQ(one.body_state(body).pose, alone->body_state(body).pose) << i;
    ASSERT_EQ(one.energy().kinetic, alone->energy().kinetic) << i;
  }
  EXPECT_EQ(*one.save_state(), *alone->save_state());
  EXPECT_GT(one.contact_count(), 0u);
  // Where each of a thousand had its contacts, no cache would hold them.
  EXPECT_EQ(static_cast<const mjData*>(one.engine_objects().data)->ncon, 0);
}

TEST(Environments, ThatFailStandStillUntilTheyAreReset) {
  const TestScene scene = arm();
  Diagnostics diagnostics;
  auto made = engines::Environments::make({&info, &make_simulation, &make_simulations}, scene,
                                          {.count = 3, .threads = 2}, diagnostics);
  ASSERT_TRUE(made.has_value());
  engines::Environments& all = *made;
  expect_ok(all[1].set_joint_efforts(0, std::vector<double>{1e300}));
  EXPECT_EQ(all.step(5), 1u);
  ASSERT_NE(all.failure(1), nullptr);
  EXPECT_EQ(all.failure(1)->code(), ErrorCode::Unstable);
  EXPECT_EQ(all.failure(0), nullptr);
  expect_ok(all.reset(1));
  EXPECT_EQ(all.step(5), 0u);
  std::vector<double> positions(3);
  std::vector<double> velocities(3);
  expect_ok(all.read_joints(positions, velocities));
  EXPECT_FALSE(all.read_joints({positions.data(), 2}, velocities).has_value());
}

}  // namespace
}  // namespace tenon::engines::mujoco
