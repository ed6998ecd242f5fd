// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/base/token.h"
#include "tenon/math/matrix.h"

namespace tenon::bake {

/// Angles about x, y and z [deg] with which a rotate op ("xformOp:rotateXYZ", "xformOp:rotateZ")
/// gives the rotation `rigid` (row vectors): of those that do, the nearest to `before`. Ops about
/// one axis leave the other two angles 0; nullopt where that cannot give the rotation.
std::optional<Vec3d> euler_degrees(const Mat3d& rigid, Token op, const Vec3d& before);

}  // namespace tenon::bake
