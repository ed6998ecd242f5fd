// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include "tenon/math/angle.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

/// A scene in metres of three bodies: /J turns the second against the first about Z, /W is between
/// the second and the third with `apis` and `properties`.
PhysicsScene two_joints(const std::string& type, const std::string& apis,
                        const std::string& properties, Diagnostics& diagnostics) {
  std::string text = "(\n    metersPerUnit = 1\n)\n";
  for (const char* body : {"a", "b", "c"}) {
    text += std::string("def Xform \"") + body +
            "\" (\n    prepend apiSchemas = [\"PhysicsRigidBodyAPI\"]\n) {\n}\n";
  }
  text += R"(def PhysicsRevoluteJoint "J" {
    rel physics:body0 = </a>
    rel physics:body1 = </b>
    uniform token physics:axis = "Z"
}
def )" + type +
          " \"W\" (\n    prepend apiSchemas = [" + apis + "]\n) {\n    rel physics:body0 = </b>\n" +
          "    rel physics:body1 = </c>\n" + properties + "}\n";
  const stage::Stage stage = stage::open_text({{"root", text}});
  return read_physics(stage, {}, diagnostics);
}

/// PhysX's law for one rotation.
std::string law(const std::string& rotation, const std::string& leader, const std::string& gearing,
                const std::string& leader_rotation = "") {
  const std::string prefix = "physxMimicJoint:" + rotation + ":";
  return "    rel " + prefix + "referenceJoint = " + leader + "\n    float " + prefix +
         "gearing = " + gearing + "\n    float " + prefix + "offset = 10\n" +
         (leader_rotation.empty() ? ""
                                  : "    uniform token " + prefix + "referenceJointAxis = \"" +
                                        leader_rotation + "\"\n");
}

bool has_rule(const Diagnostics& diagnostics, const std::string& rule) {
  for (const Diagnostic& found : diagnostics) {
    if (found.rule == rule) {
      return true;
    }
  }
  return false;
}

TEST(MimicReading, EachRotationOfAD6JointFollowsByItsOwnLaw) {
  Diagnostics diagnostics;
  const PhysicsScene scene =
      two_joints("PhysicsJoint", R"("PhysxMimicJointAPI:rotZ", "PhysxMimicJointAPI:rotY")",
                 law("rotZ", "</J>", "2", "rotY") + law("rotY", "</J>", "-0.5"), diagnostics);
  ASSERT_EQ(scene.joints.size(), 2u);
  EXPECT_TRUE(scene.joints[0].mimics.empty());
  const std::vector<Mimic>& mimics = scene.joints[1].mimics;
  ASSERT_EQ(mimics.size(), 2u);
  EXPECT_EQ(mimics[0].dof, Dof::RotY);
  EXPECT_EQ(mimics[0].multiplier, 0.5);
  EXPECT_EQ(mimics[1].dof, Dof::RotZ);
  EXPECT_EQ(mimics[1].multiplier, -2);
  for (const Mimic& mimic : mimics) {
    EXPECT_EQ(mimic.leader, 0u);
    EXPECT_EQ(mimic.leader_dof, Dof::RotZ);  // its only one, whatever the reference axis
    EXPECT_NEAR(mimic.offset, -10 / kDegreesPerRadian, 1e-12);
  }
}

TEST(MimicReading, ARotationOfAD6JointLeads) {
  Diagnostics diagnostics;
  const PhysicsScene scene =
      two_joints("PhysicsJoint", R"("PhysxMimicJointAPI:rotX", "PhysxMimicJointAPI:rotY")",
                 law("rotX", "</W>", "1", "rotY") + law("rotY", "</W>", "1", "rotZ"), diagnostics);
  ASSERT_EQ(scene.joints[1].mimics.size(), 2u);
  EXPECT_EQ(scene.joints[1].mimics[0].leader, 1u);
  EXPECT_EQ(scene.joints[1].mimics[0].leader_dof, Dof::RotY);
  EXPECT_EQ(scene.joints[1].mimics[1].leader_dof, Dof::RotZ);
}

