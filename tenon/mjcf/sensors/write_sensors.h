// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/physics_scene.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// Adds to the spec of a scene's model its sensors except those that are `written`, by path, each
/// quantity as one of MuJoCo's. What MuJoCo does not support is listed.
void write_sensors(const scene::PhysicsScene& scene, const std::set<Path>& written,
                   const engines::mujoco::Model& model, mjSpec& spec, Diagnostics& diagnostics);

}  // namespace tenon::mjcf
