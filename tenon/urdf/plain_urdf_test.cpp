// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/plain_urdf.h"

#include <gtest/gtest.h>

#include "tenon/robot/kinematic_tree.h"
#include "tenon/urdf/write_urdf.h"

namespace tenon::urdf {
namespace {

using robot::GeometryKind;
using robot::JointKind;

/// A cart and an arm on it.
robot::RobotModel robot_with(JointKind kind) {
  robot::RobotModel model;
  model.links.resize(2);
  model.links[0].name = "cart";
  model.links[1].name = "arm";
  robot::Inertial& inertial = model.links[1].inertial.emplace();
  inertial.mass = 2;
  robot::Joint joint;
  joint.name = "joint";
  joint.kind = kind;
  joint.child = 1;
  joint.origin.position = {{0, 0, 0.5}};
  model.joints.push_back(joint);
  return model;
}

TEST(PlainUrdf, CapsulesAreCylindersBetweenSpheres) {
  robot::RobotModel model = robot_with(JointKind::Fixed);
  robot::Collider capsule;
  capsule.name = "c";
  capsule.geometry.kind = GeometryKind::Capsule;
  capsule.geometry.radius = 0.1;
  capsule.geometry.half_height = 0.25;
  capsule.pose.position = {{1, 0, 0}};
  model.links[1].colliders.push_back(capsule);
  capsule.geometry.half_height = 0;
  model.links[0].colliders.push_back(capsule);
  Diagnostics findings;
  make_plain(model, findings);
  const auto& parts = model.links[1].colliders;
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].geometry.kind, GeometryKind::Cylinder);
  EXPECT_EQ(parts[1].geometry.kind, GeometryKind::Sphere);
  EXPECT_EQ(parts[1].pose.position, (Vec3d{{1, 0, 0.25}}));
  EXPECT_EQ(parts[2].pose.position, (Vec3d{{1, 0, -0.25}}));
  EXPECT_EQ(parts[2].name, "c_bottom");
  ASSERT_EQ(model.links[0].colliders.size(), 1u);
  EXPECT_EQ(model.links[0].colliders[0].name, "c");
  EXPECT_EQ(findings.size(), 1u);
}

TEST(PlainUrdf, BallsAreThreeHinges) {
  robot::RobotModel model = robot_with(JointKind::Ball);
  Diagnostics findings;
  make_plain(model, findings);
  ASSERT_EQ(model.joints.size(), 3u);
  ASSERT_EQ(model.links.size(), 4u);
  EXPECT_TRUE(robot::kinematic_tree(model));
  EXPECT_EQ(model.joints[0].name, "joint_x");
  EXPECT_EQ(model.joints[0].origin.position, (Vec3d{{0, 0, 0.5}}));
  EXPECT_EQ(model.joints[2].child, 1u);
  EXPECT_EQ(model.joints[2].axis, (Vec3d{{0, 0, 1}}));
  EXPECT_NEAR(model.links[2].inertial->mass, 2e-6, 1e-18);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ((*findings.begin()).severity, Severity::Warning);
  EXPECT_EQ(write_urdf(model).find("spherical"), std::string::npos);
}

TEST(PlainUrdf, SlidesWithoutAnEndAreNotLocked) {
  robot::RobotModel model = robot_with(JointKind::Prismatic);
  Diagnostics findings;
  make_plain(model, findings);
  EXPECT_EQ(model.joints[0].limit->lower, -1e9);
  EXPECT_EQ(model.joints[0].limit->upper, 1e9);
  EXPECT_EQ(findings.size(), 3u);  // range, effort, speed
}

TEST(PlainUrdf, NamesTheJointsThatHaveNoLimitOfEffortOrSpeed) {
  robot::RobotModel model = robot_with(JointKind::Continuous);
  model.joints.push_back(model.joints[0]);
  model.joints[0].velocity_limit = 3;
  model.joints[1].name = "other";
  Diagnostics findings;
  make_plain(model, findings);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_NE(findings.items()[0].message.find("joints \"joint\", \"other\" have no limit of effort"),
            std::string::npos);
  EXPECT_NE(findings.items()[1].message.find("joint \"other\" has no limit of speed"),
            std::string::npos);
  EXPECT_EQ(model.joints[0].velocity_limit, 3);
  EXPECT_EQ(model.joints[1].velocity_limit, kNoUrdfLimit);
}

TEST(PlainUrdf, NumbersComeBackAsTheyWere) {
  robot::RobotModel model = robot_with(JointKind::Continuous);
  model.joints[0].origin.position = {{static_cast<double>(0.1f), 1e-17, 0.24999999999999997}};
  model.links[1].inertial->mass = static_cast<double>(0.64f);
  const std::string text = write_urdf(model);
  EXPECT_NE(text.find("xyz=\"0.1 0 0.25\""), std::string::npos) << text;
  EXPECT_NE(text.find("mass value=\"0.64\""), std::string::npos) << text;
}

}  // namespace
}  // namespace tenon::urdf
