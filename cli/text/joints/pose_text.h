// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"

/// The answers of tenon/asset/poses/pose_json.h as text, angles in degrees and lengths in metres.
namespace tenon::cli {

/// A line for each named pose.
std::string named_poses_text(const answers::Json& poses);
/// One named pose, a line for each joint.
std::string named_pose_text(const answers::Json& pose);
/// The posture, and how near inverse kinematics came; `obstacle`: why not nearer.
std::string posture_text(const answers::Json& posture, const std::string& obstacle);
/// The second part of it alone.
std::string reach_text(const answers::Json& reach, const std::string& obstacle);

}  // namespace tenon::cli
