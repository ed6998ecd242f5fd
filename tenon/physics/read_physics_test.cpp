// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/read_physics.h"

#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/approximate/mesh_approximator.h"
#include "tenon/formats/text/reader.h"

namespace tenon::physics {
namespace {

/// A prism on an L of three unit squares, one high.
constexpr const char* kL = R"(#usda 1.0
(
    metersPerUnit = 1
    kilogramsPerUnit = 1
)
def Mesh "l" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]
) {
    uniform token physics:approximation = "convexDecomposition"
    uniform token subdivisionScheme = "none"
    point3f[] points = [(0,0,0), (2,0,0), (2,1,0), (1,1,0), (1,2,0), (0,2,0),
                        (0,0,1), (2,0,1), (2,1,1), (1,1,1), (1,2,1), (0,2,1)]
    int[] faceVertexCounts = [3, 3, 3, 3, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0,2,1, 0,3,2, 0,4,3, 0,5,4, 6,7,8, 6,8,9, 6,9,10, 6,10,11,
                               0,1,7,6, 1,2,8,7, 2,3,9,8, 3,4,10,9, 4,5,11,10, 5,0,6,11]
}
)";

PhysicsScene scene_of(const std::string& text, const ReadOptions& options) {
  Diagnostics diagnostics;
  auto layer = formats::read_text(text, "l.usda", diagnostics);
  const auto stage = stage::Stage::open(
      std::make_shared<layer::Layer>(std::move(*layer)), nullptr,
      [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
        return Error(ErrorCode::NotFound, "none").in_file(asset);
      });
  return read_physics(*stage, options, diagnostics);
}

double mass_read_with(const ReadOptions& options) {
  const PhysicsScene scene = scene_of(kL, options);
  return scene.bodies.size() == 1 ? scene.bodies.front().mass : -1;
}

TEST(ReadPhysics, DefaultOptionsDecomposeAsEveryVerbDoes) {
  ReadOptions as_verbs;
  as_verbs.mesh_tools = approximate::mesh_tools({});
  EXPECT_EQ(mass_read_with({}), mass_read_with(as_verbs));
  if (approximate::decomposition_library().available) {
    EXPECT_NEAR(mass_read_with({}), 3000, 30);  // three cubes of 1 m and water's density
  }
}

TEST(ReadPhysics, WithoutToolsTheHullWeighs) {
  ReadOptions without;
  without.mesh_tools = MeshTools{};
  // The hull adds half of the missing square.
  EXPECT_NEAR(mass_read_with(without), 3500, 1e-6);
}

// A fixed joint to the world whose frames are 2 m apart.
TEST(ReadPhysics, WhatIsFixedToTheWorldStaysWhereItStands) {
  const std::string text = R"(#usda 1.0
(
    metersPerUnit = 1
    kilogramsPerUnit = 1
)
def Xform "Base" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
    double3 xformOp:translate = (2, 0, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PhysicsFixedJoint "Fix" {
    rel physics:body1 = </Base>
    point3f physics:localPos0 = (0, 0, 1)
}
)";
  PhysicsScene scene = scene_of(text, {});
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(scene.joints[0].frame0.position, (Vec3d{{2, 0, 1}}));
  ReadOptions together;
  ASSERT_TRUE(set_reading(together.readings, "fixed-to-world", "together").has_value());
  scene = scene_of(text, together);
  EXPECT_EQ(scene.joints[0].frame0.position, (Vec3d{{0, 0, 1}}));
}

TEST(ReadPhysics, ABodyThatNothingWeighsHasOneUnitOfMass) {
  const PhysicsScene scene = scene_of(R"(#usda 1.0
(
    metersPerUnit = 1
    kilogramsPerUnit = 0.001
)
def Xform "Body" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
}
)",
                                      {});
  ASSERT_EQ(scene.bodies.size(), 1u);
  EXPECT_EQ(scene.bodies[0].mass, 0.001);
  EXPECT_NEAR(scene.bodies[0].inertia[0][0], 0.4 * 0.001 * 0.1 * 0.1, 1e-15);
}

}  // namespace
}  // namespace tenon::physics
