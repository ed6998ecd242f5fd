// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tenon/scene/joint_dofs.h"
#include "tenon/scene/motion/tree_inertia.h"

/// How the two sides of a joint may move against each other where they stand.
namespace tenon::scene {

struct JointMotion {
  Vec3d point;                ///< origin of frame 1, about which rotations turn
  std::vector<Vec3d> slides;  ///< of body1 against body0, in the order of JointDofs, world axes
  std::vector<Vec3d> turns;   ///< the same; a ball turns about the axes of frame 0
};

/// `frame0` and `frame1` in world axes, about any origin.
JointMotion joint_motion(const JointDofs& dofs, const Pose& frame0, const Pose& frame1);

/// Orthonormal directions that complete `axes`.
std::vector<Vec3d> directions_across(const std::vector<Vec3d>& axes);

/// The numbers x for which sum axes[i] x[i] is nearest to `wanted`; axes that add nothing get 0.
std::vector<double> shares_of(const std::vector<Vec3d>& axes, const Vec3d& wanted);

}  // namespace tenon::scene
