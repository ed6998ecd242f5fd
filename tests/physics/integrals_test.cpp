// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// M-20: whoever reads physics may say what colliders weigh.
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage.h"

namespace tenon {
namespace {

constexpr const char* kScene = R"(#usda 1.0
(
    metersPerUnit = 0.01
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "S"
{
}
def Xform "B" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI"]
)
{
    def Cube "Box" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        double size = 100
    }
    def Cylinder "Turned" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        uniform token axis = "X"
        double3 xformOp:translate = (300, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def NurbsPatch "Foreign" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
    }
    def Cube "Off" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        bool physics:collisionEnabled = 0
    }
}
)";

scene::PhysicsScene read(const physics::ReadOptions& options) {
  Diagnostics diagnostics;
  auto layer = formats::read_text(kScene, "scene.usda", diagnostics);
  EXPECT_TRUE(layer.has_value());
  auto stage =
      stage::Stage::open(std::make_shared<const layer::Layer>(*std::move(layer)), nullptr,
                         [](const std::string&, const layer::Layer&) -> Result<layer::LayerPtr> {
                           return Error(ErrorCode::NotFound, "there are no other layers");
                         });
  EXPECT_TRUE(stage.has_value());
  return physics::read_physics(*stage, options, diagnostics);
}

TEST(MassCallback, GivesIntegralsOncePerEnabledCollider) {
  std::map<std::string, int> asked;
  physics::ReadOptions options;
  options.integrals = [&](const stage::Prim& prim) -> std::optional<scene::SolidIntegrals> {
    ++asked[prim.path().str()];
    if (prim.name() == Token("Box")) {
      return std::nullopt;  // as the shape says: 1 m^3
    }
    scene::SolidIntegrals solid;
    solid.volume = prim.name() == Token("Turned") ? 2 : 1;
    solid.center = {{0, 0, 0.5}};
    return solid;
  };
  const scene::PhysicsScene scene = read(options);
  const std::map<std::string, int> once{{"/B/Box", 1}, {"/B/Foreign", 1}, {"/B/Turned", 1}};
  EXPECT_EQ(asked, once);
  ASSERT_EQ(scene.bodies.size(), 1u);
  // 1000 kg/m^3 on 1, 2 and 1 m^3; the centre of those told lies 0.5 m along their own Z.
  EXPECT_NEAR(scene.bodies[0].mass, 4000, 1e-6);
  EXPECT_NEAR(scene.bodies[0].center_of_mass[0], 2 * 3 / 4.0, 1e-9);
  EXPECT_NEAR(scene.bodies[0].center_of_mass[2], 3 * 0.5 / 4.0, 1e-9);
  EXPECT_EQ(scene.colliders.size(), 4u);
}

TEST(MassCallback, WithoutItForeignShapesWeighNothing) {
  const scene::PhysicsScene scene = read({});
  EXPECT_EQ(scene.colliders.size(), 3u);
  EXPECT_LT(scene.bodies[0].mass, 1000.01);
}

}  // namespace
}  // namespace tenon
