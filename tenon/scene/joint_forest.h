// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tenon/scene/physics_scene.h"

/// The joints of a scene as trees of bodies, and the joints that no tree has room for. Everything
/// that shows, exports or simulates a scene as trees takes them from here, so that all of them cut
/// a loop at the same joint.
namespace tenon::scene {

/// What a joint is to the trees.
enum class ForestRole : std::uint8_t {
  None,  ///< disabled, or both its sides are the same
  Tree,  ///< hangs a body on its parent
  Loop,  ///< joins what hangs together already, or cannot be of a tree: kept as a constraint
};

struct ForestBody {
  std::optional<Index> parent;  ///< body; none: the world, or nothing
  std::optional<Index> joint;   ///< to the parent or the world; none: the body floats or is given
  bool reversed = false;        ///< the body is body0 of `joint`, its parent body1
  bool fixed = false;  ///< its tree hangs on the world by a joint, or its root is kinematic
  Index root = 0;      ///< body where its tree starts: itself for roots
  Index island = 0;    ///< first of the bodies that joints of trees and loops hold together
  std::vector<Index> children;  ///< bodies, ascending by their joints
};

struct JointForest {
  std::vector<ForestBody> bodies;  // (body_count)
  std::vector<ForestRole> joints;  // (joint_count)
  /// Bodies without a parent: those that hang on the world, ascending by their joints, then the
  /// others, ascending.
  std::vector<Index> roots;
  /// All bodies, parents before children: level by level from the world, then tree by tree.
  std::vector<Index> order;
  std::vector<Index> loop_joints;  ///< ascending
  std::size_t depth = 0;           ///< bodies on the longest way from a root to a leaf
};

/// Where a tree starts that neither hangs on the world nor holds a kinematic body. It changes no
/// joint's role.
enum class FloatingRoots : std::uint8_t {
  Articulations,              ///< at the root link of the articulation; else at the first body
  Directions,                 ///< at the first body that no joint of the tree has as body1
  ArticulationsOrDirections,  ///< at the root link of the articulation; else as by Directions
};

/// Spanning forest over the enabled joints of a scene. The world and every kinematic body are
/// roots, and no tree holds two of them. Trees take joints of articulations first, then those of no
/// articulation, then joints that are excluded from articulations, not reducible (S-114) or loop
/// joints of an articulation; among equals first what needs a coordinate, then in path order. A
/// joint to the world that is a loop joint of a floating articulation stays one (S-110). Distance
/// joints, and D6 joints that hold nothing, are in no tree.
JointForest joint_forest(const PhysicsScene& scene,
                         FloatingRoots floating = FloatingRoots::Articulations);

}  // namespace tenon::scene
