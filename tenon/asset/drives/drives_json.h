// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/asset/drives/drives_asset.h"

namespace tenon {

/// {"postures", "drives", "followers"}; a drive is {"joint", "dof", "type", "stiffness", "damping",
/// "maxEffort", "speedLimit", "weight", "weightAt", "inertia": [least, most], "tooWeak",
/// "followers", "newMaxEffort", "newSpeedLimit"}, SI; null: unlimited, not known, or not asked for.
/// A follower is {"joint", "leader", "multiplier", "naturalFrequency" [rad/s], "dampingRatio"}.
answers::Json drives_json(const DrivesOfAsset& found);

}  // namespace tenon
