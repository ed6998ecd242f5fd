// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Gives joints the drives that the options ask for, and lets joints that follow a follower follow
/// its leader. Reports gains of joints that are not there.
void prepare_joints(const ConvertOptions& options, robot::RobotModel& model,
                    Diagnostics& diagnostics);

}  // namespace tenon::convert
