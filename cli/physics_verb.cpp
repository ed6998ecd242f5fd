// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/physics_json.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/physics/read_physics.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct Options {
  AssetArguments asset;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
};

Result<physics::Readings> chosen_readings(const std::vector<std::string>& assignments) {
  physics::Readings readings;
  for (const std::string& text : assignments) {
    TENON_TRY(const auto pair, split_assignment(text));
    TENON_CHECK(physics::set_reading(readings, pair.first, pair.second));
  }
  return readings;
}

int run_physics(const Globals& globals, const Options& options) {
  Report report(globals, "physics", options.asset.asset);
  auto readings = chosen_readings(options.readings);
  if (!readings) {
    return report.fail(readings.error());
  }
  auto stage = open_stage(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  physics::ReadOptions read;
  read.readings = *readings;
  const physics::PhysicsScene scene = physics::read_physics(*stage, read, report.diagnostics);
  if (!globals.json) {
    std::fputs(physics_text(scene).c_str(), stdout);
  }
  return report.finish(kOk, globals.json ? physics_json(scene) : Json::object());
}

/// Help of --reading: every name with its values and who reads how.
std::string readings_help() {
  std::string text = "Where readers of UsdPhysics disagree (--reading NAME=VALUE, default first):";
  for (const physics::ReadingChoice& choice : physics::reading_choices()) {
    text += "\n  " + choice.name + " = ";
    for (const std::string& value : choice.values) {
      text += (&value == &choice.values.front() ? "" : " | ") + value;
    }
    text += "\n      " + choice.about;
  }
  return text;
}

}  // namespace

void add_physics(CLI::App& app, const Globals& globals, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand(
      "physics", "The neutral physics description that engines receive, in SI and radians");
  auto options = std::make_shared<Options>();
  options->asset.add_to(*verb);
  verb->add_option("--reading", options->readings, "NAME=VALUE of those below; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->footer(readings_help() + "\n\nExample:\n  tenon physics hand.usda --physics physx --json");
  choose(*verb, chosen, [&globals, options] { return run_physics(globals, *options); });
}

}  // namespace tenon::cli
