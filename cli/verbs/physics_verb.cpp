// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/text/mass_text.h"
#include "cli/text/physics_text.h"
#include "cli/verb.h"
#include "tenon/answers/mass_json.h"
#include "tenon/answers/scene_json_value.h"
#include "tenon/asset/physics_options.h"
#include "tenon/physics/read_physics.h"

namespace tenon::cli {
namespace {

struct PhysicsArguments {
  AssetArguments asset;
  std::vector<std::string> assets;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
  bool mass = false;                  ///< --mass
  std::string geometry = "hash";      ///< --geometry
  bool schema = false;                ///< --schema
};

int run_physics(const Globals& globals, const PhysicsArguments& options) {
  Report report(globals, "physics", options.asset.asset);
  const auto asset = open_with_readings(options.asset, options.readings, report.diagnostics);
  if (!asset) {
    return report.fail(asset.error());
  }
  physics::Provenance provenance;
  const scene::PhysicsScene scene =
      physics::read_physics(asset->stage, read_options(asset->readings), report.diagnostics,
                            options.mass ? &provenance : nullptr);
  if (options.mass) {
    Json answer = answers::masses_json(asset->stage, scene, provenance);
    if (!globals.json) {
      print_text(mass_table_text(answer["masses"]));
    }
    return report.finish(kOk, std::move(answer));
  }
  if (!globals.json) {
    print_text(physics_text(scene));
  }
  const answers::Geometry geometry =
      options.geometry == "inline" ? answers::Geometry::Inline : answers::Geometry::Hash;
  if (globals.json && geometry == answers::Geometry::Inline) {
    if (const auto checked = answers::check_inline_json(scene); !checked) {
      return report.fail(checked.error());
    }
  }
  if (globals.json && report.is_one()) {
    return report.finish_in_pieces(kOk, [&](answers::JsonTextSink& sink) {
      answers::write_scene_members(scene, geometry, sink);
    });
  }
  return report.finish(
      kOk, globals.json ? answers::scene_json_value(scene, geometry) : answers::nothing());
}

int run(const Globals& globals, PhysicsArguments& options) {
  if (options.schema) {
    print_text(answers::scene_schema() + "\n");
    return kOk;
  }
  return each_asset(globals, "physics", options.assets,
                    [&](const Globals& inner, const auto& name) {
                      options.asset.asset = name;
                      return run_physics(inner, options);
                    });
}

}  // namespace

void add_physics(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "physics", "The neutral physics description that engines receive, in SI and radians");
  auto options = std::make_shared<PhysicsArguments>();
  options->asset.add_several_to(verb, options->assets);
  verb.option("assets").required(false);
  add_readings(verb, options->readings);
  verb.add_flag("--mass", options->mass,
                "A table of every body's mass, centre and inertia: authored, resolved, reason")
      .not_with({"--schema"});
  verb.add_option("--geometry", options->geometry,
                  "With --json, of meshes: hash, or inline, points and triangles")
      .one_of({"hash", "inline"})
      .value_name("FORM")
      .only_with({"--json"})
      .not_with({"--mass", "--schema"});
  verb.add_flag("--schema", options->schema, "Only print the JSON Schema of --json");
  verb.footer(readings_help() +
              "\n\nExample:\n  tenon physics hand.usda --physics physx --json\n"
              "  tenon physics hand.usda --mass");
  choose(verb, chosen, [&globals, options] { return run(globals, *options); });
}

}  // namespace tenon::cli
