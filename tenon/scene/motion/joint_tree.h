// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/motion/joint_motion.h"
#include "tenon/scene/motion/loop_impulses.h"
#include "tenon/scene/motion/tree_inertia.h"

/// The bodies of a scene that joints hold together, as motion trees at given poses.
namespace tenon::scene {

/// Bodies that joints and mimics tie together.
struct JointGroup {
  std::vector<Index> bodies;  ///< in the order of JointForest::order
  std::vector<Index> joints;  ///< ascending; those of trees and those that close loops
};

/// All groups with at least one joint.
std::vector<JointGroup> joint_groups(const PhysicsScene& scene, const JointForest& forest);

/// The joint restricts how its sides move: all but distance joints and D6 joints without bounds.
bool holds(const Joint& joint);

/// Which mimics tie a follower to its leader.
enum class TiedMimics : std::uint8_t {
  Rigid,  ///< those without compliance; others are springs
  All,
};

struct JointTreeOptions {
  double least_mass = 0;    ///< of a body [kg]
  double least_moment = 0;  ///< added to its moments of inertia [kg m^2]
  TiedMimics mimics = TiedMimics::Rigid;
};

/// A group as a tree about `origin`. Columns are the speeds of the joints of the tree, in the order
/// of JointDofs, and six of each body that floats: of its centre of mass, and its angular velocity,
/// along the axes of the world. Motions of kinematic bodies are given, all columns are sought.
class JointTree {
 public:
  /// `poses` (body_count) are X_WB. What the arguments name must outlive it.
  JointTree(const PhysicsScene& scene, const JointForest& forest,
            const std::vector<JointDofs>& dofs, const std::vector<Pose>& poses,
            const JointGroup& group, const JointTreeOptions& options);

  const MotionTree& tree() const { return tree_; }
  const LoopRows& loops() const { return loops_; }
  const std::vector<Index>& bodies() const { return bodies_; }  // (member_count)
  const Vec3d& origin() const { return origin_; }
  std::size_t member_of(Index body) const { return member_of_.at(body); }
  /// Of each joint of the tree.
  const std::map<Index, std::size_t>& first_columns() const { return first_column_; }
  std::optional<std::size_t> column_of(Index joint, Dof dof) const;

  /// Relative to `origin`.
  Vec3d center_of(Index body) const;
  JointMotion motion_of(Index joint) const;
  /// The directions in which a joint holds its two sides together.
  std::vector<LoopRow> rows_of(Index joint) const;

  /// Prescribes the speed of a column: it is no longer sought.
  void give(std::size_t column) { tree_.given[column] = 1; }

 private:
  Pose frame_of(const std::optional<Index>& body, const Pose& frame) const;
  Mat3d inertia_about_center(Index body) const;
  RigidInertia inertia_of(Index body) const;
  double response(const std::optional<std::size_t>& member, const Screw& impulse) const;
  double slope_of(const Mimic& mimic) const;
  std::optional<std::size_t> member_at(const std::optional<Index>& body) const;
  void add_columns(std::size_t member);
  void add_mimic(Index joint, const Mimic& mimic);
  void add_rows(const std::vector<Index>& joints);

  const PhysicsScene& scene_;
  const JointForest& forest_;
  const std::vector<JointDofs>& dofs_;
  const std::vector<Pose>& poses_;
  JointTreeOptions options_;
  Vec3d origin_;
  std::vector<Index> bodies_;
  std::map<Index, std::size_t> member_of_;
  std::map<Index, std::size_t> first_column_;
  MotionTree tree_;
  LoopRows loops_;
};

}  // namespace tenon::scene
