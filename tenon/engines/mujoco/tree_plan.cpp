// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/tree_plan.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "tenon/engines/mujoco/joint_dofs.h"

// Kruskal's spanning forest over a graph whose nodes are the bodies and the world. The world and
// every kinematic body are roots: two of them never meet in one tree, a joint between their trees
// closes a loop. Then each tree is walked from its root to give parents.
namespace tenon::engines::mujoco {
namespace {

using physics::Index;
using physics::Joint;
using physics::JointKind;
using physics::kUnlimited;
using physics::PhysicsScene;

class Forest {
 public:
  explicit Forest(std::size_t size) : parent_(size), rooted_(size, 0) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void root(std::size_t node) { rooted_[node] = 1; }
  /// Joins the trees of a and b unless that would make a loop or join two roots.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b || (rooted_[a] != 0 && rooted_[b] != 0)) {
      return false;
    }
    parent_[b] = a;
    rooted_[a] = static_cast<char>(rooted_[a] | rooted_[b]);
    return true;
  }

 private:
  std::size_t find(std::size_t node) {
    while (parent_[node] != node) {
      parent_[node] = parent_[parent_[node]];
      node = parent_[node];
    }
    return node;
  }
  std::vector<std::size_t> parent_;
  std::vector<char> rooted_;
};

bool is_plain(const Joint& joint) {
  return joint.drives.empty() && !joint.mimic.has_value() && joint.limits.empty() &&
         joint.armature == 0 && joint.friction == 0 && joint.damping == 0 && joint.stiffness == 0;
}

JointRole loop_role(const Joint& joint) {
  if (joint.kind == JointKind::Fixed) {
    return JointRole::Weld;
  }
  const bool open_cone = joint.cone_angle0 == kUnlimited && joint.cone_angle1 == kUnlimited;
  if (joint.kind == JointKind::Spherical && is_plain(joint) &&
      (open_cone || circular_cone(joint) < kUnlimited)) {
    return JointRole::Connect;
  }
  if (joint.kind == JointKind::Revolute && is_plain(joint) && joint.lower == -kUnlimited &&
      joint.upper == kUnlimited) {
    return JointRole::Hinge;
  }
  return JointRole::Ghost;
}

bool is_kinematic(const PhysicsScene& scene, const std::optional<Index>& body) {
  return !body.has_value() || scene.bodies[*body].kinematic;
}

// Joints that hold something between two different sides of which one can move.
bool constrains(const PhysicsScene& scene, const Joint& joint) {
  if (!joint.enabled || joint.kind == JointKind::Distance || joint.body0 == joint.body1 ||
      (is_kinematic(scene, joint.body0) && is_kinematic(scene, joint.body1))) {
    return false;
  }
  return !joint_dofs(joint).holds_nothing() || !is_plain(joint);
}

// Smaller comes first: joints of articulations, then others; what is easy to close as a loop
// last; declared loop joints after all.
std::vector<Index> joints_by_rank(const PhysicsScene& scene) {
  std::vector<char> late(scene.joints.size(), 0);
  for (const physics::Articulation& articulation : scene.articulations) {
    for (const Index joint : articulation.loop_joints) {
      late[joint] = 1;
    }
  }
  std::vector<std::tuple<bool, bool, bool, Index>> ranked;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (constrains(scene, joint)) {
      ranked.emplace_back(late[j] != 0 || joint.exclude_from_articulation,
                          !joint.articulation.has_value(), loop_role(joint) != JointRole::Ghost, j);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<Index> result;
  for (const auto& entry : ranked) {
    result.push_back(std::get<3>(entry));
  }
  return result;
}

struct Edge {
  std::size_t to = 0;
  Index joint = 0;
};
using Neighbours = std::vector<std::vector<Edge>>;

// The world is the node after the last body.
std::size_t node_of(const PhysicsScene& scene, const std::optional<Index>& body) {
  return body.has_value() ? *body : scene.bodies.size();
}

Neighbours choose_tree_joints(const PhysicsScene& scene, TreePlan& plan) {
  const std::size_t world = scene.bodies.size();
  Forest forest(world + 1);
  forest.root(world);
  for (std::size_t b = 0; b < world; ++b) {
    if (scene.bodies[b].kinematic) {
      forest.root(b);
    }
  }
  Neighbours neighbours(world + 1);
  for (const Index j : joints_by_rank(scene)) {
    const Joint& joint = scene.joints[j];
    const std::size_t a = node_of(scene, joint.body0);
    const std::size_t b = node_of(scene, joint.body1);
    if (forest.join(a, b)) {
      plan.joints[j] = JointRole::Tree;
      neighbours[a].push_back({b, j});
      neighbours[b].push_back({a, j});
    } else {
      plan.joints[j] = loop_role(joint);
    }
  }
  return neighbours;
}

// Roots first: the world, kinematic bodies, roots of floating articulations, then what is left.
std::vector<std::size_t> root_candidates(const PhysicsScene& scene) {
  std::vector<std::size_t> result{scene.bodies.size()};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].kinematic) {
      result.push_back(b);
    }
  }
  for (const physics::Articulation& articulation : scene.articulations) {
    if (!articulation.links.empty()) {
      result.push_back(articulation.links.front());
    }
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    result.push_back(b);
  }
  return result;
}

void walk_tree(const PhysicsScene& scene, const Neighbours& neighbours, std::size_t root,
               std::vector<std::size_t>& level, TreePlan& plan) {
  const std::size_t world = scene.bodies.size();
  std::vector<std::size_t> queue{root};
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::size_t from = queue[head];
    if (from != world) {
      plan.order.push_back(static_cast<Index>(from));
      plan.depth = std::max(plan.depth, level[from]);
    }
    for (const Edge& edge : neighbours[from]) {
      if (level[edge.to] != 0 || edge.to == root) {
        continue;
      }
      level[edge.to] = (from == world ? 0 : level[from]) + 1;
      BodyPlan& body = plan.bodies[edge.to];
      body.base = BodyBase::Jointed;
      body.joint = edge.joint;
      body.reversed = node_of(scene, scene.joints[edge.joint].body0) == edge.to;
      if (from != world) {
        body.parent = static_cast<Index>(from);
      }
      queue.push_back(edge.to);
    }
  }
}

}  // namespace

TreePlan plan_tree(const PhysicsScene& scene) {
  TreePlan plan;
  plan.bodies.resize(scene.bodies.size());
  plan.joints.assign(scene.joints.size(), JointRole::None);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    plan.bodies[b].base = scene.bodies[b].kinematic ? BodyBase::Fixed : BodyBase::Free;
  }
  for (const physics::PoseTrack& track : scene.pose_tracks) {
    const bool drives = track.body.has_value() && scene.bodies[*track.body].kinematic &&
                        scene.bodies[*track.body].enabled;
    if (drives && !track.times.empty()) {
      plan.bodies[*track.body].base = BodyBase::Driven;
    }
  }
  const Neighbours neighbours = choose_tree_joints(scene, plan);
  std::vector<std::size_t> level(scene.bodies.size() + 1, 0);
  for (const std::size_t root : root_candidates(scene)) {
    if (level[root] == 0) {
      level[root] = 1;
      walk_tree(scene, neighbours, root, level, plan);
    }
  }
  return plan;
}

}  // namespace tenon::engines::mujoco
