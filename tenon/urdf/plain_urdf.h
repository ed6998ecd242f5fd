// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/robot/robot_model.h"

namespace tenon::urdf {

/// Means "no limit" where URDF asks for a number, as other readers take 0 for a limit of 0.
/// In N, N m, m, rad, m/s or rad/s; a limit that is read and is not below it counts as none.
inline constexpr double kNoUrdfLimit = 1e9;

/// Puts what every reader of URDF knows in the place of what only some do, and says so: a capsule
/// becomes a cylinder and two spheres, which together are it; a ball becomes three hinges on links
/// of almost no mass; a slide or hinge of a range without an end gets one far away, and a joint
/// without a limit of effort or speed kNoUrdfLimit. Parts that are new come after those that are
/// there.
void make_plain(robot::RobotModel& model, Diagnostics& diagnostics);

}  // namespace tenon::urdf
