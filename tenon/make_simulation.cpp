// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

#include "tenon/make_simulation.h"

#include <iterator>
#include <span>
#include <utility>

#include "tenon/engines/engines.h"
#if TENON_WITH_JOLT
#include "tenon/engines/jolt/jolt_engine.h"
#endif
#if TENON_WITH_MUJOCO
#include "tenon/engines/mujoco/mujoco_engine.h"
#endif
#if TENON_WITH_PHYSX
#include "tenon/engines/physx/physx_engine.h"
#endif

namespace tenon {
namespace {

std::span<const engines::Engine> built_engines() {
  static constexpr engines::Engine kBuilt[] = {
#if TENON_WITH_MUJOCO
      {engines::mujoco::info, engines::mujoco::make_simulation, engines::mujoco::make_simulations},
#endif
#if TENON_WITH_PHYSX
      {engines::physx::info, engines::physx::make_simulation},
#endif
#if TENON_WITH_JOLT
      {engines::jolt::info, engines::jolt::make_simulation},
#endif
      {}};
  return std::span(kBuilt).first(std::size(kBuilt) - 1);
}

}  // namespace

std::vector<engines::EngineInfo> list_engines() { return engines::list_engines(built_engines()); }

engines::EngineInfo engine_info(const std::string& engine) {
  for (engines::EngineInfo& info : list_engines()) {
    if (info.name == engine) {
      return std::move(info);
    }
  }
  return {};
}

Result<std::unique_ptr<engines::Simulation>> make_simulation(
    const std::string& engine, const scene::PhysicsScene& scene,
    const engines::SimulationOptions& options, Diagnostics& diagnostics) {
  return engines::make_simulation(built_engines(), engine, scene, options, diagnostics);
}

Result<engines::World> make_world(const std::string& engine, const scene::PhysicsScene& scene,
                                  const engines::SimulationOptions& options,
                                  Diagnostics& diagnostics) {
  TENON_TRY(auto simulation, make_simulation(engine, scene, options, diagnostics));
  return engines::World::with_sensors(std::move(simulation), scene);
}

Result<engines::Environments> make_environments(const std::string& engine,
                                                const scene::PhysicsScene& scene,
                                                const engines::EnvironmentOptions& options,
                                                Diagnostics& diagnostics) {
  TENON_TRY(const engines::Engine* found, engines::find_engine(built_engines(), engine));
  return engines::Environments::make(*found, scene, options, diagnostics);
}

}  // namespace tenon
