// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// Joints as controllers see them, for configurations of other programs.
namespace tenon {

/// A joint with one degree of freedom. Numbers are SI, per radian or metre; infinite: no limit.
struct JointMotor {
  Path path;
  std::string prim;  ///< name of the prim, by which simulators of USD know it
  std::string name;  ///< of the description: the display name where there is one
  bool angular = true;
  bool driven = false;
  bool per_inertia = false;  ///< its drive's gains are for each unit of inertia: not in this row
  double stiffness = 0;
  double damping = 0;
  double effort_limit = scene::kUnlimited;
  double velocity_limit = scene::kUnlimited;
  double armature = 0;
  double friction = 0;         ///< Coulomb
  double passive_damping = 0;  ///< beside the drive's
  double lower = -scene::kUnlimited;
  double upper = scene::kUnlimited;
  double start = 0;                   ///< coordinate
  double target = 0;                  ///< of the drive
  std::optional<std::size_t> leader;  ///< into the list: the joint that it follows
  double multiplier = 1;
  double offset = 0;
};

/// The joints of trees of `scene` with one degree of freedom, in the order of the scene. What a
/// configuration cannot say goes to `diagnostics` under `rule` with the prim: joints of several
/// axes, drives of acceleration, and those of another form than stiffness and damping.
std::vector<JointMotor> joint_motors(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                     const std::string& rule, const std::string& format,
                                     Diagnostics& diagnostics);

/// The display name of a prim, by which descriptions know it; else its own.
std::string shown_name(const stage::Stage& stage, Path path);

/// Joints with equal numbers, to be given by one row each.
struct MotorGroup {
  std::string name;                 ///< once in the list: what the joints' names begin with
  std::vector<std::size_t> motors;  ///< into the list
};
/// In order of their first joints; followers, driven and passive joints are apart.
std::vector<MotorGroup> motor_groups(const std::vector<JointMotor>& motors);

/// "name_a" and so on as a name of Python: letters, digits and '_', no digit in front.
std::string python_name(const std::string& text);
/// A text in double quotes of Python.
std::string python_text(const std::string& text);

}  // namespace tenon
