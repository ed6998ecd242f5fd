// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/exporting/joint_motors.h"

namespace tenon {

/// The hardware that the block names, which moves joints where they are told to.
inline constexpr const char* kMockHardware = "mock_components/GenericSystem";

/// A <ros2_control> element of type "system" for a robot's joints, for its URDF: a joint
/// with stiffness is commanded by position within its limits, one with damping alone by velocity
/// within its limit, and one without a drive by effort within its own. Every joint tells position
/// and velocity, commanded ones effort too. Followers have no command and mimic="true", as URDF
/// says what they follow. Start positions are initial values.
std::string ros2_control_block(const std::string& robot, const std::vector<JointMotor>& motors);

}  // namespace tenon
