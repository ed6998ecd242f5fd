// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/asset/poses/pose_asset.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"

/// Files of named poses, in the form that Isaac Sim's robot poser writes and reads: JSON with
/// "_meta" and "poses", in which revolute joints are in radians unless "_meta" says degrees.
namespace tenon {

/// All poses that the asset keeps, in radians and units of the stage. Joints that are not there are
/// skipped.
std::string poses_file(const PoseOfAsset& pose);

/// The poses of a file as poses of a robot of the asset. Errors: those of reading it; Parse
/// (pose.file) for other contents, NotFound (pose.joint-missing) for joints that are not there,
/// Invalid (edit.bad-name).
Result<std::vector<physics::NamedPose>> read_poses_file(const PoseOfAsset& pose, const Path& robot,
                                                        const std::string& file,
                                                        const bytes::Files& files);
/// The same of the text of such a file. Errors: those of its contents.
Result<std::vector<physics::NamedPose>> poses_of_text(const PoseOfAsset& pose, const Path& robot,
                                                      std::string_view text);

}  // namespace tenon
