// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "tenon/math/transform.h"
#include "tenon/physics/units.h"

namespace tenon::physics {

/// The rigid part of a local-to-world matrix in metres (S-33): exact translation, the rotation that
/// `factor` finds; scale is the shapes' business.
inline Pose world_pose(const Factored& world, const Units& units) {
  return {world.translation * units.length, rotation_of(world.rotation)};
}
inline Pose world_pose(const Mat4d& world, const Units& units) {
  return world_pose(factor(world), units);
}

/// A point of the prim's space (stage units), exactly, in metres in the frame X_WF.
inline Vec3d point_in_frame(const Vec3d& point, const Mat4d& world, const Pose& frame,
                            const Units& units) {
  return transform_point(inverse(frame), transform_point(point, world) * units.length);
}

}  // namespace tenon::physics
