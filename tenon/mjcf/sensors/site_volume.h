// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/robot/mujoco_parts.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// The shape of a site of a model; none: MuJoCo's default.
std::optional<robot::MujocoVolume> site_volume(const mjModel& model, std::size_t site);
/// Gives a site a shape; one that MuJoCo has no word or no size for is left as it is.
void set_site_volume(mjsSite& site, const robot::MujocoVolume& volume);

}  // namespace tenon::mjcf
