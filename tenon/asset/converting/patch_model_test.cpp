// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/converting/patch_model.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

constexpr const char* kModel = R"(<mujoco>
  <compiler angle="radian"/>
  <default>
    <default class="soft">
      <joint damping="0.5"/><general biastype="affine" gainprm="4" biasprm="0 -4 -1"/>
    </default>
  </default>
  <worldbody>
    <camera name="eye &amp; ear" pos="1 2 3"/>
    <body name="arm" childclass="soft">
      <joint name="j" range="-1 1"/><joint name="k" ref="1"/>
    </body>
  </worldbody>
  <actuator><general name="a" joint="j" class="soft"/></actuator>
</mujoco>
)";

scene::PhysicsScene scene_with_joint() {
  scene::PhysicsScene scene;
  for (const char* path : {"/r/j", "/r/k"}) {
    scene::Joint joint;
    joint.path = Path::from(path);
    joint.kind = scene::JointKind::Revolute;
    joint.lower = -0.5;
    joint.upper = 0.75;
    joint.damping = 3;
    scene.joints.push_back(joint);
  }
  scene::Drive drive;
  drive.source = scene.joints[0].path;
  drive.stiffness = 9;
  drive.damping = 2;
  scene.joints[0].drives.push_back(drive);
  return scene;
}

PatchedModel patched(const char* prim, const char* property,
                     const scene::PhysicsScene& scene = scene_with_joint()) {
  auto model = patch_model(kModel, {{Path::from(prim), property}}, scene, {}, {},
                           [](Path path) { return path.name().str(); });
  EXPECT_TRUE(model);
  return model ? *std::move(model) : PatchedModel();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(PatchModel, ChangesOneAttributeAndNothingElse) {
  const PatchedModel model = patched("/r/j", "physics:upperLimit");
  EXPECT_TRUE(model.left.empty());
  EXPECT_EQ(model.text, replaced(kModel, "range=\"-1 1\"", "range=\"-0.5 0.75\" limited=\"true\""));
}

TEST(PatchModel, AnElementSaysWhatItsClassSaidOtherwise) {
  EXPECT_EQ(patched("/r/j", "newton:damping").text,
            replaced(kModel, "range=\"-1 1\"", "range=\"-1 1\" damping=\"3\""));
}

TEST(PatchModel, AGainThatFollowsTheStiffnessGoesAlong) {
  EXPECT_EQ(patched("/r/j", "drive:angular:physics:stiffness").text,
            replaced(kModel, "joint=\"j\" class=\"soft\"",
                     "joint=\"j\" class=\"soft\" gainprm=\"9\" biasprm=\"0 -9 -2\""));
}

TEST(PatchModel, WhatTheModelHasNoPlaceForIsLeftWithTheReason) {
  for (const auto& [prim, property] :
       {std::pair("/r/k", "physics:upperLimit"),  // counts from a reference
        std::pair("/r/other", "newton:damping"), std::pair("/r/arm", "physics:mass"),
        std::pair("/r/k", "drive:angular:physics:stiffness"), std::pair("/r/j", "color")}) {
    const PatchedModel model = patched(prim, property);
    ASSERT_EQ(model.left.size(), 1u) << prim << property;
    EXPECT_FALSE(model.left[0].why.empty());
  }
  scene::PhysicsScene endless = scene_with_joint();
  endless.joints[0].upper = scene::kUnlimited;
  EXPECT_EQ(patched("/r/j", "physics:upperLimit", endless).left.size(), 1u);
}

TEST(PatchModel, ATextThatIsNoXmlIsAnError) {
  EXPECT_FALSE(patch_model("<mujoco>", {}, {}, {}, {}, [](Path) { return std::string(); }));
}

}  // namespace
}  // namespace tenon
