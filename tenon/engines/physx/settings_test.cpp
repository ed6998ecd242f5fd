// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What PhysxSceneAPI, PhysxRigidBodyAPI and PhysxArticulationAPI say of how PhysX solves.
#include "tenon/engines/physx/test_scene.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;
using scene::JointKind;

std::unique_ptr<PhysxSimulation> made_of(const scene::PhysicsScene& scene,
                                         const SimulationOptions& options = {}) {
  Diagnostics diagnostics;
  auto made = PhysxSimulation::make(scene, options, diagnostics);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  return made.has_value() ? *std::move(made) : nullptr;
}

const px::PxScene& scene_of(const PhysxSimulation& simulation) {
  return *static_cast<const px::PxScene*>(simulation.engine_objects().model);
}

/// The actor of a body that stands alone.
px::PxRigidDynamic& actor_of(const PhysxSimulation& simulation) {
  px::PxActor* actor = nullptr;
  scene_of(simulation).getActors(px::PxActorTypeFlag::eRIGID_DYNAMIC, &actor, 1);
  return *static_cast<px::PxRigidDynamic*>(actor);
}

TestScene one_box() {
  TestScene scene;
  const Index body = scene.add_body("box", {{0, 0, 0.1}}, 1, {{0.01, 0.01, 0.01}});
  scene.add_collider("shape", body, box({{0.1, 0.1, 0.1}}));
  scene.add_collider("ground", {}, ground());
  return scene;
}

TEST(PhysxSolver, OfTheSceneAreThoseOfTheSolver) {
  TestScene scene = one_box();
  scene.scenes[0].parts.physx = {{"bounceThreshold", {0.7}, ""},
                                 {"collisionSystem", {}, "SAT"},
                                 {"enableCCD", {1}, ""},
                                 {"enableStabilization", {1}, ""},
                                 {"frictionCorrelationDistance", {0.03}, ""},
                                 {"frictionOffsetThreshold", {0.02}, ""},
                                 {"frictionType", {}, "twoDirectional"},
                                 {"maxBiasCoefficient", {8}, ""},
                                 {"solverType", {}, "TGS"}};
  const auto simulation = made_of(scene);
  const px::PxScene& made = scene_of(*simulation);
  EXPECT_EQ(made.getSolverType(), px::PxSolverType::eTGS);
  EXPECT_FLOAT_EQ(made.getBounceThresholdVelocity(), 0.7F);
  EXPECT_FLOAT_EQ(made.getFrictionCorrelationDistance(), 0.03F);
  EXPECT_FLOAT_EQ(made.getFrictionOffsetThreshold(), 0.02F);
  EXPECT_EQ(made.getFrictionType(), px::PxFrictionType::eTWO_DIRECTIONAL);
  EXPECT_TRUE(made.getFlags() & px::PxSceneFlag::eENABLE_CCD);
  EXPECT_TRUE(made.getFlags() & px::PxSceneFlag::eENABLE_STABILIZATION);
  EXPECT_FALSE(made.getFlags() & px::PxSceneFlag::eENABLE_PCM);
  const auto asked =
      made_of(scene, {.methods = {.solver = ConstraintSolver::ProjectedGaussSeidel}});
  EXPECT_EQ(scene_of(*asked).getSolverType(), px::PxSolverType::ePGS);
  EXPECT_FLOAT_EQ(scene_of(*asked).getMaxBiasCoefficient(), 8);
  EXPECT_TRUE(mentions(simulation->not_mapped(), "/Scene", "physxScene:maxBiasCoefficient"));
  const auto usual = made_of(one_box());
  EXPECT_EQ(scene_of(*usual).getSolverType(), px::PxSolverType::ePGS);
  EXPECT_TRUE(scene_of(*usual).getFlags() & px::PxSceneFlag::eENABLE_PCM);
}

TEST(PhysxSolver, WhatTheSolverDoesNotTellIsNamedWhereItIsAskedFor) {
  TestScene scene = one_box();
  scene.scenes[0].parts.physx = {{"solverType", {}, "TGS"}};
  SimulationOptions options;
  EXPECT_TRUE(made_of(scene, options)->not_mapped().empty());
  options.outputs.contacts = true;
  EXPECT_FALSE(made_of(scene, options)->not_mapped().empty());
}

