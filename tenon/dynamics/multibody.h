// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/motion/joint_tree.h"
#include "tenon/scene/physics_scene.h"

/// Multibody algebra of the neutral description, without any engine: coordinates, kinematics, mass
/// matrices and what follows from them, at any posture.
namespace tenon::dynamics {

using scene::Index;

/// One degree of freedom of the trees of a scene (joint_forest).
struct Coordinate {
  std::optional<Index> joint;  ///< none: of the body, which floats
  Index body = 0;              ///< that it moves, with all that hangs on it
  scene::Dof dof = scene::Dof::RotX;
  /// Of a joint: its place in Posture::joints. Of a floating body 0..2: the velocity of its centre
  /// of mass, 3..5: its angular velocity, both along the axes of the world.
  std::size_t part = 0;
};

/// A drive of the joint acts on this degree of freedom.
bool is_driven(const scene::Joint& joint, scene::Dof dof);
/// What makes this degree of freedom follow another; null: nothing does.
const scene::Mimic* mimic_of(const scene::Joint& joint, scene::Dof dof);

/// Where the joints and bodies of a scene are.
struct Posture {
  /// (joint_count) Coordinates [m, rad] in the order of JointDofs::free; a ball's rotation vector
  /// last.
  std::vector<std::vector<double>> joints;
  std::vector<Pose> bodies;  ///< X_WB (body_count)
};

/// The trees of a scene, which must outlive it. Bodies that no joint of a tree holds float, and
/// kinematic ones stand still.
class Multibody {
 public:
  explicit Multibody(const scene::PhysicsScene& scene);

  const scene::PhysicsScene& scene() const { return *scene_; }
  const scene::JointForest& forest() const { return forest_; }
  const std::vector<scene::JointDofs>& dofs() const { return dofs_; }  // (joint_count)

  /// All degrees of freedom, from the roots outward: bodies in the order of JointForest::order, and
  /// of one body in the order of Coordinate::part. (dof_count)
  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  std::optional<std::size_t> coordinate_of(Index joint, scene::Dof dof) const;

  /// As the asset has it: authored joint positions, else those of the poses of the bodies.
  Posture start() const;
  /// Joints of trees put to `joints` (joint_count), as in Posture; the bodies follow from the
  /// roots, which stay. Followers of mimics go where their leaders say, and what loops hold is
  /// moved from there until they close, joints with drives least (loop_gap says how well).
  Posture moved(const Posture& from, std::vector<std::vector<double>> joints) const;
  /// The largest distance [m] by which frames of joints that close loops are apart.
  double loop_gap(const Posture& posture) const;

  /// The group of bodies and joints that a body belongs to; of a body without joints itself alone.
  /// (group_count), and for each body an index into it (body_count).
  const std::vector<scene::JointGroup>& groups() const { return groups_; }
  const std::vector<std::size_t>& group_of() const { return group_of_; }

 private:
  /// A mimic of a joint.
  struct Follower {
    Index joint = 0;
    const scene::Mimic* mimic = nullptr;
  };

  void add_coordinates(Index body);
  void find_groups();
  void find_followers();
  void follow(Posture& posture) const;
  void place_bodies(Posture& posture) const;

  const scene::PhysicsScene* scene_;
  scene::JointForest forest_;
  std::vector<scene::JointDofs> dofs_;
  std::vector<Coordinate> coordinates_;
  std::vector<std::size_t> first_coordinate_;  // of each joint of a tree (joint_count)
  std::vector<scene::JointGroup> groups_;
  std::vector<std::size_t> group_of_;
  std::vector<Follower> followers_;  // leaders before those that follow them
};

}  // namespace tenon::dynamics
