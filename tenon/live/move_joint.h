// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/result.h"
#include "tenon/live/live_asset.h"

namespace tenon::live {

/// Moves a joint by hand, and the joints that mimic it, and those that mimic them, each to where
/// its law has it; all rest then. `position` has a number for each coordinate [rad, m]. The asset
/// has a world. Errors: those of set_joint_state of the first joint; a follower that cannot be
/// moved stays.
Result<void> move_joint(LiveAsset& asset, scene::Index joint, const std::vector<double>& position);

}  // namespace tenon::live
