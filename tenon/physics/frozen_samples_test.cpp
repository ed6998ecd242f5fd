// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every attribute of physics that may vary is followed in time, or it is said that it is not.
#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tenon/physics/read_physics.h"
#include "tenon/physics/vendors/vendor_attributes.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from)) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Two values of a type.
std::string samples_of(const std::string& type) {
  static const std::map<std::string, std::pair<std::string, std::string>> values{
      {"bool", {"0", "1"}},
      {"int", {"1", "2"}},
      {"uint", {"1", "2"}},
      {"float", {"1", "2"}},
      {"double", {"1", "2"}},
      {"token", {"\"X\"", "\"Y\""}},
      {"string", {"\"X\"", "\"Y\""}},
      {"float2", {"(1, 2)", "(2, 3)"}},
      {"float3", {"(1, 2, 3)", "(2, 3, 4)"}},
      {"double3", {"(1, 2, 3)", "(2, 3, 4)"}},
      {"point3f", {"(1, 2, 3)", "(2, 3, 4)"}},
      {"vector3f", {"(1, 2, 3)", "(2, 3, 4)"}},
      {"quatf", {"(1, 0, 0, 0)", "(0, 1, 0, 0)"}},
      {"int[]", {"[1]", "[2]"}},
      {"float[]", {"[1]", "[2]"}},
      {"double[]", {"[1]", "[2]"}},
      {"float6[]", {"", ""}},
  };
  const auto found = values.find(type);
  return found == values.end() || found->second.first.empty()
             ? ""
             : "{ 0: " + found->second.first + ", 24: " + found->second.second + " }";
}

bool has_tracks(const PhysicsScene& scene) {
  return !scene.scalar_tracks.empty() || !scene.pose_tracks.empty() ||
         !scene.switch_tracks.empty() || !scene.bounds_tracks.empty() ||
         !scene.gravity_tracks.empty() || !scene.shapes_tracks.empty() ||
         !scene.scene_tracks.empty() || !scene.body_tracks.empty() ||
         !scene.collider_tracks.empty() || !scene.material_tracks.empty() ||
         !scene.joint_tracks.empty() || !scene.tendon_tracks.empty() ||
         !scene.actuator_tracks.empty() || !scene.group_states.empty();
}

bool names(const PhysicsScene& scene, const Diagnostics& findings, const std::string& name) {
  return std::any_of(scene.not_read.begin(), scene.not_read.end(),
                     [&](const scene::NotRead& part) { return part.property == name; }) ||
         std::any_of(findings.begin(), findings.end(), [&](const Diagnostic& finding) {
           return finding.message.find(name) != std::string::npos || finding.property == name;
         });
}

PhysicsScene read_text(const std::string& text, Diagnostics& findings) {
  const stage::Stage stage = stage::open_text(text);
  return read_physics(stage, {}, findings);
}

/// A prim that the schema fits; of an API the types that it may be applied to, or a body.
std::string prim_of(const schema::Schema& schema, const std::string& attribute) {
  if (!schema.is_applied_api()) {
    return "def " + schema.name.str() + " \"P\" {\n" + attribute + "\n}";
  }
  const bool multiple = schema.kind == schema::SchemaKind::MultipleApplyApi;
  const std::string api = schema.name.str() + (multiple ? ":rotX" : "");
  const bool body = schema.can_only_apply_to.empty();
  const std::string type = body ? "Xform" : schema.can_only_apply_to[0].str();
  std::string apis = "\"" + api + "\"";
  if (body && schema.name != "PhysicsRigidBodyAPI") {
    apis = "\"PhysicsRigidBodyAPI\", " + apis;
  }
  return "def " + type + " \"P\" (apiSchemas = [" + apis + "]) {\n" + attribute + "\n}";
}

TEST(FrozenSamples, EachAttributeThatMayVaryIsFollowedOrNamed) {
  std::size_t count = 0;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    const bool is_physics = schema->name.view().starts_with("Physics") || schema->vendor;
    const bool is_prim =
        schema->is_applied_api() || schema->kind == schema::SchemaKind::ConcreteTyped;
    for (const schema::PropertyDefinition& property : schema->properties) {
      const bool varies =
          !property.is_relationship && property.variability == layer::Variability::Varying;
      const std::string name = replaced(property.name.str(), "__INSTANCE_NAME__", "rotX");
      const std::string samples = samples_of(property.type_name.str());
      if (!is_physics || !is_prim || !varies || samples.empty() || name.starts_with("xformOp") ||
          (name.find(':') == std::string::npos)) {
        continue;
      }
      Diagnostics findings;
      const PhysicsScene scene = read_text(
          prim_of(*schema, property.type_name.str() + " " + name + ".timeSamples = " + samples),
          findings);
      const bool harmless = use_of_vendor_attribute(name) == VendorUse::Harmless;
      EXPECT_TRUE(harmless || has_tracks(scene) || names(scene, findings, name))
          << schema->name.str() << " " << name;
      ++count;
    }
  }
  EXPECT_GT(count, 100u);
}

