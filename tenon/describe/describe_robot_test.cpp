// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/describe_robot.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/physics/read_physics.h"

namespace tenon::describe {
namespace {

struct Described {
  Result<robot::RobotModel> model;
  Diagnostics findings;
};

Described describe(const std::string& body) {
  const std::string text =
      "#usda 1.0\n(defaultPrim = \"r\"\nmetersPerUnit = 0.01\nkilogramsPerUnit = 1\n"
      "upAxis = \"Z\")\ndef Xform \"r\" {\n" +
      body + "}\n";
  Diagnostics findings;
  auto layer = formats::read_text(text, "r.usda", findings);
  if (!layer) {
    return {layer.error(), {}};
  }
  auto root = std::make_shared<layer::Layer>(std::move(*layer));
  const auto stage = stage::Stage::open(
      root, nullptr, [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
        return Error(ErrorCode::NotFound, "none").in_file(asset);
      });
  const scene::PhysicsScene scene = physics::read_physics(*stage, {}, findings);
  Described result{robot::RobotModel{}, {}};
  result.model = describe_robot(*stage, scene, result.findings);
  return result;
}

std::string body(const std::string& name, const std::string& contents) {
  return "def Xform \"" + name +
         "\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {\n"
         "float physics:mass = 2\nfloat3 physics:diagonalInertia = (1, 1, 1)\n" +
         contents + "}\n";
}

TEST(DescribeRobot, NamesSensorsOfMujocoThatURDFHasNot) {
  const Described found = describe(
      body("a", "") +
      "def TenonMujocoSensor \"clock\" {\ncustom token tenon:mujoco:sensor = \"clock\"\n}\n");
  ASSERT_TRUE(found.model) << found.model.error().to_string();
  ASSERT_EQ(found.findings.items().size(), 1u);
  EXPECT_EQ(found.findings.items()[0].prim, "/r/clock");
}

TEST(DescribeRobot, AJointWrittenFromChildToParentTurnsTheOtherWay) {
  const Described found = describe(
      body("a", "") +
      body("b",
           "double3 xformOp:translate = (0, 0, 50)\n"
           "token[] xformOpOrder = [\"xformOp:translate\"]\n") +
      "def PhysicsFixedJoint \"base\" {\n rel physics:body1 = </r/a>\n}\n"
      "def PhysicsRevoluteJoint \"j\" {\n rel physics:body0 = </r/b>; rel physics:body1 = </r/a>\n"
      "token physics:axis = \"Y\"; float physics:lowerLimit = -90; float physics:upperLimit = 180\n"
      "point3f physics:localPos0 = (0, 0, -10); point3f physics:localPos1 = (0, 0, 40)\n}\n");
  ASSERT_TRUE(found.model) << found.model.error().to_string();
  const robot::RobotModel& model = *found.model;
  ASSERT_EQ(model.links.size(), 3u);
  EXPECT_EQ(model.links[0].name, "world");
  EXPECT_EQ(model.links[2].name, "b");
  ASSERT_EQ(model.joints.size(), 2u);
  const robot::Joint& joint = model.joints[1];
  EXPECT_EQ(joint.kind, robot::JointKind::Revolute);
  EXPECT_EQ(joint.axis, (Vec3d{{0, -1, 0}}));
  EXPECT_NEAR(joint.limit->lower, -1.5707963267948966, 1e-6);
  EXPECT_NEAR(joint.limit->upper, 3.1415926535897931, 1e-6);
  EXPECT_NEAR(joint.origin.position[2], 0.4, 1e-7);  // metres, to the anchor
  EXPECT_NEAR(model.links[2].inertial->center_of_mass[2], 0.1, 1e-7);
}

TEST(DescribeRobot, ListsWhatATreeCannotSay) {
  const Described found = describe(body("a", "") + body("b", "") + body("c", "") +
                                   "def PhysicsRevoluteJoint \"j\" {\n rel physics:body0 = </r/a>; "
                                   "rel physics:body1 = </r/b>\n}\n"
                                   "def PhysicsFixedJoint \"loop\" {\n rel physics:body0 = </r/b>; "
                                   "rel physics:body1 = </r/a>\n}\n");
  ASSERT_TRUE(found.model);
  EXPECT_EQ(found.model->joints.size(), 2u);  // c floats
  EXPECT_EQ(found.model->joints.back().kind, robot::JointKind::Floating);
  EXPECT_EQ(found.model->joints.front().kind, robot::JointKind::Continuous);
  ASSERT_EQ(found.findings.items().size(), 1u);
  EXPECT_EQ(found.findings.items()[0].rule, "urdf.left-out");
  EXPECT_EQ(found.findings.items()[0].prim, "/r/loop");
}

TEST(DescribeRobot, AxesOfAJointWithSeveralThatFollowAreNamed) {
  const Described found = describe(
      body("a", "") + body("b", "") + body("c", "") +
      "def PhysicsRevoluteJoint \"j\" {\n rel physics:body0 = </r/a>; "
      "rel physics:body1 = </r/b>\n}\n"
      "def PhysicsJoint \"k\" (prepend apiSchemas = [\"PhysxMimicJointAPI:rotX\", "
      "\"PhysxMimicJointAPI:rotY\"]) {\n rel physics:body0 = </r/b>; rel physics:body1 = </r/c>; "
      "rel physxMimicJoint:rotX:referenceJoint = </r/j>; "
      "rel physxMimicJoint:rotY:referenceJoint = </r/j>\n}\n");
  ASSERT_TRUE(found.model) << found.model.error().to_string();
  for (const robot::Joint& joint : found.model->joints) {
    EXPECT_FALSE(joint.mimic) << joint.name;
  }
  std::string told;
  for (const Diagnostic& finding : found.findings) {
    told += finding.prim == "/r/k" ? finding.message + "\n" : "";
  }
  EXPECT_NE(told.find("rotX follows rotX of </r/j>"), std::string::npos) << told;
  EXPECT_NE(told.find("rotY follows rotX of </r/j>"), std::string::npos) << told;
}

TEST(DescribeRobot, ShapesAreInMetresInTheLink) {
  const Described found = describe(
      body("a",
           "double3 xformOp:translate = (0, 0, 100)\n"
           "token[] xformOpOrder = [\"xformOp:translate\"]\n"
           "def Cylinder \"seen\" {\ndouble radius = 5; double height = 20; token axis = \"X\"\n"
           "double3 xformOp:translate = (3, 0, 0)\n"
           "token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"
           "def Cube \"felt\" (prepend apiSchemas = [\"PhysicsCollisionAPI\"]) {\n"
           "uniform token purpose = \"guide\"; double size = 10\n}\n"));
  ASSERT_TRUE(found.model);
  const robot::Link& link = found.model->links.at(0);
  ASSERT_EQ(link.visuals.size(), 1u);
  EXPECT_EQ(link.visuals[0].geometry.kind, robot::GeometryKind::Cylinder);
  EXPECT_NEAR(link.visuals[0].geometry.half_height, 0.1, 1e-12);
  EXPECT_NEAR(link.visuals[0].pose.position[0], 0.03, 1e-12);
  EXPECT_NEAR(rotate(link.visuals[0].pose.orientation, {{0, 0, 1}})[0], 1, 1e-12);
  ASSERT_EQ(link.colliders.size(), 1u);
  EXPECT_NEAR(link.colliders[0].geometry.half_extents[0], 0.05, 1e-9);
}

TEST(DescribeRobot, NoBodiesAreNoRobot) {
  const Described found = describe("");
  ASSERT_FALSE(found.model);
  EXPECT_EQ(found.model.error().diagnostic().rule, "urdf.no-robot");
}

}  // namespace
}  // namespace tenon::describe
