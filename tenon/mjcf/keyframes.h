// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/mjcf/actuators.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// States of the model. Hinges and slides count from where the bodies stand as written; controls
/// are in the order of the actuators' prims: those of drives by joint, without joints that follow
/// others, then motors.
std::vector<robot::MujocoKeyframe> read_keyframes(MjcfSource& source, const Actuators& actuators,
                                                  const std::vector<robot::Joint>& joints);

}  // namespace tenon::mjcf