constexpr const char* kBody = R"(def Xform "B" (
  apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
)
{
  %BODY%
  def Sphere "S" (
    apiSchemas = ["PhysicsCollisionAPI", "PhysicsMassAPI"]
  )
  {
    %SPHERE%
  }
}
)";

std::string body_with(const std::string& body, const std::string& sphere) {
  return replaced(replaced(kBody, "%BODY%", body), "%SPHERE%", sphere);
}

// Sampled at 0 and 24 of 24 codes per second: four samples a frame between.
TEST(FrozenSamples, MassesAndSizesOfBodiesAreFollowed) {
  struct Case {
    const char* body;
    const char* sphere;
    double ratio;  // of the masses at the end and at the start
  };
  const Case cases[] = {
      {"float physics:mass.timeSamples = { 0: 1, 24: 3 }", "", 3},
      {"float physics:density.timeSamples = { 0: 1, 24: 3 }", "double radius = 1", 3},
      {"", "float physics:density.timeSamples = { 0: 1, 24: 2 }\ndouble radius = 1", 2},
      {"", "float physics:mass.timeSamples = { 0: 4, 24: 6 }", 1.5},
      {"", "float physics:density = 1\ndouble radius.timeSamples = { 0: 1, 24: 2 }", 8},
  };
  for (const Case& test : cases) {
    Diagnostics findings;
    const PhysicsScene scene = read_text(body_with(test.body, test.sphere), findings);
    ASSERT_EQ(scene.shapes_tracks.size(), 1u) << test.body << test.sphere;
    const scene::ShapesTrack& track = scene.shapes_tracks[0];
    EXPECT_NEAR(track.times.back(), 1, 1e-9);
    EXPECT_TRUE(scene.not_read.empty()) << scene.not_read[0].property;
    const double first = track.shapes.front().mass;
    EXPECT_NEAR(first, scene.bodies[0].mass, 1e-6 * first);
    EXPECT_NEAR(track.shapes.back().mass / first, test.ratio, 1e-6) << test.body << test.sphere;
  }
}

TEST(FrozenSamples, CentresAndInertiasAreFollowed) {
  Diagnostics findings;
  const PhysicsScene scene = read_text(
      body_with("float physics:mass = 1\n"
                "float3 physics:diagonalInertia.timeSamples = { 0: (1, 1, 1), 24: (2, 2, 2) }\n"
                "point3f physics:centerOfMass.timeSamples = { 0: (0, 0, 0), 24: (0, 0, 50) }",
                ""),
      findings);
  ASSERT_EQ(scene.shapes_tracks.size(), 1u);
  const auto& end = scene.shapes_tracks[0].shapes.back();
  EXPECT_NEAR(end.center_of_mass[2], 0.5, 1e-9);  // 50 cm
  EXPECT_NEAR(end.inertia[0][0], 2e-4, 1e-12);    // kg cm^2
}

// Sampled at 0 and 24 of 24 codes per second.
TEST(FrozenSamples, OfJointsAndMaterialsAreFollowed) {
  Diagnostics findings;
  const PhysicsScene scene = read_text(R"(def Xform "A" (
  apiSchemas = ["PhysicsRigidBodyAPI"]
)
{
  def Sphere "S" (
    apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"]
  )
  {
    rel material:binding = </M>
  }
}
def PhysicsFixedJoint "J"
{
  rel physics:body1 = </A>
  point3f physics:localPos1.timeSamples = { 0: (0, 0, 0), 24: (100, 0, 0) }
  float physics:breakForce.timeSamples = { 0: 10, 24: 20 }
}
def Material "M" (
  apiSchemas = ["PhysicsMaterialAPI"]
)
{
  float physics:dynamicFriction.timeSamples = { 0: 0, 24: 1 }
  float physics:density.timeSamples = { 0: 1, 24: 2 }
}
)",
                                       findings);
  EXPECT_TRUE(scene.not_read.empty()) << scene.not_read[0].property;
  ASSERT_EQ(scene.joint_tracks.size(), 1u);
  const auto& joint = scene.joint_tracks[0];
  EXPECT_EQ(joint.times.size(), 96u);
  EXPECT_NEAR(joint.times.back(), 1, 1e-9);
  EXPECT_NEAR(joint.states.back().frame1.position[0], 1, 1e-9);
  EXPECT_NEAR(joint.states[47].frame1.position[0], 0.5, 1e-9);
  EXPECT_NEAR(joint.states.back().break_force, 0.2, 1e-9);  // kg cm/s^2
  ASSERT_EQ(scene.material_tracks.size(), 1u);
  EXPECT_NEAR(scene.material_tracks[0].states.back().dynamic_friction, 1, 1e-9);
  ASSERT_EQ(scene.body_tracks.size(), 1u);
  EXPECT_NEAR(scene.body_tracks[0].states.back().mass / scene.bodies[0].mass, 2, 1e-6);
  EXPECT_TRUE(scene.collider_tracks.empty());
}

