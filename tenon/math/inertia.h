// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

/// Symmetric 3x3 inertia matrices [kg m^2].
namespace tenon {

/// R I R^T for the rotation `q` from the frame of `inertia` to the new one.
Mat3d rotate_inertia(const Quatd& q, const Mat3d& inertia);

/// Parallel axis: inertia about a point that lies `offset` away from the centre of mass.
Mat3d shift_inertia(const Mat3d& about_center, double mass, const Vec3d& offset);

Mat3d diagonal_matrix(const Vec3d& diagonal);

struct PrincipalInertia {
  Vec3d moments;                   ///< ascending
  Quatd axes = kIdentityRotation;  ///< rotation from the principal to the given frame
};

/// Eigenvalues and a right-handed eigenframe; the identity frame for an already diagonal matrix
/// (moments then in the order given).
PrincipalInertia principal_inertia(const Mat3d& inertia);

}  // namespace tenon
