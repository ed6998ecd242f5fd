// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Prints the prims depth first from a stack, on which each prim lies with the indentation of its
// line. Children go onto it in reverse order, so that the first comes off first. A deep tree costs
// no call stack. With --show physics it is the forest of bodies and joints, with --as the same in
// three forms (cli/text/forest_text.h).
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/forest_text.h"
#include "cli/verb.h"
#include "tenon/answers/forest_json.h"
#include "tenon/answers/specifier_word.h"
#include "tenon/answers/tree_json.h"
#include "tenon/asset/physics_options.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"

namespace tenon::cli {
namespace {

struct TreeArguments {
  AssetArguments asset;
  bool attributes = false;
  bool metadata = false;
  bool kinematic = false;
  std::string show;
  std::string as;
  std::vector<std::string> assets;
};

std::string prim_words(const stage::Prim& prim) {
  std::string words = answers::specifier_word(prim.specifier());
  if (!prim.type_name().empty()) {
    words += " " + prim.type_name().str();
  }
  if (prim.is_instance()) {
    words += ", instance";
  }
  if (!prim.is_active()) {
    words += ", inactive";
  }
  return words;
}

/// One prim and how deep its branch stands.
struct Branch {
  stage::Prim prim;
  std::string indent;
  bool last = true;
};

void print_attributes(const stage::Prim& prim, const std::string& indent) {
  for (const Token& name : prim.authored_property_names()) {
    if (prim.is_relationship(name)) {
      print("%s  .%s -> %zu\n", indent.c_str(), name.str().c_str(),
            prim.relationship(name).targets().size());
      continue;
    }
    const stage::Attribute attribute = prim.attribute(name);
    const layer::Value value = attribute.get();
    std::string text = value.size() > 8 ? "[" + std::to_string(value.size()) + " values]"
                                        : formats::value_text(value);
    print("%s  .%s %s = %s\n", indent.c_str(), name.str().c_str(),
          attribute.type_name().str().c_str(), text.c_str());
  }
}

void print_metadata(const stage::Prim& prim, const std::string& indent) {
  for (const auto& [field, value] : prim.all_authored_metadata()) {
    if (field != "specifier" && field != "typeName") {
      print("%s  (%s = %s)\n", indent.c_str(), field.c_str(), formats::value_text(value).c_str());
    }
  }
}

void print_tree(const stage::Stage& stage, const TreeArguments& options) {
  print("/\n");
  std::vector<Branch> open;
  auto push_children = [&](const stage::Prim& prim, const std::string& indent) {
    const std::vector<stage::Prim> children = prim.children();
    for (std::size_t i = children.size(); i-- > 0;) {
      open.push_back({children[i], indent, i + 1 == children.size()});
    }
  };
  push_children(stage.pseudo_root(), " ");
  while (!open.empty()) {
    const Branch branch = open.back();
    open.pop_back();
    print("%s%s%s [%s]\n", branch.indent.c_str(), branch.last ? "`--" : "|--",
          branch.prim.name().str().c_str(), prim_words(branch.prim).c_str());
    const std::string below = branch.indent + (branch.last ? "   " : "|  ");
    if (options.metadata) {
      print_metadata(branch.prim, below);
    }
    if (options.attributes) {
      print_attributes(branch.prim, below);
    }
    push_children(branch.prim, below);
  }
}

int show_forest(const stage::Stage& stage, const TreeArguments& options, Report& report) {
  const scene::PhysicsScene scene =
      physics::read_physics(stage, read_options(), report.diagnostics);
  const scene::JointForest forest = scene::joint_forest(scene);
  if (const auto form = answers::forest_form_named(options.as)) {
    Json json = answers::forest_as_json(scene, forest, *form);
    if (!report.json()) {
      print_text(forest_as_text(json));
    }
    return report.finish(kOk, std::move(json));
  }
  if (!report.json()) {
    print_text(forest_text(scene, forest));
  }
  return report.finish(kOk, answers::kinematic_tree_json(scene, forest));
}

int run_tree(const Globals& globals, const TreeArguments& options) {
  Report report(globals, "tree", options.asset.asset);
  auto stage = tenon::open(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  if (options.kinematic || !options.as.empty()) {
    return show_forest(*stage, options, report);
  }
  if (!report.json()) {
    print_tree(*stage, options);
  }
  return report.finish(kOk, report.json() ? answers::prims_json(*stage) : answers::nothing());
}

/// `--physics` without a value is the older way to write `--show physics`. In `tree --physics A`
/// the word after it is the asset.
void untangle_physics(TreeArguments& options, const Option& physics) {
  const bool bare = physics.given() && options.asset.physics.empty();
  options.kinematic = options.show == "physics" || bare;
  if (options.assets.empty() && !options.asset.physics.empty()) {
    options.kinematic = true;
    options.assets.push_back(std::exchange(options.asset.physics, {}));
  }
}

}  // namespace

void add_tree(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("tree", "The prim tree, or with --show physics that of the bodies");
  auto options = std::make_shared<TreeArguments>();
  options->asset.add_several_to(verb, options->assets);
  verb.option("assets").required(false);
  const Option physics = verb.option("--physics");
  physics.with_optional_value();
  verb.add_option("--show", options->show,
                  "physics: the tree of bodies and joints, with joint types, degrees of freedom "
                  "and masses")
      .one_of({"physics"})
      .value_name("WHAT");
  verb.add_option("--as", options->as,
                  "Links and joints, with bounds, drives, mimics and loops: articulation (link, "
                  "joint, link), flat (two tables) or mujoco (bodies with joints of their own)")
      .one_of(answers::forest_form_names())
      .value_name("FORM")
      .not_with({"--show"});
  verb.add_flag("-a,--attributes", options->attributes, "Also attributes and their values")
      .not_with({"--show", "--as"});
  verb.add_flag("-m,--metadata", options->metadata, "Also metadata").not_with({"--show", "--as"});
  verb.footer(
      "Examples:\n  tenon tree hand.usda -a\n  tenon tree hand.usda --mask /hand/palm\n"
      "  tenon tree hand.usda --show physics --physics physx\n"
      "  tenon tree hand.usda --as articulation");
  choose(verb, chosen, [&globals, options, physics] {
    untangle_physics(*options, physics);
    return each_asset(globals, "tree", options->assets,
                      [&](const Globals& inner, const auto& name) {
                        options->asset.asset = name;
                        return run_tree(inner, *options);
                      });
  });
}

}  // namespace tenon::cli
