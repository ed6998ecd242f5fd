// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

struct Tendons {
  std::vector<robot::MujocoTendon> tendons;
  std::vector<std::optional<robot::Index>> of_number;  ///< (ntendon), into tendons; none: skipped
};

/// Lengths count from where the model stands. Tendons that the schema cannot say are listed as left
/// out.
Tendons read_tendons(MjcfSource& source, const BodyTree& tree);

/// Geoms that tendons go around (ngeom): they need names to be found by.
std::vector<char> wrapped_geoms(const mjModel& model);

}  // namespace tenon::mjcf
