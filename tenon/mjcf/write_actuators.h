// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/mujoco_actuators.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Adds to the spec of a scene's model the actuators, named after their prims, and compiles it. The
/// model has no drives of these actuators. Actuators without a target and those that MuJoCo refuses
/// are skipped and listed. -> the elements, nullptr for each that is missing (actuator_count).
/// Errors: those of MuJoCo.
Result<std::vector<mjsActuator*>> write_actuators(
    const scene::PhysicsScene& scene, const std::vector<scene::MujocoActuator>& actuators,
    const engines::mujoco::Model& model, mjSpec& spec, Diagnostics& diagnostics);

/// One finding about a prim that is skipped, or a part of it.
void report_left_out(Diagnostics& diagnostics, const Path& prim, const char* property,
                     std::string message);

}  // namespace tenon::mjcf
