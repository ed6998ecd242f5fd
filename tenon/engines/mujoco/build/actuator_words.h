// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/mujoco_parts.h"

namespace tenon::engines::mujoco {

/// Kinds of gain, bias and dynamics by the schema's tokens; false where MuJoCo has no such kind.
bool set_actuator_kinds(const scene::MujocoActuator& from, mjsActuator& to);
/// All that MuJoCo's actuators have but what they act on.
void set_actuator_numbers(const scene::MujocoActuator& from, mjsActuator& to);

}  // namespace tenon::engines::mujoco
