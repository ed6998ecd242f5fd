// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::JointKind;

// A four-bar parallelogram in the xz plane: crank 1 m up from the origin, coupler 2 m along x,
// rocker 1 m up from (2, 0, 0). The last joint closes the loop.
TestScene four_bar(JointKind closing) {
  TestScene scene;
  const Vec3d thin{{0.05, 0.05, 0.05}};
  const auto crank = scene.add_body("Crank", {{0, 0, 0.5}}, 1, thin);
  const auto coupler = scene.add_body("Coupler", {{1, 0, 1}}, 1, thin);
  const auto rocker = scene.add_body("Rocker", {{2, 0, 0.5}}, 1, thin);
  scene.add_joint("A", JointKind::Revolute, {}, crank, Axis::Y).frame1.position = {{0, 0, -0.5}};
  auto& b = scene.add_joint("B", JointKind::Revolute, crank, coupler, Axis::Y);
  b.frame0.position = {{0, 0, 0.5}};
  b.frame1.position = {{-1, 0, 0}};
  auto& c = scene.add_joint("C", JointKind::Revolute, {}, rocker, Axis::Y);
  c.frame0.position = {{2, 0, 0}};
  c.frame1.position = {{0, 0, -0.5}};
  auto& d = scene.add_joint("D", closing, coupler, rocker, Axis::Y);
  d.frame0.position = {{1, 0, 0}};
  d.frame1.position = {{0, 0, 0.5}};
  d.exclude_from_articulation = true;
  scene.joints[0].initial_velocity = 0.5;
  scene.joints[1].initial_velocity = -0.5;
  scene.joints[2].initial_velocity = 0.5;
  return scene;
}

double gap(const MujocoSimulation& sim) {
  const Vec3d a = transform_point(sim.body_state(1).pose, {{1, 0, 0}});
  const Vec3d b = transform_point(sim.body_state(2).pose, {{0, 0, 0.5}});
  return length(a - b);
}

TEST(Loops, FourBarStaysClosedAndMovesAsAParallelogram) {
  for (const JointKind closing : {JointKind::Revolute, JointKind::Spherical}) {
    TestScene scene = four_bar(closing);
    auto sim = simulation(scene);
    double worst = 0;
    for (int i = 0; i < 1500; ++i) {
      ASSERT_TRUE(sim->step().has_value());
      worst = std::max(worst, gap(*sim));
      // Opposite sides are equal: crank and rocker turn alike, the coupler stays level.
      ASSERT_NEAR(sim->joint_state(0).position[0], sim->joint_state(2).position[0], 5e-3);
    }
    EXPECT_LT(worst, 1e-3);  // E-129
  }
}

// A drive that is strong for the time step, on a joint that may turn by 1 rad/s.
TEST(Loops, AFourBarMovesNoFasterThanTheVelocityLimitOfItsCrank) {
  TestScene scene = four_bar(JointKind::Revolute);
  for (scene::Joint& joint : scene.joints) {
    joint.initial_velocity = 0;
  }
  scene.joints[0].velocity_limit = 1;
  scene::Drive& drive = scene.joints[0].drives.emplace_back();
  drive.dof = scene::Dof::RotY;
  drive.stiffness = 5000;
  drive.target_position = 1;
  auto sim = simulation(scene);
  double worst = 0;
  for (int i = 0; i < 250; ++i) {
    ASSERT_TRUE(sim->step().has_value());
    worst = std::max(worst, gap(*sim));
  }
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.5, 5e-3);
  EXPECT_NEAR(sim->joint_state(2).position[0], 0.5, 5e-3);
  EXPECT_NEAR(sim->joint_state(2).velocity[0], 1, 1e-2);
  EXPECT_LT(worst, 5e-3);
}

TEST(Loops, LimitOnALoopJointActs) {
  TestScene scene = four_bar(JointKind::Revolute);
  scene.joints[3].lower = -0.3;
  scene.joints[3].upper = 0.3;
  scene.joints[0].damping = 1;
  auto sim = simulation(scene);
  run(*sim, 4);
  // The rocker falls until it makes 0.3 rad with the level coupler.
  EXPECT_NEAR(std::fabs(sim->joint_state(3).position[0]), 0.3, 0.02);
  EXPECT_NEAR(std::fabs(sim->joint_state(2).position[0]), 0.3, 0.02);
  EXPECT_LT(gap(*sim), 2e-3);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/D", "physics:excludeFromArticulation"));
}

/// Two bodies on rails that a weld holds together, of which the second alone has weight.
TestScene welded_slides() {
  TestScene scene;
  const auto a = scene.add_body("A", {{0, 0, 0}});
  const auto b = scene.add_body("B", {{1, 0, 0}});
  scene.add_joint("Rail", JointKind::Prismatic, {}, a, Axis::Z);
  auto& rail = scene.add_joint("Rail2", JointKind::Prismatic, {}, b, Axis::Z);
  rail.frame0.position = {{1, 0, 0}};
  auto& weld = scene.add_joint("Weld", JointKind::Fixed, a, b);
  weld.frame0.position = {{1, 0, 0}};
  scene.bodies[a].gravity_scale = 0;
  return scene;
}

