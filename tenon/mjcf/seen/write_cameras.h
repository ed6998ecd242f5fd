// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/robot/robot_model.h"
#include "tenon/scene/physics_scene.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Adds cameras and lights to bodies: those of `seen`, which has a link for each body of the scene
/// and one more for the world. What MuJoCo does not support is reported as "mjcf.left-out".
void write_cameras_and_lights(const robot::RobotModel& seen, const scene::PhysicsScene& scene,
                              const engines::mujoco::Model& model, mjSpec& spec,
                              Diagnostics& diagnostics);

}  // namespace tenon::mjcf
