// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/engines.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// The Jolt adapter: PhysicsScene -> JPH::PhysicsSystem with bodies and constraints between them,
/// stepped and read back.
namespace tenon::engines::jolt {

/// Name "jolt" and the version that is linked.
EngineInfo info();

/// A simulation of `scene`, which must outlive it. Errors: Unsupported for methods that Jolt does
/// not have, Invalid where it rejects the model.
Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics);

}  // namespace tenon::engines::jolt
