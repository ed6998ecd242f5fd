// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The options become one list of edits (tenon/asset/edit_request.h). Which file gets an edit, and
// whether it counts there, is decided in tenon/asset/edit_asset.h. Reading, editing and writing are
// repeated together when a file changed meanwhile. In a dry run standard output is the difference
// alone.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/difference_text.h"
#include "cli/text/terminal_text.h"
#include "cli/verb.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/diff/unified_diff.h"

namespace tenon::cli {
namespace {

struct SetArguments {
  std::string asset;
  EditRequest request;
  std::string layer;
  std::string engine;
  std::string physics;
  bool dry_run = false;
  FileAccess files;
};

EditOptions edit_options(const SetArguments& options) {
  EditOptions edit;
  select_physics(options.physics, edit.open);
  options.files.apply_to(edit.open);
  edit.layer = options.layer;
  edit.engine = options.engine;
  return edit;
}

std::string what(const AssetEdit& edit) {
  const bool api = !edit.api.empty();
  return edit.object.str() +
         (api ? (edit.kind == AssetEdit::Kind::ApplyApi ? " + " : " - ") + edit.api.str() : "");
}

std::string place_line(const AssetEdit& edit, const EditedPlace& place) {
  std::string text = shown_path(place.file);
  text += place.line == 0 ? "" : ":" + std::to_string(place.line);
  text += "  " + what(edit);
  if (edit.api.empty()) {
    text += "  " + (place.before.empty() ? "none" : place.before) + " -> " +
            (place.after.empty() ? "none" : place.after);
  }
  text += "  (" + place.why;
  if (!place.variants.empty()) {
    text += "; counts with Physics=";
    for (std::size_t i = 0; i < place.variants.size(); ++i) {
      text += (i == 0 ? "" : ", ") + place.variants[i];
    }
  }
  return text + ")";
}

/// In a dry run standard output is the difference.
void print_places(const std::vector<AssetEdit>& edits, const EditedAsset& asset, bool dry_run) {
  for (const EditedPlace& place : asset.places) {
    const std::string line = place_line(edits[place.edit], place);
    dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
  }
}

void print_files(const Report& report, const EditedAsset& asset, bool dry_run) {
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    if (dry_run && file.text) {
      print_data(diff::unified_diff(name, file.before, file.after));
    } else if (dry_run) {
      report.note("would change " + name + ", which is not text");
    }
    if (!dry_run && file.text && file.before.empty()) {
      report.note("made " + name);
    }
    if (!file.kept_layout) {
      report.note("comments and layout of " + name + " are not kept");
    }
  }
}

/// What engines receive otherwise: each difference once, with the variants that have it.
void print_physics(const Report& report, const EditedAsset& asset, bool dry_run) {
  constexpr std::size_t kShown = 40;
  std::vector<std::pair<std::string, std::string>> lines;  // difference, variants
  for (const PhysicsEffect& effect : asset.physics) {
    for (const scene::SceneDifference& difference : effect.differences) {
      const std::string text = difference_text(difference);
      const auto known = std::find_if(lines.begin(), lines.end(),
                                      [&](const auto& line) { return line.first == text; });
      if (known == lines.end()) {
        lines.emplace_back(text, effect.variant);
      } else {
        known->second += ", " + effect.variant;
      }
    }
  }
  const auto say = [&](const std::string& line) {
    dry_run ? say_aside(terminal_text(line, false)) : print("%s\n", line.c_str());
  };
  const std::size_t shown = report.verbose() ? lines.size() : std::min(lines.size(), kShown);
  for (std::size_t i = 0; i < shown; ++i) {
    say("  " + lines[i].first +
        (lines[i].second.empty() ? "" : "  (Physics=" + lines[i].second + ")"));
  }
  if (shown < lines.size()) {
    say("  and " + std::to_string(lines.size() - shown) + " more differences (-v shows them)");
  }
}

/// Reads the asset, edits it and writes it back; `edits` are those that were made.
Result<EditedAsset> edit(const SetArguments& options, Report& report,
                         std::vector<AssetEdit>& edits) {
  return repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_TRY(edits, read_edits(options.asset, options.request, edit_options(options)));
    TENON_TRY(EditedAsset asset,
              edit_asset(options.asset, edits, edit_options(options), report.diagnostics));
    if (!options.dry_run && asset.without_effect.empty()) {
      TENON_CHECK(write_edits(asset.files));
    }
    return asset;
  });
}

