// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/parts_json.h"

#include <algorithm>

#include "tenon/approximate/mesh_approximator.h"
#include "tenon/asset/viewing/page_place.h"
#include "tenon/browser/browser_page.h"
#include "tenon/guard/workers.h"
#include "tenon/make_simulation.h"
#include "tenon/tuning/optimizer.h"

namespace tenon {
namespace {

using answers::Json;

/// What the worker says of itself; not available: why.
Result<guard::AboutWorker> about_worker() {
  guard::Workers workers;
  Diagnostics none;
  return guard::read_guarded<guard::AboutWorker>(workers, {guard::Reader::About, "", {}}, none);
}

/// Which searches gains.
approximate::LibraryInfo optimizer_library() {
  approximate::LibraryInfo info;
  info.name = "nlopt";
  info.version = tuning::optimizer_version();
  info.available = !info.version.empty();
  info.how_to_get = info.available ? "" : "install libnlopt0 to search gains of drives";
  return info;
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

/// What `tenon view` needs beyond the program.
OptionalPart viewer_part() {
  OptionalPart part;
  part.name = "view";
  const auto page = page_folder();
  part.available = TENON_WITH_VIEW && page.has_value();
  if (part.available) {
    part.version = "page and server";
  } else if (!TENON_WITH_VIEW) {
    part.how_to_get = "install libboost-dev and build tenon again to look at assets in the browser";
  } else {
    part.how_to_get = page.error().message() + "; " + page.error().diagnostic().fix;
  }
  return part;
}

/// What draws for `tenon record`.
OptionalPart browser_part() {
  OptionalPart part;
  part.name = "browser";
  const auto program = browser::find_browser("");
  const auto page = page_folder();
  part.available = program && page;
  if (part.available) {
    part.version = *program;
  } else {
    const Error& error = program ? page.error() : program.error();
    part.how_to_get = error.message() + "; " + error.diagnostic().fix;
  }
  return part;
}

template <class Info>
OptionalPart part_of(const Info& info) {
  return {info.name, info.available, info.available ? info.version : "",
          info.available ? "" : info.how_to_get};
}

Json list_of(const std::vector<OptionalPart>& parts) {
  Json list = Json::array();
  for (const OptionalPart& part : parts) {
    list.push_back({{"name", part.name},
                    {"available", part.available},
                    {"version", part.available ? Json(part.version) : Json(nullptr)},
                    {"howToGet", part.available ? Json(nullptr) : Json(part.how_to_get)}});
  }
  return list;
}

}  // namespace

bool OptionalParts::has_all_engines() const {
  return std::all_of(engines.begin(), engines.end(),
                     [](const OptionalPart& part) { return part.available; });
}

OptionalParts optional_parts() {
  OptionalParts parts;
  for (const engines::EngineInfo& engine : list_engines()) {
    parts.engines.push_back(part_of(engine));
  }
  const Result<guard::AboutWorker> worker = about_worker();
  for (const approximate::LibraryInfo& library :
       {approximate::decomposition_library(), approximate::simplification_library(),
        optimizer_library(), mesh_library(worker), worker_program(worker)}) {
    parts.libraries.push_back(part_of(library));
  }
  parts.libraries.push_back(viewer_part());
  parts.libraries.push_back(browser_part());
  return parts;
}

Json parts_json(const OptionalParts& parts) {
  return {{"engines", list_of(parts.engines)}, {"libraries", list_of(parts.libraries)}};
}

}  // namespace tenon
