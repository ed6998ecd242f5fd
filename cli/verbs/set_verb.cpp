// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The options become one list of edits (tenon/asset/edit_request.h). Which file gets an edit, and
// whether it counts there, is decided in tenon/asset/edit_asset.h. Reading, editing and writing are
// repeated together when a file changed meanwhile. In a dry run standard output is the difference
// alone.
#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/repeat_edit.h"

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

/// Reads the asset, edits it and writes it back; `edits` are those that were made.
Result<EditedAsset> edit(const SetArguments& options, Report& report,
                         std::vector<AssetEdit>& edits) {
  return repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_TRY(edits, read_edits(options.asset, options.request, edit_options(options)));
    if (edits.empty() && options.request.filter_overlaps) {
      report.note("no bodies overlap at the start: nothing to filter");
      return EditedAsset();
    }
    TENON_TRY(EditedAsset asset,
              edit_asset(options.asset, edits, edit_options(options), report.diagnostics));
    if (!options.dry_run && asset.without_effect.empty()) {
      TENON_CHECK(write_edits(asset.files, {"set", options.asset}));
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
  return finish_edits(report, edits, *asset, options.dry_run);
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
    "  tenon set hand.usda --filter-overlaps\n"
    "  tenon set hand.usda /hand/palm.physics:filteredPairs-=/hand/thumb\n"
    "  tenon set hand.usda --apply /hand/palm=PhysxRigidBodyAPI\n"
    "  tenon set scene.usda --layer timeCodesPerSecond=60 --layer endTimeCode=300\n"
    "--layer changes no value of the asset: another unit makes it larger or smaller, and that is\n"
    "told.\n"
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
  verb.add_option(
          "--layer", options.layer,
          "NAME=VALUE: metadata of the asset's root layer: timeCodesPerSecond, "
          "startTimeCode, endTimeCode, metersPerUnit, kilogramsPerUnit, upAxis, defaultPrim")
      .repeatable();
  verb.add_option("--filter", options.filter,
                  "A,B: disable collision between A and B, and all below them")
      .repeatable();
  verb.add_flag("--filter-overlaps", options.filter_overlaps,
                "Disable collision between all bodies that overlap at the start");
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
