// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/answers/parts_json.h"

namespace tenon::cli {
namespace {

int run_doctor(const Globals& globals) {
  Report report(globals, "doctor", "");
  const OptionalParts parts = optional_parts();
  for (const auto* list : {&parts.engines, &parts.libraries}) {
    for (const OptionalPart& part : *list) {
      if (!report.json()) {
        print("%-13s %-14s %s\n", part.name.c_str(),
              part.available ? part.version.c_str() : "not available", part.how_to_get.c_str());
      }
    }
  }
  return report.finish(parts.has_all_engines() ? kOk : kMissing, parts_json(parts));
}

}  // namespace

void add_doctor(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "doctor", "Engines and optional parts: found, missing, how to get them");
  verb.footer("Example:\n  tenon doctor --json");
  choose(verb, chosen, [&globals] { return run_doctor(globals); });
}

}  // namespace tenon::cli
