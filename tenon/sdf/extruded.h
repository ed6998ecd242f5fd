// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::sdf {

inline constexpr std::size_t kExtrudedPoints = 500;  // work grows with its cube

/// Adds the solid above a polygon to the triangles of `mesh`: from z = 0 to `height` [m]. The
/// corners are in their order, either way round, the last one joined to the first. false, and
/// nothing added, for what is no simple polygon of 3 to kExtrudedPoints corners with an area.
bool add_extruded(std::vector<Vec2d> corners, double height, robot::MeshFile& mesh);

}  // namespace tenon::sdf
