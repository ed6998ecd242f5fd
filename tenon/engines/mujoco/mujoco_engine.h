// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// The MuJoCo adapter: PhysicsScene -> mjSpec -> mjModel and mjData, stepped and read back.
namespace tenon::engines::mujoco {

/// Name "mujoco" and the version of the loaded library.
EngineInfo info();

/// A simulation of `scene`, which must outlive it. Errors: Invalid with MuJoCo's own words when it
/// rejects the model, Limit when the scene is too large.
Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics);

/// `count` simulations of one compiled model, which each shares until it is given values of its
/// own. Errors as above.
Result<std::vector<std::unique_ptr<Simulation>>> make_simulations(const scene::PhysicsScene& scene,
                                                                  const SimulationOptions& options,
                                                                  std::size_t count,
                                                                  Diagnostics& diagnostics);

}  // namespace tenon::engines::mujoco
