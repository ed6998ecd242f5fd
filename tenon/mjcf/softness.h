// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// How contacts of a geom are made, where that is not what MuJoCo takes by itself.
robot::MujocoContact contact_of(const mjModel& model, int geom);

/// How soft the limit of a joint is, also where that is what MuJoCo takes by itself: the limits of
/// other assets are harder. Of friction, what MuJoCo does not take by itself.
robot::MujocoSoftness softness_of(const mjModel& model, int joint);

}  // namespace tenon::mjcf
