// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

/// Joints of every kind as a chain of single degrees of freedom.
namespace tenon::scene {

/// One free degree of freedom of a chain.
struct FreeDof {
  Dof dof = Dof::RotX;
  Vec3d axis0;                 ///< unit axis in frame 0 when all coordinates are zero
  Vec3d axis1;                 ///< the same axis in frame 1
  double lower = -kUnlimited;  ///< [m or rad]
  double upper = kUnlimited;
};

/// Three rotations that nothing bounds: one ball, or hinges, so that each has a coordinate.
enum class FreeRotations : std::uint8_t { Ball, Hinges };

/// What one joint leaves free. X_J0J1 is the product of translations along frame 0 and then of
/// rotations about the axes as they turn, in the order of `free`; locked ones keep their value.
struct JointDofs {
  std::vector<FreeDof> free;
  bool ball = false;  ///< the rotations are one unlimited ball; `free` holds translations only
  Pose locked;        ///< X_J0J1 when every free coordinate is zero
  FreeRotations rotations = FreeRotations::Ball;  ///< what was asked for

  std::size_t count() const { return free.size() + (ball ? 3u : 0u); }
};

/// Degrees of freedom of any joint but a distance joint (that one leaves all free), limits of the
/// joint and of LimitAPI intersected (S-95, S-98, S-100). A drive or a mimic of a rotation makes
/// hinges of what would be a ball, and so does `rotations`.
JointDofs joint_dofs(const Joint& joint, FreeRotations rotations = FreeRotations::Ball);

/// What each joint is to have: hinges where a rotation of it leads one of another (joint_count).
std::vector<FreeRotations> wanted_rotations(const PhysicsScene& scene);

/// Bounds of the distance between the two frame origins [m], min and max (S-97); both infinite when
/// there are none. min > max: both are max.
Limit distance_limit(const Joint& joint);

/// Coordinates of `dofs.free` (and of a ball as rotation vector, last) at a relative pose X_J0J1.
/// What the joint holds locked is not looked at.
std::vector<double> coordinates_at(const JointDofs& dofs, const Pose& relative);

/// X_J0J1 at the given coordinates, the inverse of `coordinates_at`.
Pose relative_pose_at(const JointDofs& dofs, const std::vector<double>& coordinates);

Vec3d unit_axis(Axis axis);
/// Axis of a degree of freedom, 0..2 for x, y, z.
inline std::size_t axis_of(Dof dof) { return static_cast<std::size_t>(dof) % 3; }

}  // namespace tenon::scene
