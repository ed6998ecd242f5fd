// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::mujoco {

/// The model that would be simulated, as text in MuJoCo's own format; meshes are inline, the state
/// is that of the start. The time step is that of the scene, undivided; where the scene has
/// MjcSceneAPI, so are all options and flags, with MuJoCo's defaults for the others. What MuJoCo
/// does not support goes to `diagnostics`, each named "mujoco.not-mapped": a Warning where runs of
/// this program do it from step to step, else an Info. Averaged friction of two materials is
/// computed at run time and not included. Errors: those of making a model.
Result<std::string> write_mjcf(const scene::PhysicsScene& scene, const SimulationOptions& options,
                               Diagnostics& diagnostics);

}  // namespace tenon::engines::mujoco
