// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines {

struct EngineInfo {
  std::string name;     ///< "mujoco"
  std::string version;  ///< of the library in use; empty when it is not available
  bool available = false;
  std::string how_to_get;  ///< one sentence, when it is not available
  /// Where building a model takes time that grows with the square of the number of bodies: that
  /// time by the square, on the machine of the benchmarks [s]; 0: it does not.
  double set_up_per_pair = 0;
};

/// What the adapter of one engine offers. The wiring (tenon/make_simulation.cpp) makes the table of
/// those that are built in; this folder knows none of them.
struct Engine {
  EngineInfo (*info)() = nullptr;
  Result<std::unique_ptr<Simulation>> (*make)(const scene::PhysicsScene& scene,
                                              const SimulationOptions& options,
                                              Diagnostics& diagnostics) = nullptr;
  /// Many of one scene, which may share what is the same in all; nullptr: made one by one.
  Result<std::vector<std::unique_ptr<Simulation>>> (*make_many)(const scene::PhysicsScene& scene,
                                                                const SimulationOptions& options,
                                                                std::size_t count,
                                                                Diagnostics& diagnostics) = nullptr;
};

/// Every engine that there is an adapter of, built in or not, sorted by name. Loads none of them.
std::vector<std::string> engine_names();

/// The built ones and the known ones that are not built, sorted by name.
std::vector<EngineInfo> list_engines(std::span<const Engine> built);

/// The built engine of that name. Errors: Missing when the engine is known but not built in,
/// NotFound for an unknown name.
Result<const Engine*> find_engine(std::span<const Engine> built, const std::string& engine);

/// Builds a model of the scene; the scene must outlive the simulation. Errors: those of
/// find_engine; Unsupported or Invalid when no model can be made.
Result<std::unique_ptr<Simulation>> make_simulation(std::span<const Engine> built,
                                                    const std::string& engine,
                                                    const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics);

}  // namespace tenon::engines
