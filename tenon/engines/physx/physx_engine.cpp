// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/physx_engine.h"

#include "tenon/engines/physx/physx_library.h"
#include "tenon/engines/physx/physx_simulation.h"

namespace tenon::engines::physx {

EngineInfo info() {
  const Result<const Runtime*> opened = open_physx();
  if (!opened) {
    return {"physx", "", false, opened.error().diagnostic().fix};
  }
  return {"physx", physx_version(), true, ""};
}

Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics) {
  TENON_TRY(auto simulation, PhysxSimulation::make(scene, options, diagnostics));
  return std::unique_ptr<Simulation>(std::move(simulation));
}

}  // namespace tenon::engines::physx