TEST(PhysxSolver, IterationsAreTheBodysWithinTheScenesBoundsUnlessTheCallerAsks) {
  const auto counts = [](const TestScene& scene, int asked) {
    const auto simulation = made_of(scene, {.methods = {.iterations = asked}});
    px::PxU32 positions = 0;
    px::PxU32 velocities = 0;
    actor_of(*simulation).getSolverIterationCounts(positions, velocities);
    return std::pair(positions, velocities);
  };
  TestScene scene = one_box();
  EXPECT_EQ(counts(scene, 0), (std::pair<px::PxU32, px::PxU32>(16, 1)));
  scene.bodies[0].parts.physx = {{"solverPositionIterationCount", {40}, ""},
                                 {"solverVelocityIterationCount", {3}, ""}};
  EXPECT_EQ(counts(scene, 0), (std::pair<px::PxU32, px::PxU32>(40, 3)));
  scene.scenes[0].parts.physx = {{"maxPositionIterationCount", {20}, ""},
                                 {"minVelocityIterationCount", {5}, ""}};
  EXPECT_EQ(counts(scene, 0), (std::pair<px::PxU32, px::PxU32>(20, 5)));
  EXPECT_EQ(counts(scene, 7).first, 7u);
}

TEST(PhysxSolver, OfBodiesAreThoseOfTheirActors) {
  TestScene scene = one_box();
  scene.bodies[0].parts.physx = {
      {"contactSlopCoefficient", {0.1}, ""},   {"enableCCD", {1}, ""},
      {"enableSpeculativeCCD", {1}, ""},       {"maxContactImpulse", {5}, ""},
      {"maxDepenetrationVelocity", {0.6}, ""}, {"sleepThreshold", {0.02}, ""},
      {"stabilizationThreshold", {0.03}, ""}};
  const auto simulation = made_of(scene);
  const px::PxRigidDynamic& made = actor_of(*simulation);
  EXPECT_FLOAT_EQ(made.getContactSlopCoefficient(), 0.1F);
  EXPECT_FLOAT_EQ(made.getMaxContactImpulse(), 5);
  EXPECT_FLOAT_EQ(made.getMaxDepenetrationVelocity(), 0.6F);
  EXPECT_FLOAT_EQ(made.getSleepThreshold(), 0.02F);
  EXPECT_FLOAT_EQ(made.getStabilizationThreshold(), 0.03F);
  EXPECT_TRUE(made.getRigidBodyFlags() & px::PxRigidBodyFlag::eENABLE_CCD);
  EXPECT_TRUE(made.getRigidBodyFlags() & px::PxRigidBodyFlag::eENABLE_SPECULATIVE_CCD);
  scene.scenes[0].parts.physx = {{"disableSleeping", {1}, ""}};
  const auto awake = made_of(scene);
  EXPECT_EQ(actor_of(*awake).getSleepThreshold(), 0);
}

// A ball of 5 cm at 100 m/s is in front of a wall of 1 cm at one step and behind it at the next.
TEST(PhysxSolver, CcdFindsTheWallOnTheWay) {
  for (const bool sweeps : {false, true}) {
    TestScene scene(0);
    const Index ball = scene.add_body("ball", {{0, 0, 0}}, 1, {{0.01, 0.01, 0.01}});
    scene.bodies[ball].linear_velocity = {{100, 0, 0}};
    scene.add_collider("shape", ball, sphere(0.05));
    scene.add_collider("wall", {}, box({{0.005, 1, 1}}), {{{1.1, 0, 0}}});
    if (sweeps) {
      scene.scenes[0].parts.physx = {{"enableCCD", {1}, ""}};
      scene.bodies[ball].parts.physx = {{"enableCCD", {1}, ""}};
    }
    const auto simulation = made_of(scene, {.time_step = 0.002});
    run(*simulation, 0.04);
    EXPECT_EQ(simulation->body_state(ball).pose.position[0] < 1.1, sweeps);
  }
}

