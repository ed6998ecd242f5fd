// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tenon/mjcf/bodies.h"

namespace tenon::mjcf {

/// Pairs of links whose colliders do not touch each other: what the model excludes, and bodies and
/// what carries them where no joint says so.
std::vector<std::array<robot::Index, 2>> read_excluded_pairs(const mjModel& model,
                                                             const BodyTree& tree);

}  // namespace tenon::mjcf
