// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// The bodies and joints of a scene as a graph. The world is no node: a joint to it belongs to its
/// one body (S-110). Joints that are disabled, excluded, or that no tree can hold (S-112, S-114)
/// are set aside. The reader decides articulations by it, in the traversal order of the stage,
/// which a scene does not keep; the trees of a scene are those of `joint_forest`.
class JointGraph {
 public:
  /// `order`: all joints of the scene in traversal order.
  JointGraph(const PhysicsScene& scene, const std::vector<Index>& order);

  /// Bodies that are joined to `body` by joints of the tree, `body` included, ascending.
  std::vector<Index> component(Index body) const;
  /// Some joint of the tree touches the body.
  bool has_joints(Index body) const { return !joints_of_[body].empty(); }

  struct Tree {
    std::vector<Index> joints;  ///< ascending
    std::vector<Index> loops;   ///< closed by constraints, ascending
  };
  /// Spanning tree of a component: `root_joint` first, then joints in traversal order; a joint that
  /// would close a cycle is a loop, so cycles break at their last joint (S-111). Further joints
  /// to the world close loops (S-110).
  Tree tree(const std::vector<Index>& component, std::optional<Index> root_joint) const;

  /// First joint to the world in traversal order that touches the component.
  std::optional<Index> world_joint(const std::vector<Index>& component) const;
  /// The body from which the farthest one is nearest; ties: more joints, then `earlier` order
  /// (S-109).
  Index center(const std::vector<Index>& component, const std::vector<Index>& traversal_rank) const;

 private:
  bool is_to_world(Index joint) const {
    return !scene_.joints[joint].body0 || !scene_.joints[joint].body1;
  }
  std::vector<Index> distances(Index from, const std::vector<Index>& component) const;
  void collect(const std::vector<Index>& component, std::vector<Index>& inside,
               std::vector<Index>& aside) const;

  const PhysicsScene& scene_;
  std::vector<std::vector<Index>> joints_of_;  // (body_count) tree joints in traversal order
  std::vector<std::vector<Index>> aside_of_;   // (body_count) enabled joints that no tree holds
  std::vector<Index> rank_;                    // (joint_count) place in traversal order
};

}  // namespace tenon::scene
