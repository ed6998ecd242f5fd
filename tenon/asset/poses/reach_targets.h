// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/poses/pose_asset.h"
#include "tenon/base/result.h"

/// Internal to pose_asset.cpp: what --ik and --rotation say.
namespace tenon {

/// Errors: those of pose_of_asset.
Result<std::vector<PlacedPrim>> reach_targets(const stage::Stage& stage,
                                              const scene::PhysicsScene& scene,
                                              const PoseRequest& request);

}  // namespace tenon
