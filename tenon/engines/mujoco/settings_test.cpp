// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Dof;
using scene::JointKind;

scene::BodyForce force(const Vec3d& f, const Vec3d& torque, const Vec3d& point) {
  scene::BodyForce result;
  result.source = named("F");
  result.force = f;
  result.torque = torque;
  result.point = point;
  return result;
}

TEST(Forces, AConstantForceAcceleratesTheCentreOfMass) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {}, 2);
  scene.bodies[body].settings.forces = {force({{3, 0, 0}}, {}, {})};
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 1.5, 1e-9);  // F t / m
  EXPECT_NEAR(sim->body_state(body).pose.position[0], 0.75, 2e-3);   // F t^2 / 2 m
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 0, 1e-12);
}

TEST(Forces, OffTheCentreTheyTurnTheBody) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {}, 2);
  scene.bodies[body].settings.forces = {force({{0.1, 0, 0}}, {}, {{0, 0.5, 0}})};
  auto sim = simulation(scene);
  run(*sim, 0.1);
  // r x F = -0.05 N m about z, I = 0.1 kg m^2.
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], -0.05, 1e-5);
}

TEST(Forces, AccelerationsKnowNoMassAndTurnWithTheBodyWhereAsked) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {}, 5, {{0.1, 0.2, 0.3}});
  scene.bodies[body].pose.orientation = rotation_about({{0, 0, 1}}, M_PI / 2);
  scene::BodyForce push = force({{2, 0, 0}}, {}, {});
  push.acceleration = true;
  push.body_axes = true;
  scene::BodyForce turn = force({}, {{0, 0, 0.5}}, {});
  turn.acceleration = true;
  scene.bodies[body].settings.forces = {push, turn};
  auto sim = simulation(scene, 0.0005);
  run(*sim, 0.02);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[1], 0.04, 1e-5);  // own x is the world's y
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 0.01, 1e-9);
}

TEST(Forces, TheirWorkIsThatOfWhatIsApplied) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {}, 2);
  scene.bodies[body].settings.forces = {force({{3, 0, 0}}, {}, {})};
  Diagnostics findings;
  auto sim = MujocoSimulation::make(scene, {.outputs = {.work = true}}, findings);
  ASSERT_TRUE(sim.has_value());
  run(**sim, 1);
  EXPECT_NEAR((*sim)->work()->applied, (*sim)->energy().kinetic, 1e-6);
}

TEST(BodySettings, SpeedsAreCut) {
  TestScene scene;
  const auto body = scene.add_body("Body", {});
  scene.bodies[body].settings.max_linear_velocity = 3;
  scene.bodies[body].settings.max_angular_velocity = 2;
  scene.bodies[body].angular_velocity = {{0, 0, 5}};
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -3, 1e-9);
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 2, 1e-9);
}

TEST(BodySettings, JointVelocitiesAreCutWithoutALossOfMomentum) {
  TestScene scene(0);
  const auto left = scene.add_body("Left", {});
  const auto right = scene.add_body("Right", {});
  scene.bodies[right].linear_velocity = {{4, 0, 0}};
  scene::Joint& joint = scene.add_joint("J", JointKind::Prismatic, left, right, scene::Axis::X);
  joint.velocity_limit = 1;
  auto sim = simulation(scene);
  run(*sim, 0.1);
  const double v0 = sim->body_state(left).linear_velocity[0];
  const double v1 = sim->body_state(right).linear_velocity[0];
  EXPECT_NEAR(v1 - v0, 1, 1e-9);
  const double before = simulation(scene)->body_state(left).linear_velocity[0] +
                        simulation(scene)->body_state(right).linear_velocity[0];
  EXPECT_NEAR(v0 + v1, before, 1e-9);
}

