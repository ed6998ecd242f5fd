// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/jolt_engine.h"

#include "tenon/engines/jolt/jolt_runtime.h"
#include "tenon/engines/jolt/jolt_simulation.h"

namespace tenon::engines::jolt {

EngineInfo info() { return {"jolt", jolt_version(), true, ""}; }

Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics) {
  TENON_TRY(auto simulation, JoltSimulation::make(scene, options, diagnostics));
  return std::unique_ptr<Simulation>(std::move(simulation));
}

}  // namespace tenon::engines::jolt
