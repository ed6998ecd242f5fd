// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/info_json.h"
#include "tenon/asset/physics_options.h"
#include "tenon/base/text/counted.h"
#include "tenon/open_stage.h"
#include "tenon/physics/contents/read_outline.h"

namespace tenon::cli {
namespace {

void print_stage(const Json& stage) {
  print("default prim   %s\n", stage["defaultPrim"].get<std::string>().c_str());
  print("units          %g m, %g kg, up %s, %g time codes per second\n",
        stage["metersPerUnit"].get<double>(), stage["kilogramsPerUnit"].get<double>(),
        stage["upAxis"].get<std::string>().c_str(), stage["timeCodesPerSecond"].get<double>());
  print("prims          %zu in %s\n", stage["primCount"].get<std::size_t>(),
        counted(stage["layers"].size(), "layer").c_str());
  for (const auto& layer : stage["layers"]) {
    print("  %s\n", layer.get<std::string>().c_str());
  }
}

void print_variants_of(const Json& variants) {
  for (const auto& variant : variants) {
    std::string options;
    for (const auto& option : variant["options"]) {
      const auto name = option.get<std::string>();
      options +=
          (options.empty() ? "" : " ") + (option == variant["selection"] ? "[" + name + "]" : name);
    }
    print("variants       %s %s: %s\n", variant["prim"].get<std::string>().c_str(),
          variant["set"].get<std::string>().c_str(), options.c_str());
  }
}

void print_physics(const Json& p) {
  const auto count_of = [&p](const char* key, const char* one, const char* many = "") {
    return counted(p[key].get<std::size_t>(), one, many);
  };
  print("physics        %s, %s (%zu kinematic), %.6g kg, %s\n", count_of("scenes", "scene").c_str(),
        count_of("bodies", "body", "bodies").c_str(), p["kinematicBodies"].get<std::size_t>(),
        p["mass_kg"].get<double>(), count_of("articulations", "articulation").c_str());
  std::string joints;
  for (const auto& [kind, count] : p["joints"].items()) {
    if (count.get<std::size_t>() != 0) {
      joints +=
          (joints.empty() ? "" : ", ") + std::to_string(count.get<std::size_t>()) + " " + kind;
    }
  }
  print("joints         %s\n", joints.empty() ? "none" : joints.c_str());
  print("               %s, %s, %s, %s\n",
        count_of("dofs", "degree of freedom", "degrees of freedom").c_str(),
        count_of("drives", "drive").c_str(), count_of("limits", "limit").c_str(),
        count_of("mimics", "mimic").c_str());
  print("colliders      %zu (%zu static)\n", p["colliders"].get<std::size_t>(),
        p["staticColliders"].get<std::size_t>());
}

void print_info(const Json& info) {
  print_stage(info["stage"]);
  print_variants_of(info["variants"]);
  print_physics(info["physics"]);
  for (const auto& missing : info["missing"]) {
    print("missing        %s\n", missing["path"].get<std::string>().c_str());
  }
}

int run_info(const Globals& globals, const AssetArguments& arguments) {
  Report report(globals, "info", arguments.asset);
  auto stage = tenon::open(arguments.asset, arguments.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const scene::PhysicsScene scene =
      physics::read_outline(*stage, read_options(), report.diagnostics);
  Json info = answers::info_json(*stage, scene);
  if (!globals.json) {
    print_info(info);
  }
  return report.finish(kOk, std::move(info));
}

}  // namespace

void add_info(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "info", "What the asset is: layers, variants, units, physics, missing files");
  struct Several {
    AssetArguments one;
    std::vector<std::string> assets;
  };
  auto several = std::make_shared<Several>();
  several->one.add_several_to(verb, several->assets);
  verb.footer(
      "Examples:\n  tenon info hand.usda\n  tenon info hand.usda --json --physics physics\n"
      "  tenon info *.usd");
  choose(verb, chosen, [&globals, several] {
    return each_asset(globals, "info", several->assets,
                      [&](const Globals& inner, const auto& name) {
                        several->one.asset = name;
                        return run_info(inner, several->one);
                      });
  });
}

}  // namespace tenon::cli