TEST(BodySettings, JointVelocitiesOfBranchesAreCutByAnImpulseAlongThem) {
  TestScene scene(0);
  std::vector<scene::Index> bodies;
  for (int i = 0; i < 6; ++i) {
    bodies.push_back(scene.add_body("B" + std::to_string(i), {{1.0 * i, 0.3 * i, 0}}, 1 + i));
    scene.bodies[bodies.back()].angular_velocity = {{0, 0, 3.0 * (i % 2)}};
    scene.bodies[bodies.back()].linear_velocity = {{0, 1.0 * i, 0.2 * i}};
  }
  const std::pair<int, int> pairs[] = {{0, 1}, {1, 2}, {0, 3}, {3, 4}, {3, 5}};
  for (const auto& [parent, child] : pairs) {
    scene::Joint& joint = scene.add_joint("J" + std::to_string(child), JointKind::Revolute,
                                          bodies[static_cast<std::size_t>(parent)],
                                          bodies[static_cast<std::size_t>(child)], scene::Axis::Z);
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.frame0.position = scene.bodies[static_cast<std::size_t>(child)].pose.position -
                            scene.bodies[static_cast<std::size_t>(parent)].pose.position +
                            joint.frame1.position;
  }
  for (const std::size_t cut : {0u, 1u, 4u}) {
    const auto speed = [cut](const MujocoSimulation& of) {
      return std::fabs(of.joint_state(static_cast<scene::Index>(cut)).velocity[0]);
    };
    auto plain = simulation(scene);
    ASSERT_TRUE(plain->step());
    ASSERT_GT(speed(*plain), 0.1) << cut;
    TestScene limited = scene;
    limited.joints[cut].velocity_limit = speed(*plain) / 2;
    auto sim = simulation(limited);
    ASSERT_TRUE(sim->step());
    EXPECT_NEAR(speed(*sim), limited.joints[cut].velocity_limit, 1e-9) << cut;
    // The difference is what an impulse along the joint does, and nothing else.
    const mjModel& m = sim->engine_model();
    const int joint =
        mj_name2id(&m, mjOBJ_JOINT, ("/J" + std::to_string(cut + 1) + ".rotZ").c_str());
    ASSERT_GE(joint, 0);
    const auto dof = static_cast<std::size_t>(m.jnt_dofadr[joint]);
    std::vector<double> unit(static_cast<std::size_t>(m.nv), 0);
    std::vector<double> response(unit);
    unit[dof] = 1;
    mj_solveM(&m, const_cast<mjData*>(&sim->engine_data()), response.data(), unit.data(), 1);
    const double impulse =
        (sim->engine_data().qvel[dof] - plain->engine_data().qvel[dof]) / response[dof];
    for (std::size_t i = 0; i < unit.size(); ++i) {
      EXPECT_NEAR(sim->engine_data().qvel[i] - plain->engine_data().qvel[i], impulse * response[i],
                  1e-9)
          << cut << " " << i;
    }
  }
}

TEST(BodySettings, SpeedsOfBodiesOnJointsAreCut) {
  TestScene scene;
  const auto upper = scene.add_body("Upper", {{1, 0, 0}});
  const auto lower = scene.add_body("Lower", {{2, 0, 0}});
  scene::Joint& shoulder =
      scene.add_joint("Shoulder", JointKind::Revolute, {}, upper, scene::Axis::Y);
  shoulder.frame1.position = {{-1, 0, 0}};
  scene::Joint& elbow = scene.add_joint("Elbow", JointKind::Revolute, upper, lower, scene::Axis::Y);
  elbow.frame1.position = {{-1, 0, 0}};
  scene.bodies[lower].settings.max_linear_velocity = 1.5;
  scene.bodies[upper].settings.max_angular_velocity = 0.8;
  auto sim = simulation(scene);
  double fastest = 0;
  double turning = 0;
  double difference = 0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(sim->step());
    fastest = std::max(fastest, length(sim->body_state(lower).linear_velocity));
    turning = std::max(turning, length(sim->body_state(upper).angular_velocity));
    difference = std::max(difference, std::fabs(sim->joint_state(0).velocity[0] -
                                                sim->body_state(upper).angular_velocity[1]));
  }
  // They were cut where the bodies stood before the way of the step was cut, too.
  EXPECT_NEAR(fastest, 1.5, 1e-5);
  EXPECT_NEAR(turning, 0.8, 1e-5);
  EXPECT_LT(difference, 1e-9);  // what joints show fits
  EXPECT_TRUE(sim->not_mapped().empty());
}

