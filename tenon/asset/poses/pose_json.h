// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/asset/poses/pose_asset.h"

namespace tenon {

/// The named poses that the asset keeps: {"poses": [{"name", "path", "robot", "startLink",
/// "endLink", "valid", "joints": [..]}]}. A joint has "joint", "dof" (null where it has not one),
/// "value" in rad or m as the asset has it, "lower" and "upper" (null: unlimited), "fixed",
/// "follows" (null or the leader), and "problem": null, "missing" or "outside".
answers::Json named_poses_json(const PoseOfAsset& pose);
/// The same of one pose, at "pose".
answers::Json named_pose_json(const PoseOfAsset& pose, const physics::NamedPose& named);
/// The posture itself, {"joints": [..]} as above, and with inverse kinematics "reach": {"reached",
/// "obstacle", "starts", "seed", "targets": [{"prim", "position", "at", "distance", "angle"}],
/// "atLimits": [{"joint", "dof", "bound"}]} [m, rad].
answers::Json posture_json(const PoseOfAsset& pose);

}  // namespace tenon
