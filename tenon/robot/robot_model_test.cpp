// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/robot/robot_model.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tenon/math/inertia.h"
#include "tenon/robot/kinematic_tree.h"
#include "tenon/robot/merge_fixed.h"

namespace tenon::robot {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Link link_of_mass(std::string name, double mass) {
  Link link;
  link.name = std::move(name);
  link.inertial.emplace();
  link.inertial->mass = mass;
  link.inertial->inertia = Mat3d::identity();
  return link;
}

Joint joint_of(std::string name, JointKind kind, Index parent, Index child) {
  Joint joint;
  joint.name = std::move(name);
  joint.kind = kind;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

/// a -fixed- b -revolute- c, and a -revolute- d.
RobotModel four_links() {
  RobotModel model;
  for (const char* name : {"a", "b", "c", "d"}) {
    model.links.push_back(link_of_mass(name, 1));
  }
  model.joints = {joint_of("ab", JointKind::Fixed, 0, 1), joint_of("bc", JointKind::Revolute, 1, 2),
                  joint_of("ad", JointKind::Revolute, 0, 3)};
  return model;
}

std::string rule_of(const RobotModel& model) {
  const auto tree = kinematic_tree(model);
  return tree ? "" : tree.error().diagnostic().rule;
}

std::string mended(RobotModel& model) {
  Diagnostics findings;
  sanitize_model(model, findings);
  std::string rules;
  for (const Diagnostic& finding : findings) {
    rules += finding.rule + ";";
  }
  return rules;
}

TEST(JointQuantity, TellsDegreesFromRadians) {
  const auto angle = JointPosition::from_si(std::numbers::pi, Motion::Angular);
  EXPECT_DOUBLE_EQ(angle.in_layer(), 180);
  const auto gain = JointStiffness::from_si(180, Motion::Angular);
  EXPECT_DOUBLE_EQ(gain.in_layer(), std::numbers::pi);  // N m/rad are fewer N m/deg
  EXPECT_DOUBLE_EQ(JointStiffness::from_layer(gain.in_layer(), Motion::Angular).si(), 180);
  EXPECT_EQ(JointEffort::from_si(3, Motion::Angular).in_layer(), 3);
  EXPECT_EQ(JointPosition::from_si(3, Motion::Linear).in_layer(), 3);
}

TEST(KinematicTree, OrdersLinksDepthFirst) {
  const auto tree = kinematic_tree(four_links());
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->root, 0u);
  EXPECT_EQ(tree->order, (std::vector<Index>{0, 1, 2, 3}));
}

TEST(KinematicTree, RefusesWhatIsNoTree) {
  EXPECT_EQ(rule_of({}), "robot.no-links");
  RobotModel model = four_links();
  model.links[3].name = "a";
  EXPECT_EQ(rule_of(model), "robot.duplicate-name");
  model = four_links();
  model.joints[2].name = "ab";
  EXPECT_EQ(rule_of(model), "robot.duplicate-name");
  model = four_links();
  model.joints[2].child = 2;
  EXPECT_EQ(rule_of(model), "robot.two-parents");
  model = four_links();
  model.joints.pop_back();
  EXPECT_EQ(rule_of(model), "robot.two-roots");
  model = four_links();
  model.joints.push_back(joint_of("ca", JointKind::Fixed, 2, 0));
  EXPECT_EQ(rule_of(model), "robot.cycle");
  model = four_links();
  model.joints[0].parent = 2;  // b and c hold each other, a stands alone
  EXPECT_EQ(rule_of(model), "robot.cycle");
}

TEST(KinematicTree, WalksChainsOfAnyLength) {
  RobotModel model;
  constexpr Index kCount = 200'000;
  for (Index i = 0; i < kCount; ++i) {
    model.links.push_back(link_of_mass("l" + std::to_string(i), 1));
    if (i > 0) {
      model.joints.push_back(joint_of("j" + std::to_string(i), JointKind::Continuous, i - 1, i));
      model.joints.back().mimic = Mimic{i < 2 ? i - 1 : i - 2, 1, 0, {}, {}};
    }
  }
  const auto tree = kinematic_tree(model);
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->order.size(), kCount);
  EXPECT_EQ(mended(model), "robot.mimic;");  // the first joint named itself
}

TEST(MendModel, LeavesASoundModelAlone) {
  RobotModel model = four_links();
  model.joints[1].limit = Limit{-1, 2};
  model.joints[2].mimic = Mimic{1, -1.5, 0.25, {}, {}};
  EXPECT_EQ(mended(model), "");
  EXPECT_TRUE(model.joints[2].mimic);
}

TEST(MendModel, NamesWhatNoBodyHas) {
  RobotModel model = four_links();
  model.links[0].inertial->mass = kNan;
  model.links[1].inertial->mass = -1;
  model.links[2].inertial->inertia[2][2] = 3;
  EXPECT_EQ(mended(model), "robot.not-finite;robot.negative-mass;robot.inertia-triangle;");
  EXPECT_FALSE(model.links[0].inertial);
  EXPECT_FALSE(model.links[1].inertial);
  EXPECT_EQ(model.links[2].inertial->inertia[2][2], 3);
}

