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

int run_physics(const Globals& globals, const AssetArguments& arguments) {
  Report report(globals, "physics", arguments.asset);
  auto stage = open_stage(arguments.asset, arguments.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const physics::PhysicsScene scene = physics::read_physics(*stage, {}, report.diagnostics);
  if (!globals.json) {
    std::fputs(physics_text(scene).c_str(), stdout);
  }
  return report.finish(kOk, globals.json ? physics_json(scene) : Json::object());
}

}  // namespace

void add_physics(CLI::App& app, const Globals& globals, Chosen& chosen) {
  CLI::App* verb = app.add_subcommand(
      "physics", "The neutral physics description that engines receive, in SI and radians");
  auto arguments = std::make_shared<AssetArguments>();
  arguments->add_to(*verb);
  verb->footer("Example:\n  tenon physics hand.usda --physics physx --json");
  choose(*verb, chosen, [&globals, arguments] { return run_physics(globals, *arguments); });
}

}  // namespace tenon::cli
