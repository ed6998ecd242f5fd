// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/approximate/mesh_approximator.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

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
  const approximate::LibraryInfo pieces = approximate::decomposition_library();
  if (!globals.json) {
    std::printf("%-8s %-14s %s\n", pieces.name.c_str(),
                pieces.available ? pieces.version.c_str() : "not available",
                pieces.how_to_get.c_str());
  }
  const Json libraries{{{"name", pieces.name},
                        {"available", pieces.available},
                        {"version", pieces.available ? Json(pieces.version) : Json(nullptr)},
                        {"howToGet", pieces.available ? Json(nullptr) : Json(pieces.how_to_get)}}};
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