TEST(PhysxSolver, OfArticulationsAreTheirOwnAndLinksSayNothingOfThem) {
  TestScene scene;
  const Index a = scene.add_body("a", {{0, 0, 0}});
  scene.add_joint("hinge", JointKind::Revolute, {}, a).articulation = 0;
  scene.articulations.push_back(
      {named("a"),
       scene.joints[0].path,
       true,
       {a},
       {0},
       {},
       true,
       {{{"sleepThreshold", {0.04}, ""}, {"solverPositionIterationCount", {50}, ""}}}});
  scene.bodies[a].parts.physx = {{"solverPositionIterationCount", {9}, ""}};
  const auto simulation = made_of(scene);
  px::PxArticulationReducedCoordinate* tree = nullptr;
  ASSERT_EQ(scene_of(*simulation).getArticulations(&tree, 1), 1u);
  px::PxU32 positions = 0;
  px::PxU32 velocities = 0;
  tree->getSolverIterationCounts(positions, velocities);
  EXPECT_EQ(positions, 50u);
  EXPECT_FLOAT_EQ(tree->getSleepThreshold(), 0.04F);
  EXPECT_TRUE(
      mentions(simulation->not_mapped(), "/a", "physxRigidBody:solverPositionIterationCount"));
}

TEST(PhysxSolver, ArticulationsHaveTheIterationsOfTheirSchemaWhereTheAssetIsSilent) {
  TestScene scene;
  const Index a = scene.add_body("a", {{0, 0, 0}});
  scene.add_joint("hinge", JointKind::Revolute, {}, a).articulation = 0;
  scene.articulations.push_back({named("a"), scene.joints[0].path, true, {a}, {0}, {}, true, {}});
  const auto simulation = made_of(scene);
  px::PxArticulationReducedCoordinate* tree = nullptr;
  ASSERT_EQ(scene_of(*simulation).getArticulations(&tree, 1), 1u);
  px::PxU32 positions = 0;
  px::PxU32 velocities = 0;
  tree->getSolverIterationCounts(positions, velocities);
  EXPECT_EQ(positions, 32u);
  EXPECT_EQ(velocities, 1u);
}

TEST(PhysxSolver, ForcesOfDrivesAtTheBeginningOfAStepAreRefused) {
  const TestScene scene = one_box();
  Diagnostics diagnostics;
  const auto made = PhysxSimulation::make(scene, {.drives = DriveTerms::Explicit}, diagnostics);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code(), ErrorCode::Unsupported);
}

TEST(PhysxSolver, OfMujocoAreNamed) {
  TestScene scene = one_box();
  scene.scenes[0].parts.mujoco.emplace();
  scene.scenes[0].parts.mujoco->push_back({"option:cone", {}, "elliptic"});
  scene.colliders[0].parts.mujoco.condim = 4;
  const auto simulation = made_of(scene);
  EXPECT_TRUE(mentions(simulation->not_mapped(), "/Scene", "mjc:option:cone"));
  EXPECT_TRUE(mentions(simulation->not_mapped(), "/shape", "mjc:condim"));
}

// Wheels on axles in the world follow each other: turns by turns, ways by turns, along a curve, and
// down a chain of two.
// Bounds that samples move are followed without a new model: a pendulum rests on one that goes up.
TEST(PhysxBounds, FollowTheirSamplesInTheModelThatSteps) {
  for (const bool articulated : {true, false}) {
    TestScene scene;
    const Index rod = scene.add_body("rod", {{0.5, 0, 3}}, 1, {{0.001, 1.0 / 12, 1.0 / 12}});
    scene::Joint& hinge = scene.add_joint("hinge", JointKind::Revolute, {}, rod, scene::Axis::Y);
    hinge.frame0.position = {{0, 0, 3}};
    hinge.frame1.position = {{-0.5, 0, 0}};
    hinge.lower = -1;
    hinge.upper = 0.6;
    if (articulated) {
      hinge.articulation = 0;
      scene.articulations.push_back({named("rod"), hinge.path, true, {rod}, {0}, {}, true, {}});
    }
    scene::BoundsTrack track;
    track.times = {0, 2};
    track.bounds = {{-1, 0.6, 0, 0, {}}, {-1, 0.2, 0, 0, {}}};
    scene.bounds_tracks.push_back(track);
    const auto simulation = made_of(scene, {.time_step = 0.001});
    const void* at_start = simulation->engine_objects().model;
    run(*simulation, 1.9);
    EXPECT_NEAR(simulation->joint_state(0).position[0], 0.6 - 0.4 * 0.95, 0.01);
    EXPECT_EQ(simulation->engine_objects().model, at_start);
  }
}

