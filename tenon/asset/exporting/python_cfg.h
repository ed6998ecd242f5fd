// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/exporting/joint_motors.h"
#include "tenon/asset/exporting/pose_values.h"
#include "tenon/math/transform.h"

/// Python files that configure a robot for a program that trains policies.
namespace tenon {

/// What such a file is made of.
struct RobotCfg {
  std::string name;     ///< of the robot
  std::string file;     ///< the asset or the model, relative to the Python file
  std::string variant;  ///< of the set "Physics"; empty: the default
  Pose root;            ///< of the root link where nothing holds it [m]
  std::vector<JointMotor> motors;
  std::vector<PoseValues> poses;      ///< that the asset keeps by name
  std::vector<std::string> left_out;  ///< what the configuration cannot say, a sentence each
};

/// Isaac Lab 2 and 3: NAME_CFG, an ArticulationCfg with implicit actuators by group. Joints have
/// the names of their prims.
std::string isaaclab_cfg(const RobotCfg& robot);

/// mjlab: NAME_CFG, an EntityCfg whose actuators are those of the MJCF file. Joints have the names
/// of the description.
std::string mjlab_cfg(const RobotCfg& robot);

}  // namespace tenon
