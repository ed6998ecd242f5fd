// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/environments.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/world.h"
#include "tenon/scene/physics_scene.h"

/// The engines of this build, by name: the only place that knows them all.
namespace tenon {

/// The engines of this build, sorted by name; those not built are listed as not available.
std::vector<engines::EngineInfo> list_engines();
/// The one of that name; an empty row for unknown names.
engines::EngineInfo engine_info(const std::string& engine);

/// A simulation of `scene` (which must outlive it) on the engine of that name.
Result<std::unique_ptr<engines::Simulation>> make_simulation(
    const std::string& engine, const scene::PhysicsScene& scene,
    const engines::SimulationOptions& options, Diagnostics& diagnostics);

/// The same as a value, without virtual functions in its interface.
Result<engines::World> make_world(const std::string& engine, const scene::PhysicsScene& scene,
                                  const engines::SimulationOptions& options,
                                  Diagnostics& diagnostics);

/// Many simulations of `scene` (which must outlive them), side by side on threads.
Result<engines::Environments> make_environments(const std::string& engine,
                                                const scene::PhysicsScene& scene,
                                                const engines::EnvironmentOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace tenon