TEST(MendModel, GivesEveryAxisAnInertia) {
  RobotModel model = four_links();
  model.links[0].inertial->inertia = {{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}};  // 3, 0, 0
  model.links[1].inertial->inertia = diagonal_matrix({{-1, 0, 0}});
  model.links[2].inertial->inertia = {};
  EXPECT_EQ(mended(model), "robot.inertia-not-positive;robot.inertia-not-positive;");
  EXPECT_NEAR(model.links[0].inertial->inertia[1][1], 1, 1e-15);
  EXPECT_EQ(model.links[0].inertial->inertia[0][1], 0);
  EXPECT_EQ(model.links[1].inertial->inertia, Mat3d{});
}

TEST(MendModel, LiftsOnlyTheMomentThatIsZero) {
  RobotModel model = four_links();
  model.links[0].inertial->inertia = diagonal_matrix({{0.004, 0.004, 0}});
  model.links[1].inertial->inertia = diagonal_matrix({{0.004, 0, 0.003}});
  EXPECT_EQ(mended(model), "robot.inertia-not-positive;robot.inertia-not-positive;");
  EXPECT_EQ(model.links[0].inertial->inertia, diagonal_matrix({{0.004, 0.004, 1e-3 * 0.004}}));
  EXPECT_NEAR(model.links[1].inertial->inertia[1][1], 0.001, 1e-15);
  EXPECT_EQ(model.links[1].inertial->inertia[2][2], 0.003);
}

TEST(MendModel, NamesLimitsThatLookLikeDegrees) {
  RobotModel model = four_links();
  model.joints[1].limit = Limit{-90, 90};
  EXPECT_EQ(mended(model), "robot.limits-in-degrees;");
  EXPECT_EQ(model.joints[1].limit->upper, 90);
  for (const double turn : {6.28, 9.42, 10.0, 31.4, 1000.0}) {
    model.joints[1].limit = Limit{-turn, turn};
    EXPECT_EQ(mended(model), "") << turn;
  }
}

TEST(MendModel, AVisualThatNobodySeesIsNoFault) {
  RobotModel model = four_links();
  Geometry marker;
  model.links[0].visuals.push_back({"", {}, marker, {}, {}});
  Diagnostics diagnostics;
  sanitize_model(model, diagnostics);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics.begin()->severity, Severity::Info);
  EXPECT_TRUE(model.links[0].visuals.empty());
}

TEST(MendModel, MendsJoints) {
  RobotModel model = four_links();
  model.joints[0].origin.position[1] = kUnlimited;
  model.joints[1].axis = {};
  model.joints[1].limit = Limit{2, 1};
  model.joints[1].damping = -1;
  model.joints[2].limit = Limit{kNan, 1};
  EXPECT_EQ(mended(model),
            "robot.not-finite;robot.zero-axis;robot.bad-number;robot.limit-order;"
            "robot.not-finite;");
  EXPECT_EQ(model.joints[1].limit->lower, 1);
  EXPECT_EQ(model.joints[1].damping, 0);
  EXPECT_FALSE(model.joints[2].limit);
}

TEST(MendModel, LeavesOutMimicsThatCannotBe) {
  RobotModel model = four_links();
  model.joints[1].mimic = Mimic{2, 1, 0, {}, {}};
  model.joints[2].mimic = Mimic{1, 1, 0, {}, {}};
  EXPECT_EQ(mended(model), "robot.mimic;");
  EXPECT_NE(model.joints[1].mimic.has_value(), model.joints[2].mimic.has_value());
  model.joints[1].mimic = Mimic{0, 1, 0, {}, {}};  // a fixed joint
  EXPECT_EQ(mended(model), "robot.mimic;");
}

TEST(MendModel, LeavesOutShapesOfNoSize) {
  RobotModel model = four_links();
  Visual visual;
  visual.geometry.kind = GeometryKind::Sphere;
  model.links[0].visuals.push_back(visual);
  visual.geometry.radius = 1;
  visual.pose.position[0] = kNan;
  model.links[0].visuals.push_back(visual);
  EXPECT_EQ(mended(model), "robot.bad-size;robot.not-finite;");
  EXPECT_TRUE(model.links[0].visuals.empty());
}

TEST(MergeFixed, SumsMassesAndMovesJoints) {
  RobotModel model = four_links();
  model.joints[0].origin.position = {{2, 0, 0}};
  model.joints[1].origin.position = {{0, 1, 0}};
  model.joints[1].mimic = Mimic{2, 2, 0, {}, {}};
  const auto tree = kinematic_tree(model);
  ASSERT_TRUE(tree);
  const RobotModel merged = merge_fixed(model, *tree);
  ASSERT_EQ(merged.links.size(), 3u);
  ASSERT_EQ(merged.joints.size(), 2u);
  const Inertial& whole = *merged.links[0].inertial;
  EXPECT_EQ(whole.mass, 2);
  EXPECT_EQ(whole.center_of_mass, (Vec3d{{1, 0, 0}}));
  // Two unit inertias, each 1 kg at 1 m from the common centre along x.
  EXPECT_DOUBLE_EQ(whole.inertia[0][0], 2);
  EXPECT_DOUBLE_EQ(whole.inertia[1][1], 4);
  EXPECT_DOUBLE_EQ(whole.inertia[2][2], 4);
  EXPECT_EQ(merged.joints[0].origin.position, (Vec3d{{2, 1, 0}}));
  EXPECT_EQ(merged.joints[0].parent, 0u);
  EXPECT_EQ(merged.joints[0].mimic->leader, 1u);
}

}  // namespace
}  // namespace tenon::robot
