// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/approximate/mesh_approximator.h"
#include "tenon/guard/workers.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

/// What the worker says of itself; not available: why.
Result<guard::AboutWorker> about_worker() {
  guard::Workers workers;
  Diagnostics none;
  return guard::read_guarded<guard::AboutWorker>(workers, {guard::Reader::About, "", {}}, none);
}

/// Which reads meshes in .dae, .gltf and .glb.
approximate::LibraryInfo mesh_library(const Result<guard::AboutWorker>& worker) {
  approximate::LibraryInfo info;
  info.name = "assimp";
  info.available = worker && !worker->assimp.empty();
  info.version = info.available ? worker->assimp : "";
  info.how_to_get = info.available ? "" : "install libassimp5 to read meshes in Collada and glTF";
  return info;
}

/// The process that reads formats of others, and what holds it.
approximate::LibraryInfo worker_program(const Result<guard::AboutWorker>& worker) {
  approximate::LibraryInfo info;
  info.name = "worker";
  info.available = worker.has_value();
  if (!worker) {
    info.how_to_get = worker.error().message() + "; " + worker.error().diagnostic().fix;
    return info;
  }
  const guard::Confinement& held = worker->confinement;
  info.version = held.memory ? "memory" : "memory (watched)";
  info.version += ", time";
  if (held.landlock > 0) {
    info.version += ", Landlock " + std::to_string(held.landlock);
  }
  info.version += held.system_calls ? ", seccomp" : "";
  info.version += held.no_new_privileges ? ", no new privileges" : "";
  return info;
}

/// One part, an engine or a library: its row, printed as text where that is asked for.
template <class Info>
Json listed(const Info& part, const Globals& globals) {
  const std::string how_to_get = part.available ? "" : part.how_to_get;
  if (!globals.json) {
    print("%-13s %-14s %s\n", part.name.c_str(),
          part.available ? part.version.c_str() : "not available", how_to_get.c_str());
  }
  return {{"name", part.name},
          {"available", part.available},
          {"version", part.available ? Json(part.version) : Json(nullptr)},
          {"howToGet", part.available ? Json(nullptr) : Json(how_to_get)}};
}

int run_doctor(const Globals& globals) {
  Report report(globals, "doctor", "");
  Json engines = Json::array();
  bool all = true;
  for (const engines::EngineInfo& engine : list_engines()) {
    all = all && engine.available;
    engines.push_back(listed(engine, globals));
  }
  Json libraries = Json::array();
  const Result<guard::AboutWorker> worker = about_worker();
  for (const approximate::LibraryInfo& library :
       {approximate::decomposition_library(), approximate::simplification_library(),
        mesh_library(worker), worker_program(worker)}) {
    libraries.push_back(listed(library, globals));
  }
  return report.finish(all ? kOk : kMissing, {{"engines", engines}, {"libraries", libraries}});
}

}  // namespace

void add_doctor(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "doctor", "Engines and optional parts: found, missing, how to get them");
  verb.footer("Example:\n  tenon doctor --json");
  choose(verb, chosen, [&globals] { return run_doctor(globals); });
}

}  // namespace tenon::cli
