// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/convert/convert_robot.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Gives joints the armature and friction, and colliders the approximation, that the rules of
/// `options` have for their names, and puts rules of gains into `options.joint_gains`, where joints
/// named there keep theirs. Errors: NotFound "convert.no-match" for a pattern that matches none;
/// Invalid "name.bad-pattern".
Result<void> apply_rules(robot::RobotModel& model, ConvertOptions& options);

}  // namespace tenon::convert