TEST(Loops, WeldClosesALoop) {
  auto sim = simulation(welded_slides());
  run(*sim, 1);
  // Both fall together with half of the weight: a = g / 2.
  EXPECT_NEAR(sim->joint_state(0).velocity[0], -kG / 2, 0.02);
  EXPECT_NEAR(sim->joint_state(1).velocity[0], -kG / 2, 0.02);
}

/// How far the two are apart after a second.
double sag(const scene::MujocoLoop& loop) {
  TestScene scene = welded_slides();
  scene.joints[2].parts.mujoco_loop = loop;
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_TRUE(sim->not_mapped().empty());
  return sim->body_state(0).pose.position[2] - sim->body_state(1).pose.position[2];
}

TEST(Loops, AWeldIsAsSoftAsTheAssetHasIt) {
  const double hard = sag({});
  EXPECT_GT(sag({{0.2, 1}, {}, {}}), 10 * hard);
  EXPECT_GT(sag({{}, {0.1, 0.1, 0.001, 0.5, 2}, {}}), 10 * hard);
  EXPECT_NE(sag({{0.2, 1}, {}, {}}), sag({{0.2, 1}, {0.1, 0.1, 0.001, 0.5, 2}, {}}));
}

TEST(Loops, SoftnessOfAJointThatIsNoConstraintIsNamed) {
  TestScene scene;
  const auto a = scene.add_body("A", {{0, 0, 0}});
  auto& hinge = scene.add_joint("Hinge", JointKind::Revolute, {}, a, Axis::Y);
  hinge.parts.mujoco_loop = {{0.1, 1}, {0.9, 0.95, 0.001, 0.5, 2}, 0.5};
  const auto sim = simulation(scene);
  for (const char* name : {"mjc:solref", "mjc:solimp", "mjc:torqueScale"}) {
    EXPECT_TRUE(mentions(sim->not_mapped(), "/Hinge", name)) << name;
  }
}

TEST(Loops, PlanPutsExcludedJointsLast) {
  const TestScene scene = four_bar(JointKind::Revolute);
  const TreePlan plan = plan_tree(scene);
  EXPECT_EQ(plan.joints, (std::vector<JointRole>{JointRole::Tree, JointRole::Tree, JointRole::Tree,
                                                 JointRole::Hinge}));
  EXPECT_EQ(plan.forest.order.size(), 3u);
  EXPECT_EQ(plan.forest.depth, 2u);
}

TEST(Loops, PlanRootsAFloatingArticulationAtItsRoot) {
  TestScene scene;
  for (const char* name : {"A", "B", "C"}) {
    scene.add_body(name, {});
  }
  scene.add_joint("J1", JointKind::Revolute, 0, 1);
  scene.add_joint("J2", JointKind::Revolute, 2, 1);
  scene::Articulation articulation;
  articulation.links = {1, 0, 2};
  articulation.joints = {0, 1};
  scene.articulations.push_back(articulation);
  const TreePlan plan = plan_tree(scene);
  EXPECT_EQ(plan.bases[1], BodyBase::Free);
  EXPECT_TRUE(plan.forest.bodies[0].reversed);  // body0 of J1 hangs on body1
  EXPECT_TRUE(plan.forest.bodies[2].reversed);
  EXPECT_EQ(plan.forest.order, (std::vector<scene::Index>{1, 0, 2}));
}

// S-110, E-125: the base of a floating articulation is held by a constraint, not by the tree.
TEST(Loops, ExcludedJointToTheWorldHoldsAFloatingArticulation) {
  TestScene scene;
  const auto base = scene.add_body("Base", {{0, 0, 1}});
  const auto arm = scene.add_body("Arm", {{1, 0, 1}});
  scene.add_joint("Hold", JointKind::Fixed, {}, base).frame0.position = {{0, 0, 1}};
  scene.joints[0].exclude_from_articulation = true;
  scene.add_joint("Turn", JointKind::Revolute, base, arm, Axis::Z).frame0.position = {{1, 0, 0}};
  scene::Articulation articulation;
  articulation.links = {base, arm};
  articulation.joints = {1};
  articulation.loop_joints = {0};
  scene.joints[1].articulation = 0;
  scene.articulations.push_back(articulation);
  const TreePlan plan = plan_tree(scene);
  EXPECT_EQ(plan.joints, (std::vector<JointRole>{JointRole::Weld, JointRole::Tree}));
  EXPECT_EQ(plan.bases[base], BodyBase::Free);
  auto sim = simulation(scene);
  run(*sim, 1);
  EXPECT_LT(length(sim->body_state(base).pose.position - Vec3d{{0, 0, 1}}), 1e-3);
}

TEST(Loops, PlanKeepsTwoKinematicBodiesApart) {
  TestScene scene;
  scene.add_body("K1", {});
  scene.add_body("Middle", {});
  scene.add_body("K2", {});
  scene.bodies[0].kinematic = scene.bodies[2].kinematic = true;
  scene.add_joint("J1", JointKind::Spherical, 0, 1);
  scene.add_joint("J2", JointKind::Spherical, 1, 2);
  const TreePlan plan = plan_tree(scene);
  EXPECT_EQ(plan.joints, (std::vector<JointRole>{JointRole::Tree, JointRole::Connect}));
}

}  // namespace
}  // namespace tenon::engines::mujoco
