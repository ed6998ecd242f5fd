// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "cli/output.h"
#include "cli/prim_walk.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/physics/physics_counts.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/stage_units.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

/// A layer's place as seen from the folder of the root layer.
std::string layer_name(const std::string& identifier, const std::string& root) {
  const std::filesystem::path path(identifier);
  if (!path.is_absolute()) {
    return identifier;
  }
  return path.lexically_proximate(std::filesystem::path(root).parent_path()).generic_string();
}

const char* axis_name(stage::UpAxis axis) {
  switch (axis) {
    case stage::UpAxis::X:
      return "X";
    case stage::UpAxis::Y:
      return "Y";
    case stage::UpAxis::Z:
      break;
  }
  return "Z";
}

Json stage_json(const stage::Stage& stage, std::size_t prim_count) {
  Json layers = Json::array();
  std::set<std::string> names;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    if (layer.get() != stage.session_layer()) {
      names.insert(layer_name(layer->identifier(), stage.root_layer().identifier()));
    }
  }
  Diagnostics reported;  // reading the physics says the same
  const stage::StageUnits units = stage::read_stage_units(stage, reported);
  Json result = Json::object();
  result["layers"] = names;
  result["defaultPrim"] = stage.root_layer().default_prim().str();
  result["upAxis"] = axis_name(units.up_axis);
  result["metersPerUnit"] = units.meters_per_unit;
  result["kilogramsPerUnit"] = units.kilograms_per_unit;
  result["timeCodesPerSecond"] = stage.time_codes_per_second();
  result["primCount"] = prim_count;
  return result;
}

Json physics_json(const physics::PhysicsCounts& counts) {
  Json joints = Json::object();
  for (std::size_t kind = 0; kind < counts.joints.size(); ++kind) {
    joints[std::string(physics::joint_kind_name(static_cast<physics::JointKind>(kind)))] =
        counts.joints[kind];
  }
  return {{"scenes", counts.scenes},
          {"bodies", counts.bodies},
          {"kinematicBodies", counts.kinematic_bodies},
          {"colliders", counts.colliders},
          {"staticColliders", counts.static_colliders},
          {"articulations", counts.articulations},
          {"drives", counts.drives},
          {"limits", counts.limits},
          {"mimics", counts.mimics},
          {"dofs", counts.dofs},
          {"mass_kg", counts.mass},
          {"joints", joints}};
}

void print_info(const Json& info) {
  const Json& stage = info["stage"];
  print("default prim   %s\n", stage["defaultPrim"].get<std::string>().c_str());
  print("units          %g m, %g kg, up %s, %g time codes per second\n",
              stage["metersPerUnit"].get<double>(), stage["kilogramsPerUnit"].get<double>(),
              stage["upAxis"].get<std::string>().c_str(),
              stage["timeCodesPerSecond"].get<double>());
  print("prims          %zu in %zu layers\n", stage["primCount"].get<std::size_t>(),
              stage["layers"].size());
  for (const auto& layer : stage["layers"]) {
    print("  %s\n", layer.get<std::string>().c_str());
  }
  for (const auto& variant : info["variants"]) {
    std::string options;
    for (const auto& option : variant["options"]) {
      const auto name = option.get<std::string>();
      options +=
          (options.empty() ? "" : " ") + (option == variant["selection"] ? "[" + name + "]" : name);
    }
    print("variants       %s %s: %s\n", variant["prim"].get<std::string>().c_str(),
                variant["set"].get<std::string>().c_str(), options.c_str());
  }
  const Json& p = info["physics"];
  print("physics        %zu scenes, %zu bodies (%zu kinematic), %.6g kg, %zu articulations\n",
              p["scenes"].get<std::size_t>(), p["bodies"].get<std::size_t>(),
              p["kinematicBodies"].get<std::size_t>(), p["mass_kg"].get<double>(),
              p["articulations"].get<std::size_t>());
  std::string joints;
  for (const auto& [kind, count] : p["joints"].items()) {
    if (count.get<std::size_t>() != 0) {
      joints +=
          (joints.empty() ? "" : ", ") + std::to_string(count.get<std::size_t>()) + " " + kind;
    }
  }
  print("joints         %s\n", joints.empty() ? "none" : joints.c_str());
  print("               %zu degrees of freedom, %zu drives, %zu limits, %zu mimics\n",
              p["dofs"].get<std::size_t>(), p["drives"].get<std::size_t>(),
              p["limits"].get<std::size_t>(), p["mimics"].get<std::size_t>());
  print("colliders      %zu (%zu static)\n", p["colliders"].get<std::size_t>(),
              p["staticColliders"].get<std::size_t>());
  for (const auto& missing : info["missing"]) {
    print("missing        %s\n", missing["path"].get<std::string>().c_str());
  }
}

int run_info(const Globals& globals, const AssetArguments& arguments) {
  Report report(globals, "info", arguments.asset);
  auto stage = open_stage(arguments.asset, arguments.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  std::size_t prim_count = 0;
  Json variants = Json::array();
  walk_prims(stage->pseudo_root(), [&](const stage::Prim& prim) {
    prim_count += prim.is_pseudo_root() ? 0u : 1u;
    add_variants(prim, variants);
  });
  const physics::PhysicsScene scene = physics::read_physics(*stage, {}, report.diagnostics);
  Json missing = Json::array();
  for (const compose::MissingArc& arc : stage->missing_arcs()) {
    missing.push_back({{"layer", layer_name(arc.layer, stage->root_layer().identifier())},
                       {"prim", arc.prim.str()},
                       {"arc", arc.arc},
                       {"path", arc.path}});
  }
  Json info = Json::object();
  info["stage"] = stage_json(*stage, prim_count);
  info["variants"] = variants;
  info["physics"] = physics_json(physics::count_physics(scene));
  info["missing"] = missing;
  if (!globals.json) {
    print_info(info);
  }
  return report.finish(kOk, info);
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
