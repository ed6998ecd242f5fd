// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tenon/math/angle.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

/// Centimetres: lengths of a text count 0.01.
PhysicsScene read(const std::string& text, const Readings& readings = {}) {
  const stage::Stage stage = stage::open_text(text);
  Diagnostics findings;
  ReadOptions options;
  options.readings = readings;
  return read_physics(stage, options, findings);
}

std::string body(const std::string& apis, const std::string& lines, const std::string& name = "B") {
  return "def Xform \"" + name + "\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"" +
         apis + "]) {\n float physics:mass = 2\n point3f physics:centerOfMass = (0, 50, 0)\n" +
         lines + "\n}\n";
}

TEST(PhysxSettings, AForceOnTheBodyActsAtItsCentreOneBelowAtItsOwnPlace) {
  const PhysicsScene scene = read(
      body(", \"PhysxForceAPI\"",
           "vector3f physxForce:force = (100, 0, 0)\n uniform token physxForce:mode = \"force\"\n"
           "def Xform \"Jet\" (apiSchemas = [\"PhysxForceAPI\"]) {\n"
           "double3 xformOp:translate = (0, 25, 0)\n quatf xformOp:orient = (0.70710678, 0, 0, "
           "0.70710678)\n uniform token[] xformOpOrder = [\"xformOp:translate\", "
           "\"xformOp:orient\"]\n vector3f physxForce:force = (100, 0, 0)\n"
           "vector3f physxForce:torque = (0, 0, 2)\n}"));
  const std::vector<BodyForce>& forces = scene.bodies.at(0).settings.forces;
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_FALSE(forces[0].acceleration);
  EXPECT_TRUE(forces[0].body_axes);
  EXPECT_NEAR(forces[0].force[0], 1, 1e-9);
  EXPECT_NEAR(forces[0].point[1], 0.5, 1e-9);
  EXPECT_TRUE(forces[1].acceleration);
  EXPECT_NEAR(forces[1].force[1], 1, 1e-6);
  EXPECT_NEAR(forces[1].torque[2], 2, 1e-9);
  EXPECT_NEAR(forces[1].point[1], 0.25, 1e-6);
}

TEST(PhysxSettings, AForceThatIsOffOrOnNothingIsNone) {
  EXPECT_TRUE(read(body(", \"PhysxForceAPI\"",
                        "vector3f physxForce:force = (1, 0, 0)\n bool physxForce:forceEnabled = 0"))
                  .bodies[0]
                  .settings.forces.empty());
  const stage::Stage stage = stage::open_text(
      "def Xform \"X\" (apiSchemas = [\"PhysxForceAPI\"]) {\n vector3f physxForce:force = (1, 0, "
      "0)\n}");
  Diagnostics findings;
  read_physics(stage, {}, findings);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.begin()->rule, "force.no-body");
}

TEST(PhysxSettings, SpeedsAndLocksOfBodies) {
  const BodySettings settings =
      read(body(", \"PhysxRigidBodyAPI\"",
                "float physxRigidBody:maxLinearVelocity = 300\n"
                "float physxRigidBody:maxAngularVelocity = 180\n"
                "int physxRigidBody:lockedPosAxis = 5\n int physxRigidBody:lockedRotAxis = 3\n"
                "bool physxRigidBody:enableGyroscopicForces = 0\n"
                "bool physxRigidBody:solveContact = 0"))
          .bodies[0]
          .settings;
  EXPECT_NEAR(settings.max_linear_velocity, 3, 1e-9);
  EXPECT_NEAR(settings.max_angular_velocity, M_PI, 1e-9);
  EXPECT_EQ(settings.locked_translation, 5);
  EXPECT_EQ(settings.locked_rotation, 3);
  EXPECT_FALSE(settings.gyroscopic);
  EXPECT_FALSE(settings.solves_contacts);
}

TEST(PhysxSettings, WhatPhysxDoesUnaskedIsAnOption) {
  EXPECT_EQ(read(body("", "")).bodies[0].angular_damping, 0);
  Readings physx;
  ASSERT_TRUE(set_reading(physx, "body-defaults", "physx").has_value());
  const Body told = read(body("", ""), physx).bodies[0];
  EXPECT_EQ(told.angular_damping, 0.05);
  EXPECT_EQ(told.settings.max_angular_velocity, 100);
  const Body own =
      read(body(", \"PhysxRigidBodyAPI\"", "float physxRigidBody:angularDamping = 0"), physx)
          .bodies[0];
  EXPECT_EQ(own.angular_damping, 0);
}

