// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/simulating/engine_choice.h"

#include <map>
#include <set>

#include "tenon/make_simulation.h"
#include "tenon/physics_selection.h"

namespace tenon {
namespace {

/// Engines by the first prim whose variant names each.
using NamedEngines = std::map<std::string, Path>;

NamedEngines named_engines(const stage::Stage& stage) {
  NamedEngines named;
  for (const stage::Prim& prim : prims_with_physics_set(stage)) {
    const std::string selected = prim.variant_selection("Physics");
    if (selected != "none" && !selected.empty()) {
      named.try_emplace(selected == "physx" ? "physx" : kUsualEngine, prim.path());
    }
  }
  return named;
}

/// How to get the engine where this build has none; "" where it has.
std::string missing(const std::string& engine) {
  const engines::EngineInfo info = engine_info(engine);
  return info.available ? "" : info.how_to_get;
}

Diagnostic warning(std::string rule, std::string message, const Path& prim, std::string fix) {
  return {Severity::Warning, std::move(rule), std::move(message), prim.str(), "", std::move(fix)};
}

}  // namespace

std::string choose_engine(const std::string& asked, const stage::Stage& stage,
                          Diagnostics& diagnostics) {
  if (!asked.empty()) {
    return asked;
  }
  const NamedEngines named = named_engines(stage);
  if (named.empty()) {
    return kUsualEngine;
  }
  if (named.size() > 1) {
    diagnostics.add(warning("sim.engines-mixed",
                            "variants of the asset name MuJoCo and PhysX; MuJoCo runs it",
                            named.at("physx"), "name the engine with --engine"));
    return kUsualEngine;
  }
  const auto& [engine, prim] = *named.begin();
  if (const std::string how_to_get = missing(engine); !how_to_get.empty()) {
    diagnostics.add(warning("sim.engine-fallback",
                            "the variant is for PhysX, which this build does not have; MuJoCo runs "
                            "it (check --for mujoco lists the differences)",
                            prim, how_to_get));
    return kUsualEngine;
  }
  return engine;
}

std::vector<std::string> available_engines() {
  std::vector<std::string> names;
  for (const engines::EngineInfo& info : list_engines()) {
    if (info.available) {
      names.push_back(info.name);
    }
  }
  return names;
}

Result<std::vector<std::string>> chosen_engines(const std::string& asked, const stage::Stage& stage,
                                                Diagnostics& diagnostics) {
  if (asked != "all") {
    return std::vector<std::string>{choose_engine(asked, stage, diagnostics)};
  }
  std::vector<std::string> names = available_engines();
  if (names.empty()) {
    return Error(ErrorCode::Missing, "this build has no engine")
        .with_rule("engine.missing")
        .with_fix("build it with an engine");
  }
  return names;
}

std::string own_variant(const std::string& engine, const stage::Stage& stage) {
  std::set<std::string> variants;
  for (const stage::Prim& prim : prims_with_physics_set(stage)) {
    for (const std::string& variant : prim.variant_names("Physics")) {
      variants.insert(variant);
    }
  }
  return variants.contains(engine) ? engine : variants.contains("physics") ? "physics" : "";
}

std::string select_own_variant(const std::string& engine, const stage::Stage& stage,
                               OpenOptions& open) {
  const bool chosen = !open.physics_variant.empty() || !open.physics_of.empty();
  const std::string own = chosen ? "" : own_variant(engine, stage);
  if (!own.empty()) {
    open.physics_variant = own;
    open.physics_below = true;
  }
  return open.physics_variant;
}

}  // namespace tenon
