// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/mujoco_engine.h"

#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/mujoco/set_up/set_const_groups.h"

namespace tenon::engines::mujoco {

EngineInfo info() {
  const Result<void> opened = open_mujoco();
  if (!opened) {
    return {"mujoco", "", false, opened.error().diagnostic().fix};
  }
  return {"mujoco", mj_versionString(), true, "", set_up_per_pair()};
}

Result<std::unique_ptr<Simulation>> make_simulation(const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics) {
  TENON_TRY(auto simulation, MujocoSimulation::make(scene, options, diagnostics));
  return std::unique_ptr<Simulation>(std::move(simulation));
}

Result<std::vector<std::unique_ptr<Simulation>>> make_simulations(const scene::PhysicsScene& scene,
                                                                  const SimulationOptions& options,
                                                                  std::size_t count,
                                                                  Diagnostics& diagnostics) {
  TENON_TRY(auto first, MujocoSimulation::make(scene, options, diagnostics, count));
  std::vector<std::unique_ptr<Simulation>> made;
  for (std::size_t i = 1; i < count; ++i) {
    TENON_TRY(auto next, first->another());
    made.push_back(std::move(next));
  }
  made.insert(made.begin(), std::move(first));
  return made;
}

}  // namespace tenon::engines::mujoco
