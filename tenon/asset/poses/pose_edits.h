// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/asset/poses/pose_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"

/// Named poses as edits of the file that owns what the asset is as a robot.
namespace tenon {

/// The robot that keeps poses: the prim at `robot`, else the only one with IsaacRobotAPI, else the
/// default prim. Errors: NotFound, Invalid (pose.no-robot).
Result<Path> robot_of_poses(const PoseOfAsset& pose, const std::string& robot);

/// The posture as a named pose of a robot: its joints with one degree of freedom, of trees,
/// followers of mimics included. What inverse kinematics brought to its place is the end link.
/// Errors: Invalid (edit.bad-name, pose.no-joints). Diagnostics: "pose.skipped-joint" for joints
/// with several degrees of freedom that are away from the start, which the schema has no values
/// for, and "pose.outside-limits" for joints beyond limits, which make the pose not valid.
Result<physics::NamedPose> pose_to_save(const PoseOfAsset& pose, const Path& robot,
                                        const std::string& name, Diagnostics& diagnostics);

/// Writes the pose, over one of the same name; none where it says the same already. A robot without
/// IsaacRobotAPI gets it, with its links and joints in kinematic order. Errors: Invalid
/// (pose.no-pose) where another prim has the name.
Result<std::vector<AssetEdit>> save_edits(const PoseOfAsset& pose, const Path& robot,
                                          const std::vector<physics::NamedPose>& saved);
/// `request` is OLD=NEW. Errors: those of named_pose (start_pose.h); Invalid (edit.bad-name,
/// edit.bad-argument, pose.has-it-already).
Result<std::vector<AssetEdit>> rename_edits(const PoseOfAsset& pose, const std::string& request);
/// The scope goes with its last pose. Errors: those of named_pose.
Result<std::vector<AssetEdit>> removal_edits(const PoseOfAsset& pose,
                                             const std::vector<std::string>& names);

}  // namespace tenon
