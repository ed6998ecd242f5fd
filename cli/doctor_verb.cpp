// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/approximate/mesh_approximator.h"
#include "tenon/mesh/read_mesh.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

/// Which reads meshes in .dae, .gltf and .glb.
approximate::LibraryInfo mesh_library() {
  approximate::LibraryInfo info;
  info.name = "assimp";
  info.available = mesh::has_assimp();
  info.version = info.available ? mesh::assimp_version() : "";
  info.how_to_get = info.available ? "" : "install libassimp5 to read meshes in Collada and glTF";
  return info;
}

int run_doctor(const Globals& globals) {
  Report report(globals, "doctor", "");
  Json engines = Json::array();
  bool all = true;
  for (const engines::EngineInfo& engine : list_engines()) {
    all = all && engine.available;
    engines.push_back({{"name", engine.name},
                       {"available", engine.available},
                       {"version", engine.available ? Json(engine.version) : Json(nullptr)},
                       {"howToGet", engine.available ? Json(nullptr) : Json(engine.how_to_get)}});
    if (!globals.json) {
      std::printf("%-8s %-14s %s\n", engine.name.c_str(),
                  engine.available ? engine.version.c_str() : "not available",
                  engine.available ? "" : engine.how_to_get.c_str());
    }
  }
  Json libraries = Json::array();
  for (const approximate::LibraryInfo& library :
       {approximate::decomposition_library(), mesh_library()}) {
    libraries.push_back(
        {{"name", library.name},
         {"available", library.available},
         {"version", library.available ? Json(library.version) : Json(nullptr)},
         {"howToGet", library.available ? Json(nullptr) : Json(library.how_to_get)}});
    if (!globals.json) {
      std::printf("%-8s %-14s %s\n", library.name.c_str(),
                  library.available ? library.version.c_str() : "not available",
                  library.how_to_get.c_str());
    }
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
