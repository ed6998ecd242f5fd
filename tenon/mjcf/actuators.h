// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/mjcf/bodies.h"
#include "tenon/mjcf/mjcf_source.h"
#include "tenon/mjcf/tendons.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// An actuator that is a spring and a damper about a joint.
struct JointDrive {
  robot::Index joint = 0;  ///< into BodyTree::joints
  robot::Drive drive;
  double effort_limit = robot::kUnlimited;  ///< [N m or N]
  double effort_of_control = 0;             ///< that one unit of its control makes [N m or N]

  /// The drive's target for the effort that `control` makes.
  double asked_for(double control) const;
};

/// What actuators of a model are in a robot.
struct Actuators {
  std::vector<std::optional<JointDrive>> drives;  ///< (nactuator), by MuJoCo's number
  std::vector<robot::MujocoActuator> motors;      ///< the others
  std::vector<int> motor_numbers;                 ///< (motor_count), MuJoCo's
};

/// Actuators that are neither are listed as skipped, as is the second drive of a joint.
Actuators read_actuators(MjcfSource& source, const BodyTree& tree, const Tendons& tendons);

/// Gives joints their drives.
void attach_drives(const Actuators& actuators, std::vector<robot::Joint>& joints);

}  // namespace tenon::mjcf
