// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/vendors/read_mujoco_parts.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/physics/read_physics.h"

namespace tenon::physics {
namespace {

using Target = MujocoActuator::Target;

constexpr const char* kScene = R"(#usda 1.0
(
    metersPerUnit = 0.01
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "r" {
    def Xform "b" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
        def Xform "tip" {
            double3 xformOp:translate = (0, 0, 50)
            token[] xformOpOrder = ["xformOp:translate"]
        }
    }
    def Xform "a" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {}
    def PhysicsRevoluteJoint "turn" {
        rel physics:body0 = </r/b>
        rel physics:body1 = </r/a>
    }
    def MjcActuator "servo" {
        uniform double[] mjc:biasPrm = [0, -20000, -10]
        uniform token mjc:biasType = "affine"
        uniform double[] mjc:gainPrm = [20000]
        rel mjc:target = </r/turn>
    }
    def MjcActuator "motor" {
        uniform double[] mjc:gainPrm = [20000]
        uniform double mjc:ctrlRange:max = 2
        uniform token mjc:forceLimited = "false"
        uniform double mjc:forceRange:max = 5
        rel mjc:target = </r/turn>
    }
    def MjcActuator "jet" {
        uniform double[] mjc:gear = [0, 0, 1]
        rel mjc:target = </r/b/tip>
    }
    def MjcActuator "lost" {
        rel mjc:target = </r/none>
    }
    def MjcKeyframe "key" {
        double[] mjc:qpos = [1, 2]
    }
    over "none" {}
}
)";

TEST(ReadMujocoParts, ReadsActuatorsInTheOrderOfTheStageInSi) {
  Diagnostics findings;
  auto layer = formats::read_text(kScene, "r.usda", findings);
  ASSERT_TRUE(layer) << layer.error().to_string();
  auto root = std::make_shared<layer::Layer>(std::move(*layer));
  const auto stage = stage::Stage::open(
      root, nullptr, [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
        return Error(ErrorCode::NotFound, "none").in_file(asset);
      });
  ASSERT_TRUE(stage);
  const PhysicsScene scene = read_physics(*stage, {}, findings);
  const MujocoParts parts = read_mujoco_parts(*stage, scene);
  ASSERT_EQ(parts.actuators.size(), 4u);
  const MujocoActuator& servo = parts.actuators[0];
  EXPECT_EQ(servo.drive, std::optional<Index>(0));
  EXPECT_DOUBLE_EQ(servo.bias[1], -2);  // [kg cm^2/s^2] to [N m]
  const MujocoActuator& motor = parts.actuators[1];
  EXPECT_EQ(motor.kind, Target::Joint);
  EXPECT_FALSE(motor.drive);
  EXPECT_DOUBLE_EQ(motor.gain[0], 2);
  EXPECT_EQ(motor.control_range, (std::array<double, 2>{0, 2}));
  EXPECT_FALSE(motor.force_range);
  const MujocoActuator& jet = parts.actuators[2];
  EXPECT_EQ(jet.kind, Target::Site);
  ASSERT_TRUE(jet.site.body);
  EXPECT_EQ(scene.bodies[*jet.site.body].path.str(), "/r/b");
  EXPECT_DOUBLE_EQ(jet.site.pose.position[2], 0.5);
  EXPECT_DOUBLE_EQ(jet.gain[0], 0.01);  // [kg cm/s^2] to [N]
  EXPECT_EQ(jet.gear[2], 1);
  EXPECT_EQ(parts.actuators[3].kind, Target::None);
  EXPECT_NE(parts.actuators[3].fault.find("/r/none"), std::string::npos);
  ASSERT_EQ(parts.keyframes.size(), 1u);
  EXPECT_EQ(parts.keyframes[0].positions, (std::vector<double>{1, 2}));
  EXPECT_EQ(parts.body_ranks, (std::vector<Index>{1, 0}));  // /r/a, /r/b
}

}  // namespace
}  // namespace tenon::physics