TEST(BodySettings, SlowBodiesOnJointsMoveAsWithoutALimit) {
  TestScene scene;
  const auto bob = scene.add_body("Bob", {{1, 0, 0}});
  scene::Joint& joint = scene.add_joint("J", JointKind::Revolute, {}, bob, scene::Axis::Y);
  joint.frame1.position = {{-1, 0, 0}};
  auto plain = simulation(scene);
  scene.bodies[bob].settings.max_linear_velocity = 4.5;  // it falls with 4.2 m/s at most
  scene.bodies[bob].settings.max_angular_velocity = 4.5;
  auto capped = simulation(scene);
  run(*plain, 2);
  run(*capped, 2);
  EXPECT_EQ(plain->joint_state(0).position[0], capped->joint_state(0).position[0]);
}

// Bodies that turn about z, each at its place, the first by a drive that could turn it by 90
// degrees in a few steps.
TestScene driven_row(const std::vector<const char*>& names) {
  TestScene scene(0);
  for (const char* name : names) {
    const auto x = 2.0 * static_cast<double>(scene.bodies.size());
    const auto body = scene.add_body(name, {{x, 0, 0}});
    scene.add_joint(name, JointKind::Revolute, {}, body, scene::Axis::Z).frame0.position =
        scene.bodies[body].pose.position;
  }
  scene.joints[0].velocity_limit = 1;
  scene::Drive& drive = scene.joints[0].drives.emplace_back();
  drive.dof = Dof::RotZ;
  drive.stiffness = 5000;
  drive.target_position = 1.5;
  return scene;
}

std::unique_ptr<MujocoSimulation> simulation_by(const scene::PhysicsScene& scene,
                                                Integrator integrator) {
  Diagnostics findings;
  SimulationOptions options{.time_step = 0.002};
  options.methods.integrator = integrator;
  auto made = MujocoSimulation::make(scene, options, findings);
  EXPECT_TRUE(made.has_value());
  return made.has_value() ? *std::move(made) : nullptr;
}

constexpr Integrator kIntegrators[] = {Integrator::Euler, Integrator::ImplicitFast,
                                       Integrator::RungeKutta4};

TEST(BodySettings, JointsMoveNoFartherThanTheirVelocityLimitsLetThem) {
  const TestScene scene = driven_row({"A"});
  for (const Integrator integrator : kIntegrators) {
    auto sim = simulation_by(scene, integrator);
    double before = 0;
    for (int i = 0; i < 250; ++i) {
      ASSERT_TRUE(sim->step());
      const JointState state = sim->joint_state(0);
      ASSERT_NEAR(state.velocity[0], 1, 1e-9) << integrator_name(integrator) << i;
      ASSERT_NEAR((state.position[0] - before) / sim->time_step(), 1, 1e-9)
          << integrator_name(integrator) << i;
      before = state.position[0];
    }
  }
}

// What follows a joint is cut with it, whichever of the two the limit is of.
TEST(BodySettings, MimicsKeepTheirLawWhereOneOfThemIsCut) {
  for (const double follower_limit : {scene::kUnlimited, 1.2}) {
    TestScene scene = driven_row({"A", "B"});
    scene::Mimic mimic;
    mimic.dof = Dof::RotZ;
    mimic.leader_dof = Dof::RotZ;
    mimic.multiplier = -2;
    scene.joints[1].mimics.push_back(mimic);
    scene.joints[1].velocity_limit = follower_limit;
    const double speed = follower_limit < scene::kUnlimited ? 0.6 : 1;
    for (const Integrator integrator : kIntegrators) {
      auto sim = simulation_by(scene, integrator);
      run(*sim, 0.5);
      const JointState leader = sim->joint_state(0);
      const JointState follower = sim->joint_state(1);
      EXPECT_NEAR(leader.velocity[0], speed, 2e-3) << integrator_name(integrator);
      EXPECT_NEAR(leader.position[0], 0.5 * speed, 2e-3) << integrator_name(integrator);
      EXPECT_NEAR(std::fabs(follower.velocity[0]), 2 * speed, 2e-3) << integrator_name(integrator);
      EXPECT_NEAR(std::fabs(follower.position[0]), 2 * leader.position[0], 2e-3)
          << integrator_name(integrator);
    }
  }
}

