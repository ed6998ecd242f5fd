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

namespace tenon::urdf {

struct UrdfOptions {
  /// Folders of ROS packages by name. Packages not named here are looked for upward from the
  /// description: a folder of that name, or one with a package.xml that says so.
  std::map<std::string, std::string> packages;
  /// Folders in which packages are looked for after that.
  std::vector<std::string> search_paths;
  /// What may be read: found packages and folders of meshes join in.
  bytes::ReadPolicy reading;
};

/// Reads a robot description (URDF, ROS's format; version 1.0 with the capsules of 1.2). Everything
/// that it does not take over goes to `diagnostics` with line and element: extensions for
/// simulators (gazebo, transmission, mujoco, ros2_control), unknown elements and attributes, meshes
/// that cannot be found or lie outside of what may be read. The model is not checked for being a
/// tree (robot/kinematic_tree.h). Errors, with file and line: NotFound, Io, Parse for broken XML,
/// numbers that are none and missing attributes, Unsupported for xacro, SDF and MJCF.
Result<robot::RobotModel> read_urdf(const std::string& path, const UrdfOptions& options,
                                    Diagnostics& diagnostics);
/// The same for text at hand; `path` names it in messages, meshes are looked for beside it.
Result<robot::RobotModel> read_urdf_text(std::string_view text, const std::string& path,
                                         const UrdfOptions& options, Diagnostics& diagnostics);

}  // namespace tenon::urdf
