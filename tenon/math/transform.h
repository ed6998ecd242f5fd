// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

namespace tenon {

/// A rigid pose X_AB: of frame B, seen from frame A. p_A = position + rotation (p_B).
struct Pose {
  Vec3d position;
  Quatd orientation = kIdentityRotation;

  bool operator==(const Pose&) const = default;
};

inline bool is_finite(const Quatd& q) {
  return is_finite(q.x) && is_finite(q.y) && is_finite(q.z) && is_finite(q.w);
}
inline bool is_finite(const Pose& pose) {
  return is_finite(pose.position) && is_finite(pose.orientation);
}

/// X_AC = X_AB X_BC.
inline Pose operator*(const Pose& ab, const Pose& bc) {
  return {ab.position + rotate(ab.orientation, bc.position), ab.orientation * bc.orientation};
}

inline Pose inverse(const Pose& ab) {
  const Quatd back = conjugate(ab.orientation);
  return {-rotate(back, ab.position), back};
}

inline Vec3d transform_point(const Pose& ab, const Vec3d& p) {
  return ab.position + rotate(ab.orientation, p);
}

/// Row-vector matrix of a pose.
Mat4d pose_matrix(const Pose& pose);

/// A factored 4x4 matrix: M = r S r^-1 u t (row vectors), as OpenUSD's GfTransform does.
struct Factored {
  Mat3d scale_orientation = Mat3d::identity();  ///< r
  Vec3d scale{{1, 1, 1}};                       ///< S, all negative when M mirrors
  Mat3d rotation = Mat3d::identity();           ///< u, proper
  Vec3d translation;                            ///< t
  bool sheared = false;  ///< r is not the identity (up to axis order) and S is not uniform
};

Factored factor(const Mat4d& m);

/// The rigid part of a matrix: exact translation, rotation factor of `factor`.
Pose rigid_part(const Mat4d& m);

/// Per-axis scale: lengths of the rows of the linear part, negative along one axis (the first)
/// when the matrix mirrors.
Vec3d row_scale(const Mat4d& m);

}  // namespace tenon