TEST(BodySettings, LockedAxesOfTheWorldDoNotMove) {
  TestScene scene;
  const auto body = scene.add_body("Body", {}, 1, {{0.1, 0.2, 0.3}});
  scene.bodies[body].pose.orientation = rotation_about({{1, 0, 0}}, 0.7);
  scene.bodies[body].linear_velocity = {{1, 2, 0}};
  scene.bodies[body].angular_velocity = {{1, 2, 3}};
  scene.bodies[body].settings.locked_translation = 1 | 4;
  scene.bodies[body].settings.locked_rotation = 1 | 2;
  auto sim = simulation(scene);
  run(*sim, 1);
  const BodyState state = sim->body_state(body);
  EXPECT_NEAR(state.pose.position[0], 0, 1e-6);
  EXPECT_NEAR(state.pose.position[1], 2, 1e-6);
  EXPECT_NEAR(state.pose.position[2], 0, 1e-6);
  EXPECT_NEAR(state.angular_velocity[0], 0, 1e-6);
  EXPECT_NEAR(state.angular_velocity[1], 0, 1e-6);
  EXPECT_NEAR(state.angular_velocity[2], 3, 1e-6);
}

TEST(BodySettings, WithoutGyroscopicTorqueTheSpinStays) {
  TestScene scene(0);
  const auto body = scene.add_body("Body", {}, 1, {{0.1, 0.2, 0.3}});
  scene.bodies[body].angular_velocity = {{3, 2, 1}};
  auto free = simulation(scene);
  scene.bodies[body].settings.gyroscopic = false;
  auto plain = simulation(scene);
  run(*free, 0.5);
  run(*plain, 0.5);
  EXPECT_GT(length(free->body_state(body).angular_velocity - Vec3d{{3, 2, 1}}), 0.5);
  // In the axes of the body it is constant; its length stays in every axes.
  EXPECT_NEAR(length(plain->body_state(body).angular_velocity), std::sqrt(14.0), 0.02);
}

TEST(BodySettings, ContactsThatAreNotSolvedExertNothing) {
  TestScene scene;
  scene.add_collider("Ground", {}, ground());
  const auto body = scene.add_body("Body", {{0, 0, 0.5}});
  scene.add_collider("Ball", body, sphere(0.1));
  scene.bodies[body].settings.solves_contacts = false;
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -kG, 1e-9);
}

TEST(Triggers, TellWhatEntersAndLeavesAndTouchNothing) {
  TestScene scene;
  const auto zone = scene.add_collider("Zone", {}, box({{1, 1, 0.5}}), {{{0, 0, 0}}});
  scene.colliders[zone].settings.trigger = true;
  const auto body = scene.add_body("Body", {{0, 0, 2}});
  scene.add_collider("Ball", body, sphere(0.1));
  auto sim = simulation(scene);
  run(*sim, 1);
  ASSERT_EQ(sim->events().size(), 2u);
  const auto fall = [](double height) { return std::sqrt(2 * height / kG); };
  EXPECT_NEAR(sim->events()[0].time, fall(1.4), 0.004);
  EXPECT_NEAR(sim->events()[1].time, fall(2.6), 0.004);
  EXPECT_EQ(sim->events()[0].prim.str(), "/Zone");
  EXPECT_EQ(sim->events()[0].what, "entered by </Ball>");
  EXPECT_EQ(sim->events()[1].what, "left by </Ball>");
  EXPECT_NEAR(sim->body_state(body).linear_velocity[2], -kG, 1e-9);
}