TEST(MimicReading, ALockedRotationNeitherFollowsNorLeads) {
  Diagnostics diagnostics;
  const std::string lock =
      "    float limit:rotX:physics:low = 1\n"
      "    float limit:rotX:physics:high = -1\n";
  const std::string apis =
      R"("PhysicsLimitAPI:rotX", "PhysxMimicJointAPI:rotX", "PhysxMimicJointAPI:rotY")";
  const PhysicsScene scene =
      two_joints("PhysicsJoint", apis, lock + law("rotX", "</J>", "1") + law("rotY", "</W>", "1"),
                 diagnostics);
  EXPECT_TRUE(scene.joints[1].mimics.empty());
  EXPECT_TRUE(has_rule(diagnostics, "mimic.leader-missing"));
  ASSERT_FALSE(scene.not_read.empty());
  EXPECT_EQ(scene.not_read[0].property, "PhysxMimicJointAPI:rotX");
}

TEST(MimicReading, RotationsThatFollowEachOtherLoseOneOfThem) {
  Diagnostics diagnostics;
  const PhysicsScene scene =
      two_joints("PhysicsJoint", R"("PhysxMimicJointAPI:rotX", "PhysxMimicJointAPI:rotY")",
                 law("rotX", "</W>", "1", "rotY") + law("rotY", "</W>", "1", "rotX"), diagnostics);
  EXPECT_TRUE(has_rule(diagnostics, "mimic.cycle"));
  ASSERT_EQ(scene.joints[1].mimics.size(), 1u);
  EXPECT_EQ(scene.joints[1].mimics[0].dof, Dof::RotY);
}

TEST(MimicReading, AMimicOfItselfIsACycle) {
  for (const std::string api : {"NewtonMimicAPI", "PhysxMimicJointAPI:rotX"}) {
    Diagnostics diagnostics;
    const PhysicsScene scene = two_joints(
        "PhysicsRevoluteJoint", "\"" + api + "\"",
        api == "NewtonMimicAPI" ? "    rel newton:mimicJoint = </W>\n" : law("rotX", "</W>", "1"),
        diagnostics);
    EXPECT_TRUE(has_rule(diagnostics, "mimic.cycle")) << api;
    EXPECT_FALSE(has_rule(diagnostics, "mimic.leader-missing")) << api;
    EXPECT_TRUE(scene.joints[1].mimics.empty());
  }
}

TEST(MimicReading, AJointOfOneAxisFollowsOnce) {
  Diagnostics diagnostics;
  const PhysicsScene scene =
      two_joints("PhysicsRevoluteJoint", R"("PhysxMimicJointAPI:rotY", "PhysxMimicJointAPI:rotX")",
                 law("rotY", "</J>", "3") + law("rotX", "</J>", "1"), diagnostics);
  ASSERT_EQ(scene.joints[1].mimics.size(), 1u);
  EXPECT_EQ(scene.joints[1].mimics[0].dof, Dof::RotX);  // of physics:axis, not of the instance
  EXPECT_EQ(scene.joints[1].mimics[0].multiplier, -3);
  ASSERT_FALSE(scene.not_read.empty());
  EXPECT_EQ(scene.not_read[0].property, "PhysxMimicJointAPI:rotX");
}

TEST(MimicReading, NewtonsLawIsOfOneAxis) {
  Diagnostics diagnostics;
  const PhysicsScene scene = two_joints("PhysicsJoint", R"("NewtonMimicAPI")",
                                        "    rel newton:mimicJoint = </J>\n", diagnostics);
  EXPECT_TRUE(scene.joints[1].mimics.empty());
  ASSERT_FALSE(scene.not_read.empty());
  EXPECT_EQ(scene.not_read[0].property, "NewtonMimicAPI");
}

}  // namespace
}  // namespace tenon::physics
