// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads the options, looks at the folder before the work, and prints which files were made or would
// be. structure_asset makes the package in memory and proves it, write_asset puts it into the
// folder.
#include <algorithm>
#include <filesystem>
#include <optional>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/update.h"
#include "cli/verb.h"
#include "cli/verbs/simready_arguments.h"
#include "tenon/asset/answers/structured_json.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset/structure_asset.h"
#include "tenon/asset/updating/updated_json.h"
#include "tenon/asset_policy.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/structure/layout.h"

namespace tenon::cli {
namespace {

struct StructureArguments {
  AssetArguments asset;
  structure::StructureOptions structure;
  std::string output;
  std::string names;
  std::string schema;  ///< empty: as-authored, both for SimReady
  std::string links = "as-authored";
  bool dry_run = false;
  structure::WriteOptions write;
  SimReadyArguments simready;
  UpdateArguments update{.made_by = "structure"};
};

struct Structured {
  structure::StructuredAsset asset;
  std::optional<UpdateOutcome> updated;
};

structure::SchemaGeneration generation_of(const std::string& name) {
  using structure::SchemaGeneration;
  return name == "current"  ? SchemaGeneration::Current
         : name == "legacy" ? SchemaGeneration::Legacy
         : name == "both"   ? SchemaGeneration::Both
                            : SchemaGeneration::AsAuthored;
}

structure::LinkNesting nesting_of(const std::string& name) {
  using structure::LinkNesting;
  return name == "flat"     ? LinkNesting::Flat
         : name == "nested" ? LinkNesting::Nested
                            : LinkNesting::AsAuthored;
}

Result<Structured> make(const StructureArguments& options, Report& report) {
  Structured made;
  TENON_TRY(made.asset, structure_asset(options.asset.asset, options.asset.open_options(),
                                        options.structure, report.diagnostics));
  if (!options.dry_run) {
    TENON_CHECK(options.simready.complete(made.asset.package, options.asset.open_options().files,
                                          options.output, report.diagnostics));
  }
  if (options.update.update) {
    TENON_TRY(made.updated, update(made.asset.package, options.output, options.update,
                                   options.dry_run, report.diagnostics));
  }
  if (!options.dry_run && !made.updated) {
    TENON_CHECK(write_asset(made.asset.package, options.output, options.write, "structure"));
  }
  return made;
}

int run_structure(Report& report, const StructureArguments& options) {
  if (!options.dry_run && !options.write.in_place && !options.update.update) {
    if (auto claimed = structure::check_folder(options.output, options.write); !claimed) {
      return report.fail(claimed.error());
    }
  }
  const Progress progress(report.globals(), "structuring " + shown_path(options.asset.asset));
  const auto made = repeat_edit(report.diagnostics, [&] { return make(options, report); });
  if (!made) {
    return report.fail(made.error());
  }
  const structure::StructuredAsset* asset = &made->asset;
  if (made->updated) {
    const int code = tell_update(report, *made->updated, options.update, options.output);
    return report.finish(
        left_out(report.diagnostics) ? kNo : code,
        with_updated(structured_json(*asset), made->updated->asset, options.update.keep()));
  }
  const std::vector<PackageFile> files = package_files(asset->package);
  if (options.dry_run && !report.json()) {
    for (const PackageFile& file : files) {
      print("%10zu  %-11s %s\n", file.bytes, file.role.c_str(), file.name.c_str());
    }
  }
  const std::string opens =
      (std::filesystem::path(options.output) / asset->package.interface).string();
  report.note((options.dry_run ? "would write " : "wrote ") + shown_path(opens) + ": " +
              counted(files.size(), "file") + ", " + counted(asset->moved.size(), "prim") +
              " moved, Physics=" + asset->selection + " is selected");
  return report.finish(left_out(report.diagnostics) ? kNo : kOk, structured_json(*asset));
}

void add_output_options(const Command& verb, StructureArguments& options) {
  verb.add_option("-o,--output", options.output,
                  "Folder of the new asset; an earlier one there is replaced in one step, unless "
                  "it was edited since");
  verb.add_flag("--force", options.write.force,
                "Overwrite an asset that was edited since it was written");
  verb.add_flag("--in-place", options.write.in_place,
                "The folder may be that of the asset itself, which it is without -o");
  options.update.add_to(verb);
  options.write.can_be_in_place = true;
}

void add_form_options(const Command& verb, StructureArguments& options) {
  verb.add_option("--name", options.structure.name,
                  "Name of the file that opens the asset; that of the default prim if not given");
  verb.add_option("--names", options.names,
                  "Names of files and scopes: those of Isaac Sim 6, or "
                  "those of its tutorial; without it that of tenon.toml, else current")
      .one_of(structure::known_names());
  verb.add_option("--schema", options.schema,
                  "Vendors' schemas for joints: as-authored, current (Newton mimics, PhysX joint "
                  "axes), legacy (PhysX mimics and joints of Isaac Sim 5) or both")
      .one_of({"as-authored", "current", "legacy", "both"});
  verb.add_option("--links", options.links,
                  "Rigid bodies of a robot: as-authored, flat (side by side) or nested (each below "
                  "the one that carries it by a joint)")
      .one_of({"as-authored", "flat", "nested"});
  verb.add_option("--engine", options.structure.engines,
                  "Give this engine a variant and a layer over physics.usda, where it has none: "
                  "physx, mujoco, newton or another one")
      .repeatable();
  verb.add_flag("--overridable-colliders", options.structure.overridable_colliders,
                "Meshes that collide are no instances: each engine's layer may tune them");
}

/// Of a variant and a file.
bool is_engine_name(const std::string& name) {
  const bool word = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
  return word && !name.empty() && name != structure::kNoVariant && name != "physics";
}

int run(const Globals& globals, StructureArguments& options) {
  Report report(globals, "structure", options.asset.asset);
  if (auto whole = options.asset.check_whole("all variants and payloads are taken in"); !whole) {
    return report.fail(whole.error());
  }
  if (options.update.update && (options.output.empty() || options.write.in_place)) {
    return report.fail(Error(ErrorCode::Invalid,
                             "--update is about a folder that was made of "
                             "another asset")
                           .with_fix("give -o FOLDER, without --in-place"));
  }
  if (options.output.empty() && options.write.in_place) {
    options.output = std::filesystem::absolute(options.asset.asset).parent_path().string();
  }
  if (options.output.empty() && !options.dry_run) {
    return report.fail(Error(ErrorCode::Invalid, "say where to write the result")
                           .with_fix("give -o FOLDER, --in-place or --dry-run"));
  }
  for (const std::string& engine : options.structure.engines) {
    if (!is_engine_name(engine)) {
      return report.fail(
          Error(ErrorCode::Invalid, "\"" + engine + "\" is no name of a layer for an engine")
              .with_rule("usage.value")
              .with_fix("use letters, digits and '_', as in newton; none and physics are taken"));
    }
  }
  const auto names = names_for(options.names, options.asset.asset, report);
  if (!names) {
    return report.fail(names.error());
  }
  options.structure.names =
      *names == "tutorial" ? structure::Names::Tutorial : structure::Names::Current;
  if (auto usable = options.simready.check(); !usable) {
    return report.fail(usable.error());
  }
  if (options.simready.wanted() && *names == "tutorial") {
    return report.fail(Error(ErrorCode::Invalid, "--profile simready has the names of today")
                           .with_fix("give --names current"));
  }
  if (auto said = options.simready.put_into(options.structure, options.asset.asset); !said) {
    return report.fail(said.error());
  }
  if (options.schema.empty()) {
    options.schema = options.simready.wanted() ? "both" : "as-authored";
  }
  options.structure.schema = generation_of(options.schema);
  options.structure.links = nesting_of(options.links);
  return run_structure(report, options);
}

}  // namespace

void add_structure(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "structure", "Make an asset into Asset Structure 3.0, one file for each concern");
  auto options = std::make_shared<StructureArguments>();
  options->asset.add_to(verb);
  add_output_options(verb, *options);
  add_form_options(verb, *options);
  options->simready.add_to(verb);
  verb.add_flag("--dry-run", options->dry_run, "List the files and write nothing");
  verb.footer(
      "The result is compared with the asset before it is written: each variant composes to the\n"
      "same scene and has the same physics, or nothing is written.\n\n"
      "Examples:\n"
      "  tenon structure robot.usda -o robot\n"
      "  tenon structure robot.usda -o robot --engine newton\n"
      "  tenon structure robot.usda --dry-run --json");
  choose(verb, chosen, [&globals, options] { return run(globals, *options); });
}

}  // namespace tenon::cli