TEST(Triggers, WhatIsInsideWhenAStateIsRestoredIsNoNews) {
  TestScene scene;
  const auto zone = scene.add_collider("Zone", {}, box({{1, 1, 0.5}}), {{{0, 0, 0}}});
  scene.colliders[zone].settings.trigger = true;
  scene.add_collider("Ball", scene.add_body("Body", {{0, 0, 2}}), sphere(0.1));
  auto sim = simulation(scene);
  run(*sim, 0.6);
  const Result<std::string> state = sim->save_state();
  ASSERT_TRUE(state.has_value());
  auto other = simulation(scene);
  ASSERT_TRUE(other->restore_state(*state).has_value());
  run(*other, 0.4);
  ASSERT_EQ(other->events().size(), 1u);
  EXPECT_EQ(other->events()[0].what, "left by </Ball>");
}

TEST(SurfaceVelocity, CarriesWhatLiesOnIt) {
  TestScene scene;
  const auto belt = scene.add_body("Belt", {});
  scene.bodies[belt].kinematic = true;
  scene.bodies[belt].pose.orientation = rotation_about({{0, 0, 1}}, M_PI / 2);
  const auto surface = scene.add_collider("Surface", belt, box({{5, 5, 0.1}}));
  scene.colliders[surface].settings.surface_velocity =
      scene::SurfaceVelocity{{{0, -1, 0}}, {}, true};
  const auto body = scene.add_body("Body", {{0, 0, 0.3}});
  scene.add_collider("Box", body, box({{0.2, 0.2, 0.2}}));
  auto sim = simulation(scene);
  run(*sim, 1.5);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[0], 1, 1e-3);  // own -y is the world's x
  EXPECT_NEAR(sim->body_state(body).linear_velocity[1], 0, 1e-3);
}

TEST(SurfaceVelocity, ATurnTableTurnsAboutTheOriginOfTheBody) {
  TestScene scene;
  const auto table = scene.add_body("Table", {});
  scene.bodies[table].kinematic = true;
  const auto surface = scene.add_collider("Surface", table, box({{1, 1, 0.1}}), Pose{{{1, 0, 0}}});
  scene.colliders[surface].settings.surface_velocity =
      scene::SurfaceVelocity{{}, {{0, 0, 0.1}}, true};
  const auto body = scene.add_body("Body", {{1, 0, 0.3}});
  scene.add_collider("Box", body, box({{0.2, 0.2, 0.2}}));
  auto sim = simulation(scene);
  run(*sim, 0.5);
  EXPECT_NEAR(sim->body_state(body).linear_velocity[1], 0.1, 2e-3);  // w r
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 0.1, 5e-3);
}

/// A bob of 2 kg, 0.5 m from a hinge about Y, that lies on a soft upper bound at 0.
struct SoftPendulum : TestScene {
  SoftPendulum(double stiffness, double damping) {
    add_body("Bob", {{0.5, 0, 0}}, 2, {{1e-6, 1e-6, 1e-6}});
    scene::Joint& joint = add_joint("J", JointKind::Revolute, {}, 0, scene::Axis::Y);
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.lower = -1;
    joint.upper = 0;
    joint.limit_springs = {{Dof::RotY, stiffness, damping, 0, 0}};
  }
};

TEST(SoftLimits, RestWhereTheSpringCarriesTheLoad) {
  for (const double stiffness : {50.0, 500.0, 50000.0}) {
    SoftPendulum scene(stiffness, 0.1 * stiffness);
    auto sim = simulation(scene);
    run(*sim, 4);
    const double angle = sim->joint_state(0).position[0];
    EXPECT_NEAR(stiffness * angle, 2 * kG * 0.5 * std::cos(angle), 1e-3 * 2 * kG) << stiffness;
  }
}

