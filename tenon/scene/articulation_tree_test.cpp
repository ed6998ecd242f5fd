// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/articulation_tree.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tenon/scene/joint_freedom.h"

namespace tenon::scene {
namespace {

constexpr int kNoBody = -1;

/// Bodies 0..count-1 and revolute joints between them; kNoBody: the world.
PhysicsScene linked_bodies(std::size_t count, const std::vector<std::pair<int, int>>& joints) {
  PhysicsScene scene;
  scene.bodies.resize(count);
  for (const auto& [a, b] : joints) {
    Joint joint;
    joint.kind = JointKind::Revolute;
    if (a != kNoBody) {
      joint.body0 = static_cast<Index>(a);
    }
    if (b != kNoBody) {
      joint.body1 = static_cast<Index>(b);
    }
    scene.joints.push_back(joint);
  }
  return scene;
}

std::vector<Index> count_up(std::size_t count) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index{0});
  return order;
}

struct Graph {
  PhysicsScene scene;
  JointGraph graph;
  explicit Graph(PhysicsScene s)
      : scene(std::move(s)), graph(scene, count_up(scene.joints.size())) {}
};

// S-109, E-126
TEST(JointGraph, MiddleOfAChainIsItsCentre) {
  const Graph three(linked_bodies(3, {{0, 1}, {1, 2}}));
  EXPECT_EQ(three.graph.center({0, 1, 2}, count_up(3)), 1u);
  const Graph five(linked_bodies(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}));
  EXPECT_EQ(five.graph.center({0, 1, 2, 3, 4}, count_up(5)), 2u);
}

TEST(JointGraph, TiesGoToMoreJointsThenToTraversalOrder) {
  const Graph even(linked_bodies(4, {{0, 1}, {1, 2}, {2, 3}}));
  EXPECT_EQ(even.graph.center({0, 1, 2, 3}, count_up(4)), 1u);
  EXPECT_EQ(even.graph.center({0, 1, 2, 3}, {3, 2, 1, 0}), 2u);
  const Graph fork(linked_bodies(5, {{0, 1}, {1, 2}, {2, 3}, {2, 4}}));
  EXPECT_EQ(fork.graph.center({0, 1, 2, 3, 4}, count_up(5)), 2u);
}

// S-111
TEST(JointGraph, CircleBreaksAtItsLastJoint) {
  const Graph ring(linked_bodies(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  const JointGraph::Tree tree = ring.graph.tree({0, 1, 2, 3}, std::nullopt);
  EXPECT_EQ(tree.joints, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(tree.loops, (std::vector<Index>{3}));
}

TEST(JointGraph, ExcludedJointBreaksTheCircleInstead) {
  PhysicsScene scene = linked_bodies(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  scene.joints[1].exclude_from_articulation = true;
  const Graph ring(std::move(scene));
  const JointGraph::Tree tree = ring.graph.tree({0, 1, 2, 3}, std::nullopt);
  EXPECT_EQ(tree.joints, (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(tree.loops, (std::vector<Index>{1}));
}

// S-110
TEST(JointGraph, SecondJointToTheWorldClosesALoop) {
  const Graph chain(linked_bodies(2, {{0, 1}, {kNoBody, 0}, {1, kNoBody}}));
  EXPECT_EQ(chain.graph.world_joint({0, 1}), 1u);
  const JointGraph::Tree tree = chain.graph.tree({0, 1}, 1u);
  EXPECT_EQ(tree.joints, (std::vector<Index>{0, 1}));
  EXPECT_EQ(tree.loops, (std::vector<Index>{2}));
}

// S-112
TEST(JointGraph, DisabledJointSplitsTheTree) {
  PhysicsScene scene = linked_bodies(3, {{0, 1}, {1, 2}});
  scene.joints[1].enabled = false;
  const Graph chain(std::move(scene));
  EXPECT_EQ(chain.graph.component(0), (std::vector<Index>{0, 1}));
  EXPECT_FALSE(chain.graph.has_joints(2));
}

// S-114
TEST(JointGraph, DistanceAndFreeJointsStayOutOfTheTree) {
  PhysicsScene scene = linked_bodies(2, {{0, 1}, {0, 1}});
  scene.joints[0].kind = JointKind::Distance;
  scene.joints[1].kind = JointKind::D6;
  EXPECT_FALSE(is_reducible(scene.joints[0]));
  EXPECT_FALSE(is_reducible(scene.joints[1]));
  scene.joints[1].limits = {{Dof::TransX, 1, -1}, {Dof::TransY, 1, -1}};
  EXPECT_TRUE(is_reducible(scene.joints[1]));
}

}  // namespace
}  // namespace tenon::scene