TEST(FrozenSamples, OfSizesAndSettingsAreFollowed) {
  Diagnostics findings;
  const PhysicsScene scene = read_text(R"(def Cube "Floor" (
  apiSchemas = ["PhysicsCollisionAPI", "PhysxCollisionAPI"]
)
{
  double size = 100
  double size.timeSamples = { 0: 100, 24: 200 }
  color3f[] primvars:displayColor.timeSamples = { 0: [(1, 0, 0)], 24: [(0, 1, 0)] }
  float physxCollision:restOffset.timeSamples = { 0: 0, 24: 1 }
}
def Mesh "Ground" (
  apiSchemas = ["PhysicsCollisionAPI"]
)
{
  int[] faceVertexCounts = [3]
  int[] faceVertexIndices = [0, 1, 2]
  point3f[] points.timeSamples = { 0: [(0, 0, 0), (100, 0, 0), (0, 0, 100)],
                                   12: [(0, 0, 0), (100, 0, 0), (0, 0, 100)],
                                   24: [(0, 0, 0), (200, 0, 0), (0, 0, 100)] }
}
def Xform "A" (
  apiSchemas = ["PhysicsRigidBodyAPI", "PhysxRigidBodyAPI"]
)
{
  float physxRigidBody:linearDamping.timeSamples = { 0: 0, 24: 4 }
}
)",
                                       findings);
  EXPECT_TRUE(scene.not_read.empty()) << scene.not_read[0].property;
  ASSERT_EQ(scene.collider_tracks.size(), 2u);
  const auto& floor = scene.collider_tracks[0];
  EXPECT_NEAR(floor.states.back().shape.half_extents[0], 1, 1e-9);
  EXPECT_NEAR(*floor.states.back().rest_offset, 0.01, 1e-9);
  const auto& ground = scene.collider_tracks[1];
  EXPECT_GT(ground.times.front(), 0.5);  // until then it is as at the start
  EXPECT_NEAR(scene.meshes[ground.states.back().shape.mesh].points[1][0], 2, 1e-6);
  ASSERT_EQ(scene.body_tracks.size(), 1u);
  EXPECT_NEAR(scene.body_tracks[0].states.back().linear_damping, 4, 1e-9);
}

TEST(FrozenSamples, WhatStatesCannotSayIsNamed) {
  Diagnostics findings;
  const PhysicsScene scene = read_text(R"(def PhysicsScene "S" (
  apiSchemas = ["PhysxSceneAPI"]
)
{
  uint physxScene:timeStepsPerSecond.timeSamples = { 0: 60, 24: 120 }
}
def Xform "A" (
  apiSchemas = ["PhysicsRigidBodyAPI", "PhysxRigidBodyAPI"]
)
{
  float physxRigidBody:linearDamping.timeSamples = { 0: 0, 24: 4 }
}
)",
                                       findings);
  ASSERT_EQ(scene.not_read.size(), 1u);
  EXPECT_EQ(scene.not_read[0].property, "physxScene:timeStepsPerSecond");
  EXPECT_TRUE(scene.scene_tracks.empty());
  EXPECT_EQ(scene.body_tracks.size(), 1u);
}

TEST(FrozenSamples, CountBesideADefaultToo) {
  Diagnostics findings;
  const PhysicsScene scene = read_text(
      body_with("float physics:mass = 5\nfloat physics:mass.timeSamples = { 0: 1, 24: 3 }", ""),
      findings);
  EXPECT_EQ(scene.bodies[0].mass, 5);
  ASSERT_EQ(scene.shapes_tracks.size(), 1u);
  EXPECT_NEAR(scene.shapes_tracks[0].shapes.back().mass, 3, 1e-9);
}

}  // namespace
}  // namespace tenon::physics
