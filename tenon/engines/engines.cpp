// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/engines.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "tenon/engines/sensors.h"
#include "tenon/engines/start_pairs.h"

namespace tenon::engines {
namespace {

struct KnownEngine {
  std::string_view name;
  std::string_view how_to_get;
};

constexpr std::array<KnownEngine, 3> kKnownEngines{{
    {"jolt", "Build tenon with Jolt: make build ENGINES=all, or -DTENON_WITH_JOLT=ON."},
    {"mujoco", "Build tenon with -DTENON_WITH_MUJOCO=ON (the default of the presets)."},
    {"physx", "Build tenon with PhysX: make build ENGINES=all, or -DTENON_WITH_PHYSX=ON."},
}};

}  // namespace

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const KnownEngine& known : kKnownEngines) {
    names.emplace_back(known.name);
  }
  return names;
}

std::vector<EngineInfo> list_engines(std::span<const Engine> built) {
  std::vector<EngineInfo> infos;
  for (const Engine& engine : built) {
    infos.push_back(engine.info());
  }
  for (const KnownEngine& known : kKnownEngines) {
    const bool is_built = std::any_of(infos.begin(), infos.end(), [&](const EngineInfo& info) {
      return info.name == known.name;
    });
    if (!is_built) {
      infos.push_back({std::string(known.name), "", false, std::string(known.how_to_get)});
    }
  }
  std::sort(infos.begin(), infos.end(),
            [](const EngineInfo& a, const EngineInfo& b) { return a.name < b.name; });
  return infos;
}

Result<const Engine*> find_engine(std::span<const Engine> built, const std::string& engine) {
  for (const Engine& candidate : built) {
    if (candidate.info().name == engine) {
      return &candidate;
    }
  }
  std::string names;
  for (const EngineInfo& info : list_engines(built)) {
    if (info.name == engine) {
      return Error(ErrorCode::Missing, "the engine \"" + engine + "\" is not part of this build")
          .with_rule("engine.missing")
          .with_fix(info.how_to_get);
    }
    names += (names.empty() ? "" : ", ") + info.name;
  }
  return Error(ErrorCode::NotFound, "there is no engine \"" + engine + "\"; known are " + names)
      .with_rule("engine.unknown");
}

Result<std::unique_ptr<Simulation>> make_simulation(std::span<const Engine> built,
                                                    const std::string& engine,
                                                    const scene::PhysicsScene& scene,
                                                    const SimulationOptions& options,
                                                    Diagnostics& diagnostics) {
  TENON_TRY(const Engine* found, find_engine(built, engine));
  TENON_CHECK(check_start_pairs(scene));
  SimulationOptions all = options;
  all.outputs = with_needs_of_sensors(options.outputs, scene);
  return found->make(scene, all, diagnostics);
}

}  // namespace tenon::engines