TEST(PhysxSettings, TriggersHaveNoShareInTheMass) {
  const std::string cube = " (apiSchemas = [\"PhysicsCollisionAPI\"%]) {\n double size = 100\n}\n";
  const auto with = [&](const std::string& api) {
    std::string second = cube;
    second.replace(second.find('%'), 1, api);
    std::string first = cube;
    first.replace(first.find('%'), 1, "");
    return read("def Xform \"B\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n def Cube \"a\"" +
                first + "def Cube \"b\"" + second + "}\n");
  };
  const PhysicsScene scene = with(", \"PhysxTriggerAPI\"");
  EXPECT_TRUE(scene.colliders[1].settings.trigger);
  EXPECT_NEAR(scene.bodies[0].mass, 1000, 1e-6);
  EXPECT_NEAR(with("").bodies[0].mass, 2000, 1e-6);
}

TEST(PhysxSettings, SurfacesOfBodiesMove) {
  const std::string belt =
      "def Cube \"Belt\" (apiSchemas = [\"PhysicsCollisionAPI\", \"PhysxSurfaceVelocityAPI\"%]) {\n"
      "vector3f physxSurfaceVelocity:surfaceVelocity = (100, 0, 0)\n"
      "vector3f physxSurfaceVelocity:surfaceAngularVelocity = (0, 0, 180)\n"
      "bool physxSurfaceVelocity:surfaceVelocityLocalSpace = 0\n}\n";
  std::string on_body = belt;
  on_body.replace(on_body.find('%'), 1, ", \"PhysicsRigidBodyAPI\"");
  const auto surface = read(on_body).colliders[0].settings.surface_velocity;
  ASSERT_TRUE(surface.has_value());
  EXPECT_NEAR(surface->linear[0], 1, 1e-9);
  EXPECT_NEAR(surface->angular[2], M_PI, 1e-9);
  EXPECT_FALSE(surface->body_axes);
  std::string still = belt;
  still.replace(still.find('%'), 1, "");
  const PhysicsScene scene = read(still);
  EXPECT_FALSE(scene.colliders[0].settings.surface_velocity.has_value());
  EXPECT_EQ(scene.not_read.at(0).property, "PhysxSurfaceVelocityAPI");
}

std::string joint(const std::string& type, const std::string& name, const std::string& apis,
                  const std::string& lines, const std::string& on = "B") {
  return "def " + type + " \"" + name + "\" (apiSchemas = [" + apis +
         "]) {\n rel physics:body1 = </" + on + ">\n" + lines + "\n}\n";
}

TEST(PhysxSettings, LimitsGiveWayPerRadianAndDistancesPerMetre) {
  const PhysicsScene scene =
      read(body("", "") +
           joint("PhysicsDistanceJoint", "D", "\"PhysxPhysicsDistanceJointAPI\"",
                 "bool physxPhysicsDistanceJoint:springEnabled = 1\n"
                 "float physxPhysicsDistanceJoint:springStiffness = 20\n"
                 "float physxPhysicsDistanceJoint:springDamping = 3\n"
                 "float physics:maxDistance = 10") +
           joint("PhysicsRevoluteJoint", "R", "\"PhysxLimitAPI:angular\"",
                 "float physics:upperLimit = 0\n float physxLimit:angular:stiffness = 10000\n"
                 "float physxLimit:angular:damping = 20000\n"
                 "float physxLimit:angular:restitution = 0.5"));
  ASSERT_EQ(scene.joints.at(0).limit_springs.size(), 1u);
  EXPECT_EQ(scene.joints[0].limit_springs[0].dof, Dof::Distance);
  EXPECT_NEAR(scene.joints[0].limit_springs[0].stiffness, 20, 1e-9);
  EXPECT_NEAR(scene.joints[0].limit_springs[0].damping, 3, 1e-9);
  ASSERT_EQ(scene.joints.at(1).limit_springs.size(), 1u);
  EXPECT_NEAR(scene.joints[1].limit_springs[0].stiffness, 1, 1e-9);
  EXPECT_NEAR(scene.joints[1].limit_springs[0].damping, 2, 1e-9);
  EXPECT_NEAR(scene.joints[1].limit_springs[0].restitution, 0.5, 1e-9);
}

TEST(PhysxSettings, GearsAndRacksCoupleTwoJoints) {
  const PhysicsScene scene = read(
      body("", "", "B") + body("", "", "C") + body("", "", "D") +
      joint("PhysicsRevoluteJoint", "H0", "", "", "B") +
      joint("PhysicsRevoluteJoint", "H1", "",
            "quatf physics:localRot1 = (0.9961947, -0.08715574, "
            "0, 0)",
            "C") +
      joint("PhysicsPrismaticJoint", "S", "", "", "D") +
      "def PhysxPhysicsGearJoint \"Gear\" {\n rel physics:hinge0 = </H0>\n rel physics:hinge1 = "
      "</H1>\n float physics:gearRatio = 3\n}\n"
      "def PhysxPhysicsRackAndPinionJoint \"Rack\" {\n rel physics:hinge = </H0>\n rel "
      "physics:prismatic = </S>\n float physics:ratio = 90\n}\n");
  ASSERT_EQ(scene.joints.size(), 3u);  // gears are none
  ASSERT_EQ(scene.joints[1].mimics.size(), 1u);
  EXPECT_EQ(scene.joints[1].mimics[0].leader, 0u);
  EXPECT_NEAR(scene.joints[1].mimics[0].multiplier, -3, 1e-9);
  EXPECT_NEAR(std::fabs(scene.joints[1].mimics[0].offset), 10 * kRadians, 1e-5);
  ASSERT_EQ(scene.joints[0].mimics.size(), 1u);
  EXPECT_EQ(scene.joints[0].mimics[0].leader, 2u);
  EXPECT_NEAR(scene.joints[0].mimics[0].multiplier, 90 * kRadians / 0.01, 1e-6);
}

