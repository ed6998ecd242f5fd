// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Gives joints the drives that the options ask for, and lets joints that follow a follower follow
/// its leader. Reports gains of joints that are not there, and joints whose limits exclude 0
/// ("convert.outside-limits"); with StartPose::Valid their drives get a target inside.
void prepare_joints(const ConvertOptions& options, robot::RobotModel& model,
                    Diagnostics& diagnostics);

/// The coordinate [rad or m] at which a joint starts; `leader` is the one that it follows, or null.
double start_of(const robot::Joint& joint, const robot::Joint* leader, StartPose pose);
/// The pose of the joint's child in its parent there.
Pose start_in_parent(const robot::RobotModel& model, const robot::Joint& joint, StartPose pose);

}  // namespace tenon::convert
