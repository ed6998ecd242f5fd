// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// The PhysX adapter: PhysicsScene -> PxScene with rigid bodies, articulations and joints, stepped
/// and read back.
namespace tenon::engines::physx {

/// Name "physx" and the version of the loaded library.
EngineInfo info();

/// A simulation of `scene`, which must outlive it. Errors: Missing without the library, Invalid
/// with PhysX's own words when it rejects the model.
Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics);

}  // namespace tenon::engines::physx
