// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/stage_walk.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"
#include "tenon/stage/transform_at.h"

namespace tenon::physics {
namespace {

/// Prims of which few mean something to physics, most move, and some leave their parents behind.
std::string random_prims(std::mt19937& random, int depth) {
  static const char* const kHeads[] = {"def Xform", "def Xform", "def Scope", "over", "def Cube",
                                       "def Xform", "def Cube",  "def Xform", "def"};
  std::string text;
  for (int i = 0; depth > 0 && i < 4; ++i) {
    const std::size_t head = random() % 9;
    const char* const apis[] = {"", "", "PhysicsRigidBodyAPI", "PhysicsCollisionAPI"};
    const std::string api = apis[random() % 4];
    text += kHeads[head] + std::string(" \"p") + std::to_string(9 - i) + "\"" +
            (api.empty() ? "" : " (apiSchemas = [\"" + api + "\"])") + " {\n";
    if (random() % 4 != 0) {
      const char* const reset = random() % 5 == 0 ? "\"!resetXformStack!\", " : "";
      text += "double3 xformOp:translate = (" + std::to_string(random() % 9) + ", 0.3, -1)\n" +
              "float3 xformOp:rotateXYZ = (10, " + std::to_string(random() % 90) + ", 5)\n" +
              "uniform token[] xformOpOrder = [" + reset +
              "\"xformOp:translate\", \"xformOp:rotateXYZ\", \"!invert!xformOp:translate\"]\n";
    }
    text += random_prims(random, depth - 1) + "}\n";
  }
  return text;
}

Walk walk_of(const stage::Stage& stage) {
  Diagnostics unheard;
  static const Readings readings;
  const AttributeValues values(stage::Time(0), layer_contents(stage), ValueTypes::Strict, unheard);
  return walk_stage(stage, values, readings);
}

TEST(StageWalk, PlacesAreThoseOfEachPrimByItself) {
  std::mt19937 random(5);
  std::size_t met = 0;
  for (int round = 0; round < 20; ++round) {
    const stage::Stage stage = stage::open_text(random_prims(random, 4));
    stage::TransformCache transforms{stage::Time(0)};
    const Walk walk = walk_of(stage);
    met += walk.prims.size();
    for (const PhysicsPrim& found : walk.prims) {
      EXPECT_EQ(found.world, transforms.local_to_world(found.prim)) << found.path.str();
    }
  }
  EXPECT_GT(met, 500u);
}

TEST(StageWalk, HasItsPrimsByPathToo) {
  std::mt19937 random(6);
  const Walk walk = walk_of(stage::open_text(random_prims(random, 4)));
  ASSERT_EQ(walk.by_path.size(), walk.prims.size());
  for (std::size_t i = 1; i < walk.by_path.size(); ++i) {
    EXPECT_LT(walk.prims[walk.by_path[i - 1]].path, walk.prims[walk.by_path[i]].path);
  }
}

TEST(LayerContents, AreThoseOfAllLayersThatAreUsed) {
  const auto contents = [](const std::string& root, const std::string& part) {
    return layer_contents(
        stage::open_text(stage::Texts{{"root", root + "def \"R\" (references = @part@</P>) {}\n"},
                                      {"part", "def \"P\" {\n" + part + "}\n"}}));
  };
  const LayerContents plain = contents("def Cube \"C\" {\ndouble size = 1\n}\n", "int a = 1\n");
  EXPECT_FALSE(plain.animated);
  EXPECT_FALSE(plain.names_apis);
  EXPECT_TRUE(contents("", "int a.timeSamples = {0: 1}\n").animated);
  for (const char* name :
       {"float physics:mass", "float physxJoint:armature", "rel physics:simulationOwner",
        "token tenon:sensor", "float drive:rotX:physics:damping"}) {
    EXPECT_TRUE(contents("", name + std::string("\n")).names_apis) << name;
    EXPECT_TRUE(names_physics(Token(std::string(name).substr(std::string(name).find(' ') + 1))));
  }
  const LayerContents both =
      contents("def \"A\" {\nint a.timeSamples = {0: 1}\n}\n", "float physics:mass = 1\n");
  EXPECT_TRUE(both.animated && both.names_apis);
}

}  // namespace
}  // namespace tenon::physics
