// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "tenon/math/vector.h"

namespace tenon::urdf {

/// Red, green, blue, opacity as displayed, 0 to 1, of those materials of Gazebo that are one colour
/// ("Gazebo/Red"); none for others.
std::optional<Vec4d> gazebo_color(std::string_view material);

}  // namespace tenon::urdf
