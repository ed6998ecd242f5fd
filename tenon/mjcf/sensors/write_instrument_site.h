// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/physics_scene.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Where a sensor with a body measures, in MuJoCo's frame of that body [m]; of Rays with one ray:
/// at its origin, with z along it.
Pose instrument_pose(const engines::mujoco::Model& model, const scene::Sensor& sensor);

/// The name of the site there, that of the sensor's prim; it is made where the spec has none. Of
/// Contact it is the sphere in which contacts count.
std::string instrument_site(const scene::PhysicsScene& scene, const engines::mujoco::Model& model,
                            mjSpec& spec, const scene::Sensor& sensor);

}  // namespace tenon::mjcf
