// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/poses/pose_asset.h"
#include "tenon/base/result.h"

/// Internal to assets: prims on bodies, and what --ik and --rotation say of them.
namespace tenon {

/// Errors: those of pose_of_asset.
Result<std::vector<PlacedPrim>> reach_targets(const stage::Stage& stage,
                                              const scene::PhysicsScene& scene,
                                              const PoseRequest& request);

/// The prim that a text names, by its path or by the name of a body, where it is on a body; no
/// place is given. Errors: NotFound (pose.no-frame).
Result<PlacedPrim> placed_prim(const stage::Stage& stage, const scene::PhysicsScene& scene,
                               const std::string& text);

}  // namespace tenon
