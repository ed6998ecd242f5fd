// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/sdf/write_sdf.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/sdf/plain_sdf.h"
#include "tenon/sdf/read_sdf.h"

namespace tenon::sdf {
namespace {

using robot::JointKind;

robot::Link weighted(const std::string& name) {
  robot::Link link;
  link.name = name;
  link.inertial.emplace();
  link.inertial->mass = 2;
  for (std::size_t k = 0; k < 3; ++k) {
    link.inertial->inertia[k][k] = 0.5;
  }
  return link;
}

robot::Joint joint_to(robot::Index parent, robot::Index child, JointKind kind) {
  robot::Joint joint;
  joint.name = "joint_" + std::to_string(child);
  joint.kind = kind;
  joint.parent = parent;
  joint.child = child;
  joint.origin.position = {{0.25, 0, 1}};
  joint.axis = {{0, 0, 1}};
  return joint;
}

/// A base, and links on it by joints of these kinds.
robot::RobotModel robot_of(const std::vector<JointKind>& kinds) {
  robot::RobotModel model;
  model.name = "robot";
  model.links.push_back(weighted("base"));
  for (const JointKind kind : kinds) {
    const auto child = static_cast<robot::Index>(model.links.size());
    model.links.push_back(weighted("link_" + std::to_string(child)));
    model.joints.push_back(joint_to(0, child, kind));
  }
  return model;
}

robot::RobotModel there_and_back(robot::RobotModel model, Diagnostics& diagnostics) {
  make_plain(model, diagnostics);
  Diagnostics of_reading;
  auto read = read_sdf_text(write_sdf(model), "/robot.sdf", {}, of_reading);
  EXPECT_TRUE(read) << (read ? "" : read.error().message());
  return read ? *std::move(read) : robot::RobotModel();
}

TEST(WriteSdf, JointsComeBackWithTheirNumbers) {
  robot::RobotModel model = robot_of({JointKind::Revolute, JointKind::Prismatic,
                                      JointKind::Continuous, JointKind::Ball, JointKind::Fixed});
  model.joints[0].limit = robot::Limit{-0.5, 1.25};
  model.joints[0].effort_limit = 3;
  model.joints[0].velocity_limit = 4;
  model.joints[0].damping = 0.125;
  model.joints[0].friction = 0.25;
  model.joints[0].armature = 0.01;
  model.joints[0].stiffness = 5;
  model.joints[0].spring_reference = 0.5;
  model.joints[1].mimic = robot::Mimic{0, 2, 0.75, {}, {}};
  Diagnostics diagnostics;
  const robot::RobotModel back = there_and_back(model, diagnostics);
  ASSERT_EQ(back.joints.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(back.joints[i].kind, model.joints[i].kind) << i;
    EXPECT_EQ(back.joints[i].origin.position, model.joints[i].origin.position) << i;
  }
  const robot::Joint& first = back.joints[0];
  ASSERT_TRUE(first.limit);
  EXPECT_EQ(first.limit->lower, -0.5);
  EXPECT_EQ(first.limit->upper, 1.25);
  EXPECT_EQ(first.effort_limit, 3);
  EXPECT_EQ(first.velocity_limit, 4);
  EXPECT_EQ(first.damping, 0.125);
  EXPECT_EQ(first.friction, 0.25);
  EXPECT_EQ(first.armature, 0.01);
  EXPECT_EQ(first.stiffness, 5);
  EXPECT_EQ(first.spring_reference, 0.5);
  EXPECT_FALSE(back.joints[1].limit);
  ASSERT_TRUE(back.joints[1].mimic);
  EXPECT_EQ(back.joints[1].mimic->leader, 0u);
  EXPECT_EQ(back.joints[1].mimic->multiplier, 2);
  EXPECT_EQ(back.joints[1].mimic->offset, 0.75);
  EXPECT_TRUE(diagnostics.empty());
}

TEST(WriteSdf, LinkWithoutInertiaOnAFixedJointIsAFrame) {
  robot::RobotModel model = robot_of({JointKind::Fixed});
  model.links[1].inertial.reset();
  Diagnostics diagnostics;
  const robot::RobotModel back = there_and_back(model, diagnostics);
  ASSERT_EQ(back.links.size(), 1u);
  ASSERT_EQ(back.links[0].sites.size(), 1u);
  EXPECT_EQ(back.links[0].sites[0].name, "link_1");
  EXPECT_EQ(back.links[0].sites[0].pose.position, (Vec3d{{0.25, 0, 1}}));
}

TEST(WriteSdf, RootWithoutInertiaIsTheWorld) {
  robot::RobotModel model = robot_of({JointKind::Revolute});
  model.links[0].inertial.reset();
  Diagnostics diagnostics;
  make_plain(model, diagnostics);
  const std::string text = write_sdf(model);
  EXPECT_NE(text.find("<parent>world</parent>"), std::string::npos) << text;
  EXPECT_EQ(text.find("<link name=\"base\">"), std::string::npos) << text;
}

TEST(WriteSdf, NamesOfLinksAndJointsBecomeDifferent) {
  robot::RobotModel model = robot_of({JointKind::Revolute, JointKind::Revolute});
  model.joints[0].name = "link_1";
  model.links[2].name = "arm::hand";
  Diagnostics diagnostics;
  const robot::RobotModel back = there_and_back(model, diagnostics);
  ASSERT_EQ(back.joints.size(), 2u);
  EXPECT_EQ(back.joints[0].name, "link_1_joint");
  EXPECT_EQ(back.links[2].name, "arm__hand");
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(diagnostics.begin()->rule, "sdf.replaced");
}

TEST(WriteSdf, PlanarJointIsTwoSlidesAndAHinge) {
  Diagnostics diagnostics;
  const robot::RobotModel back = there_and_back(robot_of({JointKind::Planar}), diagnostics);
  ASSERT_EQ(back.joints.size(), 3u);
  EXPECT_EQ(back.joints[0].kind, JointKind::Prismatic);
  EXPECT_EQ(back.joints[1].kind, JointKind::Prismatic);
  EXPECT_EQ(back.joints[2].kind, JointKind::Continuous);
  EXPECT_EQ(back.joints[2].axis, (Vec3d{{0, 0, 1}}));
  EXPECT_EQ(diagnostics.size(), 1u);
}

TEST(WriteSdf, TurnStraightUpIsAQuaternion) {
  robot::RobotModel model = robot_of({JointKind::Fixed});
  const double half = std::sqrt(0.5);
  model.joints[0].origin.orientation = {0, half, 0, half};
  Diagnostics diagnostics;
  const robot::RobotModel back = there_and_back(model, diagnostics);
  ASSERT_EQ(back.joints.size(), 1u);
  EXPECT_NEAR(back.joints[0].origin.orientation.y, half, 1e-15);
  EXPECT_NEAR(back.joints[0].origin.orientation.w, half, 1e-15);
}

}  // namespace
}  // namespace tenon::sdf
