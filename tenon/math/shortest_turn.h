// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/quaternion.h"

namespace tenon {

/// The shortest turn between unit vectors that are not nearly opposite.
inline Quatd shortest_turn(const Vec3d& from, const Vec3d& to) {
  const Vec3d normal = cross(from, to);
  return normalized(Quatd{normal[0], normal[1], normal[2], 1 + dot(from, to)});
}

}  // namespace tenon