TEST(SoftLimits, SwingAtTheFrequencyOfTheirSpring) {
  SoftPendulum scene(2000, 0);
  scene.scenes[0].gravity = {};
  scene.bodies[0].linear_velocity = {{0, 0, -0.5}};
  scene.bodies[0].angular_velocity = {{0, 1, 0}};  // beyond the bound
  auto sim = simulation(scene, 0.0002);
  double highest = 0;
  const double inertia = 2 * 0.25;
  const double quarter = M_PI / 2 * std::sqrt(inertia / 2000);
  double at = 0;
  while (sim->time() < 3 * quarter) {
    run(*sim, 0.0002);
    if (sim->joint_state(0).position[0] > highest) {
      highest = sim->joint_state(0).position[0];
      at = sim->time();
    }
  }
  EXPECT_NEAR(highest, std::sqrt(inertia / 2000), 2e-4);  // v / omega
  EXPECT_NEAR(at, quarter, 4e-4);
}

TEST(SoftLimits, HardOnesReboundWithTheirRestitution) {
  TestScene scene(0);
  scene.add_body("Bob", {{0, 0, 0}}, 2);
  scene::Joint& joint = scene.add_joint("J", JointKind::Prismatic, {}, 0, scene::Axis::X);
  joint.lower = -5;
  joint.upper = 0.1;
  joint.limit_springs = {{Dof::TransX, 0, 0, 0.6, 0}};
  scene.bodies[0].linear_velocity = {{2, 0, 0}};
  auto sim = simulation(scene);
  run(*sim, 0.3);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], -1.2, 0.1);
}

TEST(DistanceSprings, HangByLoadOverStiffness) {
  TestScene scene;
  scene.add_body("Bob", {{0, 0, -1}}, 1);
  scene::Joint& joint = scene.add_joint("J", JointKind::Distance, {}, 0);
  joint.upper = 1;
  joint.limit_springs = {{Dof::Distance, 20, 5, 0, 0}};
  auto sim = simulation(scene);
  run(*sim, 6);
  EXPECT_NEAR(sim->body_state(0).pose.position[2], -(1 + kG / 20), 1e-3);
}

TEST(DistanceSprings, PushOutOfTheMinimum) {
  TestScene scene(0);
  scene.add_body("Bob", {{0, 0, -0.4}}, 1);
  scene::Joint& joint = scene.add_joint("J", JointKind::Distance, {}, 0);
  joint.lower = 0.5;
  joint.limit_springs = {{Dof::Distance, 20, 0, 0, 0}};
  auto sim = simulation(scene, 0.0005);
  run(*sim, 0.01);
  EXPECT_NEAR(sim->body_state(0).linear_velocity[2], -20 * 0.1 * 0.01, 2e-4);  // k x t / m
}

TEST(TendonLimits, GiveWayByTheirStiffness) {
  TestScene scene;
  scene.add_body("Slider", {}, 1);
  scene::Joint& joint = scene.add_joint("J", JointKind::Prismatic, {}, 0, scene::Axis::Z);
  joint.damping = 20;
  scene::Tendon tendon;
  tendon.path = named("T");
  tendon.joints = {0};
  tendon.coefficients = {2};
  tendon.range = {{-0.1, 10}};
  tendon.limit_stiffness = 30;
  scene.tendons = {tendon};
  auto sim = simulation(scene);
  run(*sim, 5);
  // 2 k (-0.1 - 2 q) = m g
  EXPECT_NEAR(sim->joint_state(0).position[0], (-0.1 - kG / 60) / 2, 1e-4);
}

TEST(Compliance, ABallSinksInByItsWeightOverTheStiffness) {
  for (const bool by_mass : {false, true}) {
    TestScene scene;
    scene::Material material;
    material.path = named("Soft");
    material.dynamic_friction = 0.5;
    material.compliance = {by_mass ? 1000.0 : 2000.0, by_mass ? 20.0 : 40.0, by_mass};
    scene.materials = {material};
    const auto floor = scene.add_collider("Ground", {}, ground());
    const auto body = scene.add_body("Body", {{0, 0, 0.1}}, 2);
    scene.add_collider("Ball", body, sphere(0.1));
    scene.colliders[floor].material = 0;
    auto sim = simulation(scene);
    run(*sim, 3);
    EXPECT_NEAR(sim->body_state(body).pose.position[2], 0.1 - kG / 1000, 2e-4) << by_mass;
  }
}

