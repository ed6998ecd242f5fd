// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/joint_forest.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tenon/scene/articulation_tree.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

constexpr int kWorld = -1;
using Indices = std::vector<Index>;

Joint joint(int body0, int body1, JointKind kind = JointKind::Revolute) {
  Joint result;
  result.kind = kind;
  if (body0 != kWorld) {
    result.body0 = static_cast<Index>(body0);
  }
  if (body1 != kWorld) {
    result.body1 = static_cast<Index>(body1);
  }
  return result;
}

PhysicsScene scene_of(std::size_t bodies, std::vector<Joint> joints) {
  PhysicsScene scene;
  scene.bodies.resize(bodies);
  scene.joints = std::move(joints);
  return scene;
}

/// The scene with an articulation over all bodies, as the reader decides it.
PhysicsScene articulated(PhysicsScene scene, const Indices& traversal,
                         std::optional<Index> root_joint, Index root) {
  const JointGraph graph(scene, traversal);
  Articulation articulation;
  articulation.links = graph.component(root);
  std::iter_swap(articulation.links.begin(),
                 std::find(articulation.links.begin(), articulation.links.end(), root));
  Indices sorted = articulation.links;
  std::sort(sorted.begin(), sorted.end());
  JointGraph::Tree tree = graph.tree(sorted, root_joint);
  articulation.fixed_base = root_joint.has_value();
  articulation.joints = tree.joints;
  articulation.loop_joints = tree.loops;
  for (const Index i : tree.joints) {
    scene.joints[i].articulation = 0;
  }
  scene.articulations = {articulation};
  return scene;
}

/// A base fixed to the world by joint 0 and four bars in a ring, joints 1 to 4.
PhysicsScene four_bar() {
  return scene_of(
      4, {joint(kWorld, 0, JointKind::Fixed), joint(0, 1), joint(1, 2), joint(2, 3), joint(3, 0)});
}

TEST(JointForest, ChainHangsOnTheWorld) {
  const JointForest forest =
      joint_forest(scene_of(3, {joint(0, 1), joint(2, 1), joint(0, kWorld)}));
  EXPECT_EQ(forest.roots, (Indices{0}));
  EXPECT_EQ(forest.order, (Indices{0, 1, 2}));
  EXPECT_EQ(forest.depth, 3u);
  EXPECT_EQ(forest.bodies[0].joint, 2u);
  EXPECT_EQ(forest.bodies[0].parent, std::nullopt);
  EXPECT_TRUE(forest.bodies[0].reversed);
  EXPECT_EQ(forest.bodies[1].parent, 0u);
  EXPECT_FALSE(forest.bodies[1].reversed);
  EXPECT_EQ(forest.bodies[2].parent, 1u);
  EXPECT_EQ(forest.bodies[2].joint, 1u);
  EXPECT_TRUE(forest.bodies[2].reversed);
  for (const ForestBody& body : forest.bodies) {
    EXPECT_EQ(body.root, 0u);
    EXPECT_TRUE(body.fixed);
  }
  EXPECT_TRUE(forest.loop_joints.empty());
}

TEST(JointForest, BranchesComeInTheOrderOfTheirJoints) {
  const JointForest forest =
      joint_forest(scene_of(5, {joint(0, 3), joint(0, 1), joint(1, 4), joint(0, 2)}));
  EXPECT_EQ(forest.bodies[0].children, (Indices{3, 1, 2}));
  EXPECT_EQ(forest.bodies[1].children, (Indices{4}));
  EXPECT_EQ(forest.order, (Indices{0, 3, 1, 2, 4}));
  EXPECT_EQ(forest.bodies[0].joint, std::nullopt);
  EXPECT_FALSE(forest.bodies[0].fixed);
}

TEST(JointForest, RingIsCutAtItsLastJoint) {
  const JointForest forest = joint_forest(four_bar());
  EXPECT_EQ(forest.loop_joints, (Indices{4}));
  EXPECT_EQ(forest.joints[4], ForestRole::Loop);
  EXPECT_EQ(forest.bodies[3].parent, 2u);
}

TEST(JointForest, RingIsCutWhereTheArticulationCutsIt) {
  for (const Index last : {1u, 2u, 3u, 4u}) {
    Indices traversal{0, 1, 2, 3, 4};
    std::swap(traversal[last], traversal[4]);
    const JointForest forest = joint_forest(articulated(four_bar(), traversal, 0, 0));
    EXPECT_EQ(forest.loop_joints, (Indices{last}));
  }
}

TEST(JointForest, RingIsCutAtTheExcludedJoint) {
  for (const Index excluded : {1u, 2u, 3u, 4u}) {
    PhysicsScene scene = four_bar();
    scene.joints[excluded].exclude_from_articulation = true;
    EXPECT_EQ(joint_forest(scene).loop_joints, (Indices{excluded}));
  }
}

TEST(JointForest, RingIsCutWhereNoCoordinateIsNeeded) {
  PhysicsScene scene = four_bar();
  for (const Index driven : {1u, 3u, 4u}) {
    scene.joints[driven].drives.emplace_back();
  }
  EXPECT_EQ(joint_forest(scene).loop_joints, (Indices{2}));
}

