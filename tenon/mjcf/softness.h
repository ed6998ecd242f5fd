// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// How contacts of a geom are made, where that is not what MuJoCo takes by itself.
robot::MujocoContact contact_of(const mjModel& model, int geom);

/// How soft the limit and the friction of a joint are, also where that is what MuJoCo takes by
/// itself: those of other assets are harder.
robot::MujocoSoftness softness_of(const mjModel& model, int joint);

}  // namespace tenon::mjcf