TEST(TorsionalPatch, ABallThatSpinsOnTheFloorIsBraked) {
  TestScene scene;
  scene.add_collider("Ground", {}, ground());
  const auto body = scene.add_body("Body", {{0, 0, 0.1}}, 1, {{0.004, 0.004, 0.004}});
  const auto ball = scene.add_collider("Ball", body, sphere(0.1));
  scene.bodies[body].angular_velocity = {{0, 0, 20}};
  scene.colliders[ball].settings.min_torsional_patch = 0.002;
  auto sim = simulation(scene);
  run(*sim, 1);
  // mu m g r / I = 0.5 * 9.81 * 0.002 / 0.004 rad/s^2
  EXPECT_NEAR(sim->body_state(body).angular_velocity[2], 20 - 0.5 * kG * 0.002 / 0.004, 0.2);
}

TEST(Envelope, ADriveExertsWhatItCanAtItsSpeed) {
  TestScene scene(0);
  scene.add_body("Wheel", {}, 1);
  scene::Joint& joint = scene.add_joint("J", JointKind::Revolute, {}, 0, scene::Axis::Z);
  scene::Drive motor = drive(Dof::RotZ, 0, 1000);
  motor.target_velocity = 100;
  motor.max_force = 2;
  motor.envelope.velocity_resistance = 0.1;
  joint.drives = {motor};
  auto sim = simulation(scene, 0.001);
  run(*sim, 1);
  // I dw/dt = F - c w: w = F / c (1 - exp(-c t / I)), I = 0.1.
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 20 * (1 - std::exp(-1.0)), 0.02);
  scene.joints[0].drives[0].envelope = {5, 0, 0};
  auto capped = simulation(scene, 0.001);
  run(*capped, 1);
  EXPECT_NEAR(capped->joint_state(0).velocity[0], 5, 0.03);
}

TEST(MujocoActuators, AServoOnATendonPullsItToItsControl) {
  TestScene scene(0);
  scene.add_body("Wheel", {}, 1);
  scene::Joint& joint = scene.add_joint("J", JointKind::Revolute, {}, 0, scene::Axis::Z);
  joint.damping = 1;
  joint.initial_position = 0.3;
  scene::Tendon tendon;
  tendon.path = named("T");
  tendon.joints = {0};
  tendon.coefficients = {2};
  scene.tendons = {tendon};
  scene::MujocoActuator servo;
  servo.path = named("Servo");
  servo.kind = scene::MujocoActuator::Target::Tendon;
  servo.gain_type = "fixed";
  servo.bias_type = "affine";
  servo.dyn_type = "none";
  servo.gain = {10};
  servo.bias = {0, -10};
  scene.actuators = {servo};
  auto sim = simulation(scene);
  run(*sim, 3);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0, 1e-3);
  scene.actuators[0].gain_type = "none of MuJoCo's";
  EXPECT_TRUE(mentions(simulation(scene)->not_mapped(), "/Servo", "mjc:target"));
}

TEST(MujocoActuators, AForceAtASitePushesItsBody) {
  TestScene scene(0);
  scene.add_body("Body", {}, 2);
  scene::MujocoActuator jet;
  jet.path = named("Jet");
  jet.kind = scene::MujocoActuator::Target::Site;
  jet.site = {named("Nozzle"), 0, {}};
  jet.gain_type = "fixed";
  jet.bias_type = "affine";
  jet.dyn_type = "none";
  jet.bias = {3};
  jet.gear = {0, 0, 1};
  scene.actuators = {jet};
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_NEAR(sim->body_state(0).linear_velocity[2], 1.5, 1e-6);
}

}  // namespace
}  // namespace tenon::engines::mujoco