TEST(JointForest, ExcludedJointSpansWhereNothingElseDoes) {
  PhysicsScene scene = scene_of(2, {joint(kWorld, 0), joint(0, 1)});
  scene.joints[1].exclude_from_articulation = true;
  const JointForest forest = joint_forest(scene);
  EXPECT_EQ(forest.bodies[1].parent, 0u);
  EXPECT_TRUE(forest.loop_joints.empty());
}

// S-110, E-125
TEST(JointForest, ExcludedJointToTheWorldLeavesAnArticulationFloating) {
  PhysicsScene scene = scene_of(3, {joint(0, 1), joint(1, 2), joint(kWorld, 0, JointKind::Fixed)});
  scene.joints[2].exclude_from_articulation = true;
  const JointForest forest = joint_forest(articulated(scene, {0, 1, 2}, std::nullopt, 1));
  EXPECT_EQ(forest.roots, (Indices{1}));
  EXPECT_EQ(forest.order, (Indices{1, 0, 2}));
  EXPECT_TRUE(forest.bodies[0].reversed);
  EXPECT_FALSE(forest.bodies[1].fixed);
  EXPECT_EQ(forest.loop_joints, (Indices{2}));
}

// A joint that breaks leaves its place to the one that closed the loop.
TEST(JointForest, LoopJointSpansOnceTheLoopIsOpen) {
  PhysicsScene scene = articulated(four_bar(), {0, 1, 2, 3, 4}, 0, 0);
  scene.joints[2].enabled = false;
  const JointForest forest = joint_forest(scene);
  EXPECT_TRUE(forest.loop_joints.empty());
  EXPECT_EQ(forest.bodies[3].joint, 4u);
  EXPECT_EQ(forest.bodies[2].joint, 3u);
}

// S-112
TEST(JointForest, DisabledJointIsInNoTreeAndNoLoop) {
  PhysicsScene scene = scene_of(2, {joint(0, 1)});
  scene.joints[0].enabled = false;
  const JointForest forest = joint_forest(scene);
  EXPECT_EQ(forest.joints[0], ForestRole::None);
  EXPECT_EQ(forest.roots, (Indices{0, 1}));
  EXPECT_TRUE(forest.loop_joints.empty());
}

TEST(JointForest, JointOfOneBodyToItselfIsNothing) {
  const JointForest forest = joint_forest(scene_of(1, {joint(0, 0), joint(kWorld, kWorld)}));
  EXPECT_EQ(forest.joints, (std::vector<ForestRole>{ForestRole::None, ForestRole::None}));
  EXPECT_EQ(forest.roots, (Indices{0}));
}

TEST(JointForest, TwoTreesHaveARootEach) {
  const JointForest forest =
      joint_forest(scene_of(5, {joint(0, 1), joint(3, 4), joint(kWorld, 4)}));
  EXPECT_EQ(forest.roots, (Indices{4, 0, 2}));
  EXPECT_EQ(forest.order, (Indices{4, 3, 0, 1, 2}));
  EXPECT_TRUE(forest.bodies[3].fixed);
  EXPECT_EQ(forest.bodies[3].root, 4u);
  EXPECT_FALSE(forest.bodies[1].fixed);
  EXPECT_EQ(forest.bodies[1].root, 0u);
}

// S-110
TEST(JointForest, SecondJointToTheWorldIsALoopOfOneIsland) {
  const JointForest forest =
      joint_forest(scene_of(3, {joint(0, 1), joint(kWorld, 1), joint(1, 2), joint(2, kWorld)}));
  EXPECT_EQ(forest.loop_joints, (Indices{3}));
  EXPECT_EQ(forest.roots, (Indices{1}));
}

TEST(JointForest, LoopBetweenTwoTreesMakesThemOneIsland) {
  const JointForest forest = joint_forest(
      scene_of(5, {joint(kWorld, 0), joint(kWorld, 1), joint(0, 2), joint(1, 2), joint(3, 4)}));
  EXPECT_EQ(forest.loop_joints, (Indices{3}));
  EXPECT_EQ(forest.roots, (Indices{0, 1, 3}));
  Indices islands;
  for (const ForestBody& body : forest.bodies) {
    islands.push_back(body.island);
  }
  EXPECT_EQ(islands, (Indices{0, 0, 0, 3, 3}));
}

TEST(JointForest, KinematicBodiesAreRootsThatNeverMeet) {
  PhysicsScene scene = scene_of(3, {joint(0, 1), joint(1, 2), joint(kWorld, 0)});
  scene.bodies[0].kinematic = scene.bodies[2].kinematic = true;
  const JointForest forest = joint_forest(scene);
  EXPECT_EQ(forest.roots, (Indices{0, 2}));
  EXPECT_EQ(forest.loop_joints, (Indices{1, 2}));
  EXPECT_EQ(forest.bodies[0].joint, std::nullopt);
  EXPECT_TRUE(forest.bodies[1].fixed);
}

