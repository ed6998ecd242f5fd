// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/math/vector.h"

namespace tenon::engines {

/// Points spread evenly over an ellipsoid with semi-axes `axes` [m], for engines that have hulls
/// alone: their hull lies at most 3 % inside. `with_ends`: those of its axes too, on which it
/// rests, for engines where a body is still on a corner.
std::vector<Vec3d> ellipsoid_points(const Vec3d& axes, bool with_ends);

}  // namespace tenon::engines
