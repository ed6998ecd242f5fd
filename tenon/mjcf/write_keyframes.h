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

/// Adds keyframes to the spec of a scene's model, in its order of bodies, joints and actuators;
/// `made` are those that write_actuators added. Keyframes have a coordinate for each joint that
/// moves bodies, down the tree and, side by side, in the order of the stage: that of MuJoCo where
/// the asset was made from a model of it. Bodies that move freely have the pose of their prim [m in
/// the world; real part first], joints count from where their frames meet [m or rad]. Lists of
/// another length are skipped and listed. Errors: those of MuJoCo.
Result<void> write_keyframes(const scene::PhysicsScene& scene, const scene::MujocoParts& parts,
                             const std::vector<mjsActuator*>& made,
                             const engines::mujoco::Model& model, mjSpec& spec,
                             Diagnostics& diagnostics);

}  // namespace tenon::mjcf