TEST(JointForest, FloatingTreeStartsAtTheRootOfItsArticulation) {
  const PhysicsScene scene =
      articulated(scene_of(3, {joint(0, 1), joint(2, 1)}), {0, 1}, std::nullopt, 1);
  EXPECT_EQ(joint_forest(scene).order, (Indices{1, 0, 2}));
  const JointForest directed = joint_forest(scene, FloatingRoots::Directions);
  EXPECT_EQ(directed.order, (Indices{0, 1, 2}));
  EXPECT_TRUE(directed.bodies[2].reversed);
  EXPECT_EQ(joint_forest(scene, FloatingRoots::ArticulationsOrDirections).order,
            (Indices{1, 0, 2}));
}

TEST(JointForest, DirectionsStartAtTheBodyThatNoJointCarries) {
  const PhysicsScene scene = scene_of(3, {joint(2, 0), joint(0, 1)});
  EXPECT_EQ(joint_forest(scene).roots, (Indices{0}));
  const JointForest directed = joint_forest(scene, FloatingRoots::Directions);
  EXPECT_EQ(directed.order, (Indices{2, 0, 1}));
  EXPECT_EQ(joint_forest(scene, FloatingRoots::ArticulationsOrDirections).order, directed.order);
  EXPECT_FALSE(directed.bodies[0].reversed);
}

// S-114
TEST(JointForest, IrreducibleJointsComeLast) {
  PhysicsScene scene = scene_of(2, {joint(0, 1, JointKind::D6), joint(0, 1)});
  scene.joints[0].limits = {{Dof::RotX, 1, -1}};
  ASSERT_FALSE(is_plain(scene.joints[0]));
  EXPECT_EQ(joint_forest(scene).loop_joints, (Indices{0}));
  scene.joints.pop_back();
  EXPECT_EQ(joint_forest(scene).bodies[1].joint, 0u);
}

TEST(JointForest, DistanceAndFreeJointsCarryNothing) {
  const JointForest forest =
      joint_forest(scene_of(3, {joint(0, 1, JointKind::Distance), joint(1, 2, JointKind::D6)}));
  EXPECT_EQ(forest.roots, (Indices{0, 1, 2}));
  EXPECT_EQ(forest.loop_joints, (Indices{0, 1}));
}

TEST(JointForest, EmptySceneHasNoTrees) {
  const JointForest forest = joint_forest({});
  EXPECT_TRUE(forest.order.empty());
  EXPECT_EQ(forest.depth, 0u);
}

/// Joints of many kinds between few bodies, so that there are loops.
PhysicsScene random_scene(std::mt19937& random) {
  const auto pick = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  PhysicsScene scene = scene_of(static_cast<std::size_t>(pick(1, 8)), {});
  const int last = static_cast<int>(scene.bodies.size()) - 1;
  for (int i = pick(0, 12); i > 0; --i) {
    const int body0 = pick(kWorld, last);
    Joint made = joint(body0, pick(kWorld, last), static_cast<JointKind>(pick(0, 5)));
    made.enabled = pick(0, 9) > 0;
    made.exclude_from_articulation = pick(0, 5) == 0;
    if (made.body0 != made.body1) {
      scene.joints.push_back(made);
    }
  }
  return scene;
}

void expect_sound(const PhysicsScene& scene, const JointForest& forest) {
  Indices sorted = forest.order;
  std::sort(sorted.begin(), sorted.end());
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    ASSERT_EQ(sorted[i], i);
  }
  std::vector<char> seen(scene.bodies.size(), 0);
  for (const Index i : forest.order) {
    const ForestBody& body = forest.bodies[i];
    EXPECT_TRUE(!body.parent || seen[*body.parent] != 0);
    EXPECT_TRUE(!body.joint || forest.joints[*body.joint] == ForestRole::Tree);
    EXPECT_EQ(body.root == i, !body.parent);
    seen[i] = 1;
  }
}

TEST(JointForest, LoopsOfArticulationsAreItsLoopsWhateverTheScene) {
  std::mt19937 random(7);
  for (int run = 0; run < 2000; ++run) {
    PhysicsScene scene = random_scene(random);
    Indices traversal(scene.joints.size());
    for (Index i = 0; i < traversal.size(); ++i) {
      traversal[i] = i;
    }
    std::shuffle(traversal.begin(), traversal.end(), random);
    const JointGraph graph(scene, traversal);
    std::optional<Index> base = graph.world_joint(graph.component(0));
    base = run % 3 == 0 ? std::nullopt : base;
    scene = articulated(scene, traversal, base, 0);
    const JointForest forest = joint_forest(scene);
    expect_sound(scene, forest);
    for (const Index i : scene.articulations[0].loop_joints) {
      EXPECT_EQ(forest.joints[i], ForestRole::Loop) << "run " << run << ", joint " << i;
    }
    for (const Index i : scene.articulations[0].joints) {
      EXPECT_EQ(forest.joints[i], ForestRole::Tree) << "run " << run << ", joint " << i;
    }
  }
}

}  // namespace
}  // namespace tenon::scene