// PhysX bounds one of the two turns across x only where the other is locked or bounded.
TEST(PhysxBounds, OfOneTurnOfAJointWhoseOthersAreFree) {
  for (const scene::Dof dof : {scene::Dof::RotX, scene::Dof::RotY, scene::Dof::RotZ}) {
    TestScene scene(0);
    const Index body = scene.add_body("body", {{0, 0, 0}}, 1, {{0.5, 0.5, 0.5}});
    scene::Joint& joint = scene.add_joint("joint", JointKind::D6, {}, body, scene::Axis::X);
    for (const scene::Dof slide : {scene::Dof::TransX, scene::Dof::TransY, scene::Dof::TransZ}) {
      joint.limits.push_back({slide, 1, -1});
    }
    joint.limits.push_back({dof, -0.3, 0.6});
    const auto simulation = made_of(scene);
    EXPECT_TRUE(simulation->not_mapped().empty());
    Wrench wrench;
    wrench.torque[static_cast<std::size_t>(dof) % 3] = 2;
    ASSERT_TRUE(simulation->set_body_wrench(body, wrench).has_value());
    run(*simulation, 2);
    const Vec3d turn = rotation_vector(simulation->body_state(body).pose.orientation);
    EXPECT_NEAR(length(turn), 0.6, 0.02);
    EXPECT_NEAR(turn[static_cast<std::size_t>(dof) % 3], 0.6, 0.02);
  }
}

TEST(PhysxMimics, CoupleJointsThatNoArticulationHolds) {
  for (const bool chained : {false, true}) {
    TestScene scene(0);
    const Index a = scene.add_body("a", {{0, 0, 0}}, 1, {{0.1, 0.1, 0.1}});
    const Index b = scene.add_body("b", {{1, 0, 0}}, 1, {{0.1, 0.1, 0.1}});
    scene.add_joint("leader", JointKind::Revolute, {}, a, scene::Axis::Y)
        .drives.push_back(drive(scene::Dof::RotY, 200, 20));
    scene.joints[0].drives[0].target_position = 2.5;
    scene::Joint& follower =
        scene.add_joint("follower", JointKind::Revolute, chained ? std::optional(a) : std::nullopt,
                        b, scene::Axis::Y);
    follower.frame0.position = {{1, 0, 0}};
    scene::Mimic mimic;
    mimic.dof = mimic.leader_dof = scene::Dof::RotY;
    mimic.leader = 0;
    mimic.multiplier = -1.6;  // beyond half a turn
    mimic.offset = 0.1;
    mimic.higher[0] = chained ? 0 : 0.2;
    follower.mimics = {mimic};
    const auto simulation = made_of(scene, {.time_step = 0.001});
    EXPECT_TRUE(simulation->not_mapped().empty());
    run(*simulation, 3);
    const double p = simulation->joint_state(0).position[0];
    EXPECT_NEAR(p, 2.5, 0.01);
    const double law = 0.1 - 1.6 * p + (chained ? 0 : 0.2 * p * p);
    const double q = simulation->joint_state(1).position[0];
    EXPECT_NEAR(std::remainder(q - law, 2 * M_PI), 0, 1e-3);
  }
}

