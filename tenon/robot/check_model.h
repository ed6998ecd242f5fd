// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/robot/robot_model.h"

namespace tenon::robot {

/// Whether a model that comes from another process is one: every index names something, lists that
/// belong together are of one length. What a well-meant description can have wrong is for
/// kinematic_tree and sanitize_model. Errors: Corrupt with the file and what is wrong.
Result<void> check_model(const RobotModel& model);

}  // namespace tenon::robot
