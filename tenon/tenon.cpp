// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/tenon.h"

#include <span>

#include "tenon/engines/engines.h"
#if TENON_WITH_MUJOCO
#include "tenon/engines/mujoco/mujoco_engine.h"
#endif

namespace tenon {
namespace {

std::span<const engines::Engine> built_engines() {
#if TENON_WITH_MUJOCO
  static constexpr engines::Engine kBuilt[] = {
      {engines::mujoco::info, engines::mujoco::make_simulation}};
  return kBuilt;
#else
  return {};
#endif
}

}  // namespace

std::vector<engines::EngineInfo> list_engines() { return engines::list_engines(built_engines()); }

Result<std::unique_ptr<engines::Simulation>> make_simulation(
    const std::string& engine, const scene::PhysicsScene& scene,
    const engines::SimulationOptions& options, Diagnostics& diagnostics) {
  return engines::make_simulation(built_engines(), engine, scene, options, diagnostics);
}

}  // namespace tenon