TEST(PhysxMimics, OfARackTurnAWheelAndAreSoftWhereTheySaySo) {
  TestScene scene(0);
  const Index rack = scene.add_body("rack", {{0, 0, 0}}, 1, {{0.1, 0.1, 0.1}});
  const Index wheel = scene.add_body("wheel", {{1, 0, 0}}, 1, {{0.1, 0.1, 0.1}});
  scene.add_joint("slide", JointKind::Prismatic, {}, rack, scene::Axis::X)
      .drives.push_back(drive(scene::Dof::TransX, 500, 50));
  scene.joints[0].drives[0].target_position = 0.5;
  scene::Joint& hinge = scene.add_joint("hinge", JointKind::Revolute, {}, wheel, scene::Axis::Y);
  hinge.frame0.position = {{1, 0, 0}};
  scene::Mimic mimic;
  mimic.dof = scene::Dof::RotY;
  mimic.leader_dof = scene::Dof::TransX;
  mimic.leader = 0;
  mimic.multiplier = 4;
  hinge.mimics = {mimic};
  const auto rigid = made_of(scene, {.time_step = 0.001});
  run(*rigid, 2);
  EXPECT_NEAR(rigid->joint_state(1).position[0], 2, 0.01);
  // As a spring it gives way to a torque: w^2 times the inertia of both, I and m / 4^2, in series.
  scene.joints[1].mimics[0].natural_frequency = 20;
  scene.joints[1].mimics[0].damping_ratio = 1;
  scene.joints[0].drives[0].stiffness = 1e7;
  scene.joints[0].drives[0].damping = 1e4;
  const auto soft = made_of(scene, {.time_step = 0.001});
  const double torque = 0.5;
  ASSERT_TRUE(soft->set_joint_efforts(1, {&torque, 1}).has_value());
  run(*soft, 3);
  const double inertia = 1 / (1 / 0.1 + 16);
  EXPECT_NEAR(soft->joint_state(1).position[0] - 4 * soft->joint_state(0).position[0],
              0.5 / (400 * inertia), 0.002);
}

// A torque on either side moves I0 + k^2 I1, whatever the two moments are: beside each other, and
// with the follower on the leader's link, where their axes are one.
TEST(PhysxMimics, OfTreesShareATorqueByTheirInertias) {
  for (const bool chained : {false, true}) {
    for (const double factor : {1.0, -2.0, 0.5}) {
      for (const Index pushed : {Index{0}, Index{1}}) {
        TestScene scene(0);
        const Index base = scene.add_body("base", {{0, 0, 0}}, 5, {{1, 1, 1}});
        const Index a = scene.add_body("a", {{0, 0, 0}}, 1, {{0.05, 0.05, 0.05}});
        const Index b = scene.add_body("b", {{0, 0, 0}}, 1, {{0.01, 0.01, 0.01}});
        scene.add_joint("weld", JointKind::Fixed, {}, base, scene::Axis::X);
        scene.add_joint("leader", JointKind::Revolute, base, a, scene::Axis::Y).armature = 0.02;
        scene.add_joint("follower", JointKind::Revolute, chained ? a : base, b, scene::Axis::Y);
        scene::Mimic mimic;
        mimic.dof = mimic.leader_dof = scene::Dof::RotY;
        mimic.leader = 1;
        mimic.multiplier = factor;
        scene.joints[2].mimics = {mimic};
        for (scene::Joint& joint : scene.joints) {
          joint.articulation = 0;
        }
        scene.articulations.push_back(
            {named("base"), scene.joints[0].path, true, {base, a, b}, {0, 1, 2}, {}, true, {}});
        const auto simulation = made_of(scene, {.time_step = 0.001});
        const double torque = 0.1;
        ASSERT_TRUE(simulation->set_joint_efforts(1 + pushed, {&torque, 1}).has_value());
        run(*simulation, 0.5);
        const double turns = chained ? 1 + factor : factor;
        const double inertia = 0.05 + 0.02 + 0.01 * turns * turns;
        const double angle = torque * (pushed == 0 ? 1 : factor) / inertia * 0.5 * 0.5 / 2;
        EXPECT_NEAR(simulation->joint_state(1).position[0], angle, 0.02 * std::fabs(angle));
        EXPECT_NEAR(simulation->joint_state(2).position[0], factor * angle,
                    0.02 * std::fabs(factor * angle));
      }
    }
  }
}

TEST(PhysxMimics, BetweenMoreThanTwoBodiesAreNamed) {
  TestScene scene;
  for (const char* name : {"a", "b", "c"}) {
    scene.add_body(name, {});
  }
  scene.add_joint("leader", JointKind::Revolute, 0, 1, scene::Axis::Y);
  scene::Joint& follower = scene.add_joint("follower", JointKind::Revolute, 0, 2, scene::Axis::Y);
  scene::Mimic mimic;
  mimic.schema = "NewtonMimicAPI";
  mimic.dof = mimic.leader_dof = scene::Dof::RotY;
  follower.mimics = {mimic};
  EXPECT_TRUE(mentions(made_of(scene)->not_mapped(), "/follower", "NewtonMimicAPI"));
}

}  // namespace
}  // namespace tenon::engines::physx
