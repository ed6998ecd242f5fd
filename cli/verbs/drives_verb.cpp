// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Without --specs and --mimic the drives are listed; with one of them the numbers are computed and
// written in one step, as `tenon set` writes.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/text/joints/drives_text.h"
#include "cli/verb.h"
#include "tenon/asset/drives/drives_json.h"
#include "tenon/asset/repeat_edit.h"

namespace tenon::cli {
namespace {

struct DrivesArguments {
  std::string asset;
  std::string physics;
  DrivesOptions drives;
  std::size_t seed = 0;
  bool dry_run = false;
  FileAccess files;
};

constexpr double kMostSamples = 100'000;

int list_drives(const DrivesArguments& arguments, Report& report) {
  auto found = drives_of_asset(arguments.asset, arguments.drives, report.diagnostics);
  if (!found) {
    return report.fail(found.error());
  }
  answers::Json json = drives_json(*found);
  if (!report.json()) {
    print_text(drives_text(json));
  }
  bool too_weak = false;
  for (const DriveDemand& drive : found->drives) {
    too_weak = too_weak || drive.is_too_weak();
  }
  return report.finish(too_weak ? kNo : kOk, std::move(json));
}

int edit_drives(const DrivesArguments& arguments, Report& report) {
  std::vector<AssetEdit> edits;
  const auto asset = repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_TRY(DrivesOfAsset found,
              drives_of_asset(arguments.asset, arguments.drives, report.diagnostics));
    edits = std::move(found.edits);
    if (!report.json() && !arguments.dry_run) {
      print_text(drives_text(drives_json(found)));
    }
    if (edits.empty()) {
      report.note("the file of specs gives neither an effort nor a speed: nothing to write");
      return EditedAsset();
    }
    EditOptions options;
    options.open = arguments.drives.open;
    TENON_TRY(EditedAsset edited, edit_asset(arguments.asset, edits, options, report.diagnostics));
    if (!arguments.dry_run && edited.without_effect.empty()) {
      TENON_CHECK(write_edits(edited.files, {"drives", arguments.asset}));
    }
    return edited;
  });
  if (!asset) {
    return report.fail(asset.error());
  }
  return finish_edits(report, edits, *asset, arguments.dry_run, EditLines::OfPrims);
}

int run_drives(const Globals& globals, DrivesArguments& arguments) {
  Report report(globals, "drives", arguments.asset);
  select_physics(arguments.physics, arguments.drives.open);
  arguments.files.apply_to(arguments.drives.open);
  arguments.drives.seed = arguments.seed;
  const bool edits = !arguments.drives.specs.empty() || !arguments.drives.mimic.empty();
  return edits ? edit_drives(arguments, report) : list_drives(arguments, report);
}

constexpr const char* kDrivesFooter =
    "Weight to hold: what gravity exerts along the joint, with the followers of its mimics and the "
    "rest of its loops moving along and all else held. A drive whose max effort is below is too "
    "weak "
    "(exit code 1).\n\n"
    "--specs FILE has a table for each joint, by name, path or regular expression:\n"
    "  [thumb_joint]\n"
    "  tip_force = \"10 N\"        with lever_arm = \"84 mm\", or tip = \"/hand/thumb_tip\"\n"
    "  chain_factor = 2          joints that share it\n"
    "  max_speed = \"260 deg/s\"\n"
    "or max_effort; motor_torque, gear_ratio, efficiency, motor_speed; torque_constant and "
    "max_current. Efforts become the drives' maxForce and the force range of actuators, speeds the "
    "limits of Newton's and PhysX's schemas, each in the file that owns it.\n\n"
    "Examples:\n"
    "  tenon drives hand.usda --sample 1000\n"
    "  tenon drives hand.usda --specs motors.toml --dry-run\n"
    "  tenon drives hand.usda --mimic rigid";

}  // namespace

void add_drives(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "drives", "Effort and speed limits of drives, the weight that they hold");
  auto options = std::make_shared<DrivesArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda, .usdc or .usdz file")
      .required()
      .file_only();
  verb.add_option("--sample", options->drives.samples, {0, kMostSamples, false, true, ""},
                  "Postures to draw within the limits of the joints, beside the start")
      .value_name("N");
  verb.add_option("--seed", options->seed, {0, 1e15, false, true, ""}, "Seed of the drawn postures")
      .only_with({"--sample"})
      .not_with({"--sample=0"});
  verb.add_option("--specs", options->drives.specs, "Data sheets of motors, a file in TOML")
      .value_name("FILE");
  verb.add_option("--mimic", options->drives.mimic,
                  "Compliance of PhysX's mimics: rigid, or natural frequency and damping ratio")
      .value_name("rigid|FREQUENCY,RATIO");
  verb.add_option("--physics", options->physics, kPhysicsHelp);
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing")
      .only_with({"--specs", "--mimic"});
  options->files.add_to(verb);
  verb.footer(kDrivesFooter);
  choose(verb, chosen, [&globals, options] { return run_drives(globals, *options); });
}

}  // namespace tenon::cli
