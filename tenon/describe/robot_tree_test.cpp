// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/robot_tree.h"

#include <gtest/gtest.h>

namespace tenon::describe {
namespace {

Path at(const char* text) { return *Path::parse(text); }

TEST(RobotTree, NamesAreGivenOnce) {
  RobotTree tree;
  tree.add_link({}, "arm", {}, {});
  tree.add_link({}, "arm", {}, {});
  tree.add_joint(0, 1, robot::JointKind::Fixed);
  robot::Joint joint;
  joint.name = "arm_1_joint";
  tree.add_joint(joint);
  EXPECT_EQ(tree.links()[1].name, "arm_1");
  EXPECT_EQ(tree.joints()[0].name, "arm_1_joint");
  EXPECT_EQ(tree.joints()[1].name, "arm_1_joint_1");
}

TEST(RobotTree, FindsTheLinkOfTheNearestPrimAbove) {
  RobotTree tree;
  const robot::Index arm = tree.add_link(at("/r/arm"), "arm", {}, {});
  const robot::Index hand = tree.add_link(at("/r/arm/hand"), "hand", {}, {});
  EXPECT_EQ(tree.link_above(at("/r/arm/shape")), arm);
  EXPECT_EQ(tree.link_above(at("/r/arm/hand/shape")), hand);
  EXPECT_EQ(tree.link_above(at("/r/hand")), std::nullopt);
  EXPECT_EQ(tree.link_at(at("/r/arm/shape")), std::nullopt);
}

TEST(RobotTree, AJointWithoutNumbersKeepsLinksWhereTheyStand) {
  RobotTree tree;
  Pose parent;
  parent.position = {{1, 0, 0}};
  parent.orientation = {0, 0, 1, 0};  // half a turn about z
  Pose child;
  child.position = {{3, 0, 0}};
  tree.add_link({}, "a", parent, {});
  tree.add_link({}, "b", child, {});
  tree.add_joint(0, 1, robot::JointKind::Fixed);
  const Pose& origin = tree.joints()[0].origin;
  EXPECT_NEAR(origin.position[0], -2, 1e-15);
  EXPECT_NEAR(origin.orientation.z, -1, 1e-15);
}

}  // namespace
}  // namespace tenon::describe
