// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/physics/readings.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::physics {

/// A collision group as authored, before groups are merged.
struct AuthoredGroup {
  std::vector<Index> filtered;  ///< groups that it names
  bool inverted = false;        ///< collides only with those that it names
  std::string merge;            ///< groups of equal non-empty names are one
};

/// Which pairs of groups do not touch, from what each says (S-77..S-80): (group_count x
/// group_count) and whether each touches ungrouped colliders.
struct GroupTable {
  std::vector<char> pair_off;
  std::vector<char> ungrouped_off;
};
GroupTable group_table(const std::vector<AuthoredGroup>& groups,
                       Ungrouped ungrouped = Ungrouped::Off);

}  // namespace tenon::physics
