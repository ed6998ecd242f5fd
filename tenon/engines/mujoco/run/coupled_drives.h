// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/model.h"

/// Drives that MuJoCo's solver takes together with loops and mimics.
///
/// A drive that pulls to where the step ends, k (x* - q - v' dt) + d (v* - v') with v' = v + a dt,
/// is D (a0 - a) with D = (d + k dt) dt: a constraint of MuJoCo that is as soft as 1 / D and wants
/// the acceleration a0. Dry friction is one whose force is bounded, as that of a drive is. So the
/// joint has a tendon of its own with friction, and its row is given these numbers in each step.
/// The actuator stays where gains, targets and the largest force are kept; it exerts nothing by
/// itself, and has the force of the row in its place after the step.
namespace tenon::engines::mujoco {

/// Switches the actuator off and the friction of the tendon on.
void couple_drive(const DriveMap& drive, mjModel& model);

/// Between mj_step1 and mj_step2.
void write_coupled_drives(const Model& model);
/// Behind mj_step2, or what made accelerations.
void read_coupled_drives(const Model& model);

/// mj_forward with coupled drives.
void forward(const Model& model);

}  // namespace tenon::engines::mujoco
