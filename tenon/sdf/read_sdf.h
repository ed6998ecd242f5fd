// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/robot/robot_model.h"

/// Gazebo's and Drake's descriptions of models and worlds.
namespace tenon::sdf {

struct SdfOptions {
  /// Folders of models (model://NAME) and ROS packages by name. Others are looked for upward from
  /// the file that names them.
  std::map<std::string, std::string> packages;
  /// Folders in which models are looked for after that.
  std::vector<std::string> search_paths;
  /// What may be read: found models join in.
  bytes::ReadPolicy reading;
  /// The model of a world with several; empty: the only one.
  std::string model;
};

/// Reads one model of an SDFormat file, version 1.4 to 1.11, with the models that it nests and
/// includes: links by scoped names ("arm::hand"), frames as sites, joints in the frames that the
/// pose graph gives them. Where joints hold links to the world, or the model is static, or several
/// links are free, a link "world" is the root. A joint of two axes or a screw becomes two joints
/// with a link between. What is not taken over goes to `diagnostics` with line and element. Errors,
/// with file and line: NotFound, Io, Parse for broken XML, numbers that are none, names that nobody
/// has and poses in a cycle; Invalid for a world with several models and none chosen; Limit.
Result<robot::RobotModel> read_sdf_text(std::string_view text, const std::string& path,
                                        const SdfOptions& options, Diagnostics& diagnostics);

}  // namespace tenon::sdf
