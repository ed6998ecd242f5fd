// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/mujoco_library.h"

namespace tenon::engines::mujoco {

/// What MuJoCo computes of a model from its inertia where it begins: dof_M0, body_invweight0,
/// dof_invweight0, tendon_invweight0 and actuator_acc0, in time that grows with the number of
/// bodies; MuJoCo's own grows with its square. `data` has kinematics, tendons and transmissions in
/// qpos0, and gets the inertia matrix and its factor. False, and nothing written: the model has
/// what is not dealt with here (flexes, armature of tendons and actuators, motion without inertia).
bool set_inverse_weights(mjModel& model, mjData& data);

}  // namespace tenon::engines::mujoco
