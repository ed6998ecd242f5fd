// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The table is of the asset as it is, with --try of another approximation, with --budget of what is
// chosen. What is chosen is written with --save alone, as one edit.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/text/pairs/colliders_text.h"
#include "cli/verb.h"
#include "tenon/asset/colliders/colliders_json.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

struct CollidersArguments {
  std::string asset;
  std::string physics;
  std::string engine;
  std::vector<std::string> colliders;
  std::string instead;
  std::size_t budget = 0;  // 0: none
  std::optional<double> gap;
  bool save = false;
  FileAccess files;
};

EditOptions edit_options_of(const CollidersArguments& arguments) {
  EditOptions edit;
  select_physics(arguments.physics, edit.open);
  arguments.files.apply_to(edit.open);
  return edit;
}

Result<CollidersOfAsset> look_at_colliders(const CollidersArguments& arguments, Report& report) {
  CollidersOptions options;
  options.open = edit_options_of(arguments).open;
  options.engine = arguments.engine;
  if (options.engine.empty()) {
    TENON_TRY(options.engine, engine_for("", arguments.asset, report));
  }
  options.colliders = arguments.colliders;
  options.instead = approximation_named(arguments.instead);
  if (arguments.budget > 0) {
    options.budget = ColliderBudget{arguments.budget, arguments.gap};
  }
  Progress progress(report.globals(), "measuring colliders of " + shown_path(arguments.asset));
  options.progress = [&progress](std::size_t done, std::size_t of) {
    progress.at(static_cast<double>(done), static_cast<double>(of), "colliders");
  };
  return colliders_of_asset(arguments.asset, options, report.diagnostics);
}

int list_colliders(const CollidersArguments& arguments, Report& report) {
  auto found = look_at_colliders(arguments, report);
  if (!found) {
    return report.fail(found.error());
  }
  Json json = colliders_json(*found);
  if (!report.json()) {
    print_text(colliders_text(json, report.verbose(), false));
  }
  return report.finish(kOk, std::move(json));
}

/// Chooses, edits and writes; all of it again where a file changed meanwhile.
int save_colliders(const CollidersArguments& arguments, Report& report) {
  std::vector<AssetEdit> edits;
  const auto asset = repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_TRY(const CollidersOfAsset found, look_at_colliders(arguments, report));
    if (!report.json()) {
      print_text(colliders_text(colliders_json(found), report.verbose(), true));
    }
    EditRequest request;
    request.collider = collider_requests(found);
    if (request.collider.empty()) {
      return EditedAsset();
    }
    const EditOptions options = edit_options_of(arguments);
    TENON_TRY(edits, read_edits(arguments.asset, request, options));
    TENON_TRY(EditedAsset edited, edit_asset(arguments.asset, edits, options, report.diagnostics));
    if (edited.without_effect.empty()) {
      TENON_CHECK(write_edits(edited.files, {"colliders", arguments.asset}));
    }
    return edited;
  });
  return asset ? finish_edits(report, edits, *asset, false, EditLines::OfPrims)
               : report.fail(asset.error());
}

int run_colliders(const Globals& globals, const CollidersArguments& arguments) {
  Report report(globals, "colliders", arguments.asset);
  return arguments.save ? save_colliders(arguments, report) : list_colliders(arguments, report);
}

constexpr const char* kCollidersFooter =
    "What each collider asks for (physics:approximation), and what the engine makes of it, read "
    "back from the engine. outside: how far that stands out of the mesh at most; inside: how far "
    "the mesh stands out of it. cover: its volume by that of the mesh, where the mesh is closed. "
    "cost: corners that a search for contacts goes through: those of hulls, 3 of each triangle, 8 "
    "of a box, 2 of a capsule, 1 of a ball. penetration: how deep it is at the start in colliders "
    "of other bodies that no filter keeps apart, on MuJoCo's shapes.\n\n"
    "--budget takes for each mesh the cheapest approximation whose gap (the larger of outside and "
    "inside, with its error) is within --gap, and that costs no more: a ball, a box, a hull; else "
    "convex pieces; of what stands still also fewer triangles, or all. A mesh that nothing fits "
    "stays as it is.\n\n"
    "Examples:\n"
    "  tenon colliders hand.usda\n"
    "  tenon colliders hand.usda --engine all -v\n"
    "  tenon colliders hand.usda --colliders 'palm.*' --try convexDecomposition\n"
    "  tenon colliders hand.usda --budget 64 --gap 0.001\n"
    "  tenon colliders hand.usda --budget 64 --save";

void add_choice_options(const Command& verb, CollidersArguments& options) {
  verb.add_option("--try", options.instead,
                  "The figures of this approximation of all meshes: convexHull, "
                  "convexDecomposition, meshSimplification, boundingSphere, boundingCube, none, "
                  "sdf, sphereFill; hull, decomposition, simplification, sphere or box for short")
      .one_of(approximation_words())
      .value_name("APPROXIMATION")
      .not_with({"--budget"});
  verb.add_option("--budget", options.budget, {1, 1e9, false, true, ""},
                  "Choose for each mesh the cheapest approximation that costs no more than this")
      .value_name("COST");
  verb.add_option("--gap", options.gap, {0, 1e6, false, false, "m"},
                  "How far shapes may be from their meshes; without it 2 % of each mesh's size")
      .value_name("LENGTH")
      .only_with({"--budget"});
  verb.add_flag("--save", options.save, "Write what is chosen; without it nothing is written")
      .only_with({"--budget"});
}

}  // namespace

void add_colliders(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "colliders", "How well shapes fit their meshes, what they cost, and other choices");
  auto options = std::make_shared<CollidersArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda, .usdc or .usdz file")
      .required()
      .file_only();
  std::vector<std::string> names = engines::engine_names();
  names.emplace_back("all");
  verb.add_option("--engine", options->engine,
                  "The engine, or all of this build; without it that of tenon.toml, else that of "
                  "the selected variant")
      .one_of(names)
      .value_name("NAME");
  verb.add_option(
          "--colliders", options->colliders,
          "Colliders to look at: name, path, or regular expression for the whole of either, of "
          "colliders or bodies; may be repeated")
      .repeatable()
      .value_name("PATTERN");
  add_choice_options(verb, *options);
  verb.add_option("--physics", options->physics, kPhysicsHelp);
  options->files.add_to(verb);
  verb.footer(kCollidersFooter);
  choose(verb, chosen, [&globals, options] { return run_colliders(globals, *options); });
}

}  // namespace tenon::cli
