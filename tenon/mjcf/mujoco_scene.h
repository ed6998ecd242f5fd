// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/mujoco_parts.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Gravity, time step and options; the converter decides what becomes of them.
robot::MujocoScene read_scene(MjcfSource& source);

}  // namespace tenon::mjcf