int run_set(const Globals& globals, const SetArguments& options) {
  Report report(globals, "set", options.asset);
  std::vector<AssetEdit> edits;
  const auto asset = edit(options, report, edits);
  if (!asset) {
    return report.fail(asset.error());
  }
  const bool useful = asset->without_effect.empty();
  const bool aside = options.dry_run || !useful;
  if (!report.json()) {
    print_places(edits, *asset, aside);
    print_physics(report, *asset, aside);
    if (useful) {
      print_files(report, *asset, options.dry_run);
    } else {
      report.note("nothing is written");
    }
  }
  return report.finish(useful ? kOk : kNo, edited_json(edits, *asset, options.dry_run));
}

constexpr const char* kSetFooter =
    "In an asset of the structure 3.0 each edit lands in the file that owns what it changes: "
    "drives\n"
    "and limits in physics.usda, physx attributes in physx.usda, metadata of the robot in "
    "robot.usda,\n"
    "what instances share in instances.usda. Elsewhere: in the strongest layer with an opinion, "
    "else\n"
    "in the root layer. Comments and layout of text stay. What was asked for is composed and "
    "compared\n"
    "before anything is written; files are replaced whole.\n\n"
    "What engines receive otherwise is told under each variant of \"Physics\". An edit of physics\n"
    "that changes nothing there is not written (exit code 1), and the reason is told.\n\n"
    "Examples:\n"
    "  tenon set hand.usda /hand/Physics/thumb_joint.physics:upperLimit=60 --dry-run\n"
    "  tenon set hand.usda --drive /hand/Physics/thumb_joint=stiffness:2,damping:0.1\n"
    "  tenon set hand.usda /hand/Physics/j.physxMimicJoint:rotX:naturalFrequency=30\n"
    "  tenon set hand.usda --engine mujoco /hand/Physics/j.physics:upperLimit=55\n"
    "  tenon set hand.usda --mass /hand/palm=0.2 --collider /hand/palm/mesh=convexDecomposition\n"
    "  tenon set hand.usda --drive /hand/Physics/j=stiffness:2 --all-engines\n"
    "  tenon set hand.usda --filter /hand/palm,/hand/thumb\n"
    "  tenon set hand.usda /hand/palm.physics:filteredPairs-=/hand/thumb\n"
    "  tenon set hand.usda --apply /hand/palm=PhysxRigidBodyAPI\n"
    "Units of the typed edits: kilograms; else those of the schema, degrees for angles.";

void add_edit_options(const Command& verb, EditRequest& options) {
  verb.add_option("--clear", options.clear, "Remove the owning file's opinion on PATH.attr")
      .repeatable();
  verb.add_option("--apply", options.apply, "PRIM=SCHEMA: apply an API schema").repeatable();
  verb.add_option("--remove", options.remove, "PRIM=SCHEMA: remove an API schema").repeatable();
  verb.add_option("--mass", options.mass, "PRIM=KILOGRAMS").repeatable();
  verb.add_option("--drive", options.drive, "JOINT=stiffness:10,damping:1,maxForce:5,...")
      .repeatable();
  verb.add_option("--mimic", options.mimic, "FOLLOWER=LEADER,MULTIPLIER[,OFFSET]").repeatable();
  verb.add_option("--collider", options.collider, "PRIM=APPROXIMATION, or PRIM=on").repeatable();
  verb.add_option("--material", options.material, "PRIM=MATERIAL: physics material").repeatable();
  verb.add_option("--filter", options.filter, "A,B: these two, and what is below, do not touch")
      .repeatable();
}

}  // namespace

void add_set(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("set", "Change properties of an asset, each in the file that owns it");
  auto options = std::make_shared<SetArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  verb.add_option("assignments", options->request.assignments,
                  "PATH.attr=VALUE as text layers print it; PATH.rel=/a,/b for relationships, "
                  "+= and -= to add to their lists and take from them");
  add_edit_options(verb, options->request);
  verb.add_option("--type", options->request.type, "The type of attributes that this creates");
  verb.add_option("--in", options->layer, "Edit this file, whichever owns the property");
  verb.add_option("--engine", options->engine,
                  "The file of this engine alone: physx, mujoco, newton; made with its variant "
                  "where the asset has none");
  verb.add_flag("--all-engines", options->request.all_engines,
                "Edit each engine's own form, too: gains of actuators, each schema of a mimic, "
                "values that an engine's file has of its own");
  verb.add_option("--physics", options->physics,
                  "The variant of \"Physics\" in which the value has to count, or PRIM=VARIANT");
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing");
  options->files.add_to(verb);
  verb.footer(kSetFooter);
  choose(verb, chosen, [&globals, options] { return run_set(globals, *options); });
}

}  // namespace tenon::cli