TEST(PhysxSettings, AFixedTendonSumsDegreesOfItsJoints) {
  const PhysicsScene scene =
      read(body("", "", "B") + body("", "", "C") +
           joint("PhysicsRevoluteJoint", "H0", "\"PhysxTendonAxisRootAPI:t\"",
                 "float physxTendon:t:stiffness = 100\n float physxTendon:t:damping = 200\n"
                 "float physxTendon:t:restLength = 10\n float physxTendon:t:offset = 4\n"
                 "float physxTendon:t:upperLimit = 90\n float physxTendon:t:limitStiffness = 300",
                 "B") +
           joint("PhysicsRevoluteJoint", "H1", "\"PhysxTendonAxisAPI:t\"",
                 "float[] physxTendon:t:gearing = [-2]", "C"));
  ASSERT_EQ(scene.tendons.size(), 1u);
  const Tendon& tendon = scene.tendons[0];
  EXPECT_EQ(tendon.coefficients, (std::vector<double>{1, -2}));
  EXPECT_NEAR(tendon.stiffness, 100 * 1e-4 / kRadians, 1e-9);
  EXPECT_NEAR(tendon.damping, 200 * 1e-4 / kRadians, 1e-9);
  EXPECT_NEAR(tendon.spring_length[0], 6 * kRadians, 1e-9);
  ASSERT_TRUE(tendon.range.has_value());
  EXPECT_NEAR((*tendon.range)[1], 86 * kRadians, 1e-9);
  EXPECT_NEAR(tendon.limit_stiffness, 300 * 1e-4 / kRadians, 1e-9);
}

TEST(PhysxSettings, EachLeafOfASpatialTendonIsOne) {
  const PhysicsScene scene = read(
      body(", \"PhysxTendonAttachmentRootAPI:r\"",
           "float physxTendon:r:stiffness = 50\n point3f physxTendon:r:localPos = (10, 0, 0)",
           "B") +
      body(", \"PhysxTendonAttachmentAPI:m\"",
           "uniform token physxTendon:m:parentAttachment = \"r\"\n rel physxTendon:m:parentLink = "
           "</B>\n float physxTendon:m:gearing = 2",
           "C") +
      body(", \"PhysxTendonAttachmentLeafAPI:l\"",
           "uniform token physxTendon:l:parentAttachment = \"m\"\n rel physxTendon:l:parentLink = "
           "</C>\n float physxTendon:l:gearing = 4\n float physxTendon:l:restLength = 100",
           "D"));
  ASSERT_EQ(scene.tendons.size(), 1u);
  const Tendon& tendon = scene.tendons[0];
  ASSERT_EQ(tendon.wraps.size(), 5u);
  EXPECT_NEAR(tendon.wraps[0].attachment.pose.position[0], 0.1, 1e-9);
  EXPECT_EQ(tendon.wraps[2].kind, TendonWrap::Kind::Pulley);
  EXPECT_NEAR(tendon.wraps[2].divisor, 0.5, 1e-9);
  // Length of PhysX = 2 (|rm| + 2 |ml|): stiffness 50 by 2^2, rest 100 cm by 2.
  EXPECT_NEAR(tendon.stiffness, 200, 1e-9);
  EXPECT_NEAR(tendon.spring_length[0], 0.5, 1e-9);
}

TEST(PhysxSettings, AnEnvelopeIsPerDegree) {
  const PhysicsScene scene = read(
      body("", "") +
      joint("PhysicsRevoluteJoint", "R",
            "\"PhysicsDriveAPI:angular\", \"PhysxDrivePerformanceEnvelopeAPI:angular\"",
            "float drive:angular:physics:damping = 1\n"
            "float physxDrivePerformanceEnvelope:angular:maxActuatorVelocity = 180\n"
            "float physxDrivePerformanceEnvelope:angular:velocityDependentResistance = 10000"));
  const DriveEnvelope& envelope = scene.joints.at(0).drives.at(0).envelope;
  EXPECT_NEAR(envelope.max_velocity, M_PI, 1e-9);
  EXPECT_NEAR(envelope.velocity_resistance, 1 / kRadians, 1e-9);
}

}  // namespace
}  // namespace tenon::physics
