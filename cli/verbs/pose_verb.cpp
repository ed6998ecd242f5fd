// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One task at a time: poses are listed, one is shown, a file of them is written or read, one is
// saved, renamed or removed; without a task a posture that is described is printed. What edits the
// asset goes through the edit layer, so that tenon undo takes it back. A posture that inverse
// kinematics did not find is not saved. In a dry run standard output is the difference alone.
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/text/joints/pose_text.h"
#include "cli/verb.h"
#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/poses/pose_edits.h"
#include "tenon/asset/poses/pose_files.h"
#include "tenon/asset/poses/pose_json.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/limits/pose_limits.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

struct PoseArguments {
  std::string asset;
  std::string physics;
  PoseRequest request;
  std::size_t seed = 1;
  bool list = false;
  std::string show;
  std::string save;
  std::string rename;
  std::vector<std::string> remove;
  std::string import_file;
  std::string export_file;
  std::string robot;
  bool dry_run = false;
  FileAccess files;

  bool describes() const {
    return !request.pose.empty() || !request.state_in.empty() || !request.ik.empty();
  }
  bool edits() const {
    return !save.empty() || !rename.empty() || !remove.empty() || !import_file.empty();
  }
};

EditOptions pose_edit_options(const PoseArguments& options) {
  EditOptions edit;
  select_physics(options.physics, edit.open);
  options.files.apply_to(edit.open);
  return edit;
}

Result<PoseOfAsset> read_pose(const PoseArguments& arguments, Report& report) {
  PoseRequest request = arguments.request;
  request.seed = arguments.seed;
  if (!request.state_in.empty()) {
    TENON_TRY(request.engine, engine_for(request.engine, arguments.asset, report));
  }
  return pose_of_asset(arguments.asset, pose_edit_options(arguments).open, {}, request,
                       report.diagnostics);
}

// ---- without edits

int print_posture(const PoseOfAsset& pose, Report& report) {
  Json json = posture_json(pose);
  if (!report.json()) {
    print_text(posture_text(json, reach_obstacle_text(pose)));
  }
  return report.finish(pose.is_reached() ? kOk : kNo, std::move(json));
}

int show_pose(const PoseOfAsset& pose, const std::string& name, Report& report) {
  const auto named = named_pose(pose.poses, name);
  if (!named) {
    return report.fail(named.error());
  }
  Json json = named_pose_json(pose, *named);
  if (!report.json()) {
    print_text(named_pose_text(json));
  }
  return report.finish(kOk, std::move(json));
}

int list_poses(const PoseArguments& arguments, const PoseOfAsset& pose, Outputs& outputs,
               Report& report) {
  if (!arguments.export_file.empty()) {
    outputs.put(arguments.export_file, poses_file(pose));
    if (auto written = outputs.commit(); !written) {
      return report.fail(written.error());
    }
  }
  Json json = named_poses_json(pose);
  if (!report.json()) {
    print_text(named_poses_text(json));
  }
  return report.finish(kOk, std::move(json));
}

int run_without_pose_edits(const PoseArguments& arguments, Report& report) {
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Poses, arguments.export_file); !claimed) {
    return report.fail(claimed.error());
  }
  const auto pose = read_pose(arguments, report);
  if (!pose) {
    return report.fail(pose.error());
  }
  if (!arguments.show.empty()) {
    return show_pose(*pose, arguments.show, report);
  }
  return arguments.describes() ? print_posture(*pose, report)
                               : list_poses(arguments, *pose, outputs, report);
}

// ---- edits

Result<std::vector<AssetEdit>> pose_edits(const PoseArguments& arguments, const PoseOfAsset& pose,
                                          Report& report) {
  if (!arguments.rename.empty()) {
    return rename_edits(pose, arguments.rename);
  }
  if (!arguments.remove.empty()) {
    return removal_edits(pose, arguments.remove);
  }
  TENON_TRY(const Path robot, robot_of_poses(pose, arguments.robot));
  std::vector<physics::NamedPose> saved;
  if (!arguments.import_file.empty()) {
    TENON_TRY(saved, read_poses_file(pose, robot, arguments.import_file,
                                     pose_edit_options(arguments).open.files));
  } else {
    TENON_TRY(physics::NamedPose one,
              pose_to_save(pose, robot, arguments.save, report.diagnostics));
    saved.push_back(std::move(one));
  }
  return save_edits(pose, robot, saved);
}

/// What was read, and what came of the edits.
struct PoseEdited {
  PoseOfAsset pose;
  std::vector<AssetEdit> edits;
  EditedAsset asset;
};

/// Reads the asset, edits it and writes it back; nothing where a frame was not reached.
Result<PoseEdited> edit_poses(const PoseArguments& arguments, Report& report) {
  return repeat_edit(report.diagnostics, [&]() -> Result<PoseEdited> {
    TENON_TRY(PoseOfAsset pose, read_pose(arguments, report));
    PoseEdited edited{std::move(pose), {}, {}};
    if (!edited.pose.is_reached()) {
      return edited;
    }
    TENON_TRY(edited.edits, pose_edits(arguments, edited.pose, report));
    if (edited.edits.empty()) {
      return edited;
    }
    Diagnostics again;  // the asset was read before
    TENON_TRY(edited.asset,
              edit_asset(arguments.asset, edited.edits, pose_edit_options(arguments), again));
    if (!arguments.dry_run) {
      TENON_CHECK(write_edits(edited.asset.files, {"pose", arguments.asset}));
    }
    return edited;
  });
}

/// A line for each pose that is written, whose joints --show lists, and not for what holds them.
void print_saved(const PoseEdited& edited) {
  std::set<std::string> lines;
  for (const EditedPlace& place : edited.asset.places) {
    const AssetEdit& edit = edited.edits[place.edit];
    if (edit.kind == AssetEdit::Kind::AddTargets || edit.type_name == "Scope") {
      continue;
    }
    const Path prim = edit.object.prim();
    const std::string line = shown_path(place.file) + "  " + prim.str();
    if (lines.insert(line).second) {
      print("%s\n", line.c_str());
    }
  }
}

int run_pose_edits(const PoseArguments& arguments, Report& report) {
  const auto edited = edit_poses(arguments, report);
  if (!edited) {
    return report.fail(edited.error());
  }
  if (!edited->pose.is_reached()) {
    report.note("nothing is saved");
    return print_posture(edited->pose, report);
  }
  if (edited->edits.empty()) {
    report.note("nothing to write: the asset says this already");
  }
  if (!report.json()) {
    if (edited->pose.reached && !arguments.dry_run) {
      print_text(reach_text(posture_json(edited->pose)["reach"], ""));
    }
    if (!arguments.dry_run && !report.verbose()) {
      print_saved(*edited);
      return report.finish(kOk);
    }
    return finish_edits(report, edited->edits, edited->asset, arguments.dry_run,
                        EditLines::OfPrims);
  }
  Json json = edited_json(edited->edits, edited->asset, arguments.dry_run);
  if (!arguments.save.empty()) {
    json.update(posture_json(edited->pose));
  }
  return report.finish(kOk, std::move(json));
}

int run_pose(const Globals& globals, const PoseArguments& arguments) {
  Report report(globals, "pose", arguments.asset);
  return arguments.edits() ? run_pose_edits(arguments, report)
                           : run_without_pose_edits(arguments, report);
}

constexpr const char* kPoseFooter =
    "A named pose is where the joints of a robot are: a prim of type IsaacNamedPose, which is kept "
    "in the file that owns what the asset is as a robot (robot.usda in the structure 3.0). Every "
    "--pose takes its name.\n\n"
    "--ik brings a frame, which is a link or a prim below one, to a place in the world of the "
    "stage, in its units or with m, cm or mm behind a number. Only the joints that carry it move, "
    "within their limits; loops and mimics are kept. The search begins where --pose says, then at "
    "drawn postures. Several --ik are reached together.\n\n"
    "Exit codes: 0; 1 a frame was not reached, and nothing is saved; 2 bad input.\n\n"
    "Examples:\n"
    "  tenon pose hand.usda                                    the poses that it keeps\n"
    "  tenon pose hand.usda --save point --pose 'thumb.*=10'\n"
    "  tenon pose hand.usda --show point\n"
    "  tenon pose hand.usda --ik tip=0.1,0,25mm                joint values, nothing saved\n"
    "  tenon pose hand.usda --ik tip=0.1,0,25mm --save touch   to begin there: --pose touch";

/// The other tasks, and what describes a posture where the task has no use for one.
std::vector<std::string> not_beside(const std::string& task) {
  std::vector<std::string> others;
  for (const char* name :
       {"--list", "--show", "--save", "--rename", "--remove", "--import", "--export"}) {
    if (name != task) {
      others.emplace_back(name);
    }
  }
  if (task != "--save") {
    others.insert(others.end(), {"--pose", "--state-in", "--ik"});
  }
  return others;
}

void add_tasks(const Command& verb, PoseArguments& options) {
  verb.add_flag("--list", options.list, "List the named poses, which is done without a task, too")
      .not_with(not_beside("--list"));
  verb.add_option("--show", options.show, "Print the joints of a named pose")
      .value_name("NAME")
      .not_with(not_beside("--show"));
  verb.add_option("--save", options.save, "Keep the posture under this name, over one that has it")
      .value_name("NAME")
      .not_with(not_beside("--save"));
  verb.add_option("--rename", options.rename, "Give a named pose another name")
      .value_name("OLD=NEW")
      .not_with(not_beside("--rename"));
  verb.add_option("--remove", options.remove, "Remove a named pose; may be repeated")
      .repeatable()
      .value_name("NAME")
      .not_with(not_beside("--remove"));
  verb.add_option("--import", options.import_file,
                  "Keep all poses of a file as Isaac Sim's robot poser writes it")
      .file_only()
      .value_name("FILE.json")
      .not_with(not_beside("--import"));
  verb.add_option("--export", options.export_file, "Write the named poses as such a file")
      .value_name("FILE.json")
      .not_with(not_beside("--export"));
}

void add_posture(const Command& verb, PoseArguments& options) {
  PoseRequest& request = options.request;
  add_pose(verb, request.pose);
  verb.add_option("--state-in", request.state_in,
                  "Where the joints are in a state that tenon sim --state-out saved")
      .file_only()
      .value_name("FILE")
      .not_with({"--pose"});
  verb.add_option("--engine", request.engine, "The engine that saved the state")
      .one_of(engines::engine_names())
      .value_name("NAME")
      .only_with({"--state-in"});
}

void add_reach(const Command& verb, PoseArguments& options) {
  PoseRequest& request = options.request;
  verb.add_option("--ik", request.ik,
                  "FRAME=X,Y,Z: bring this prim there by inverse kinematics; may be repeated")
      .repeatable()
      .value_name("FRAME=X,Y,Z");
  verb.add_option("--rotation", request.rotation,
                  "How it is turned there: W,X,Y,Z of a quaternion, or angles X,Y,Z [deg]; with "
                  "FRAME= in front where several are placed")
      .repeatable()
      .value_name("ROTATION")
      .only_with({"--ik"});
  verb.add_option("--hold", request.hold,
                  "A joint that stays, by path, name or regular expression; may be repeated")
      .repeatable()
      .value_name("JOINT")
      .only_with({"--ik"});
  verb.add_option("--tolerance", request.tolerance, {1e-9, 1e3, false, false, "m"},
                  "Distance at which a place counts as reached; without it 1e-5 m")
      .value_name("METRES")
      .only_with({"--ik"});
  verb.add_option("--starts", request.starts,
                  {1, static_cast<double>(limits::kReachStarts), false, true, ""},
                  "Maximum number of postures from which the search begins")
      .value_name("COUNT")
      .only_with({"--ik"});
  verb.add_option("--seed", options.seed, {0, 1e15, false, true, ""},
                  "Seed of the postures that are drawn")
      .value_name("NUMBER")
      .only_with({"--ik"});
}

}  // namespace

void add_pose_verb(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("pose", "Named poses of a robot, and inverse kinematics");
  auto options = std::make_shared<PoseArguments>();
  verb.add_option("asset", options->asset, "A .usd, .usda or .usdc file").required().file_only();
  add_tasks(verb, *options);
  add_posture(verb, *options);
  add_reach(verb, *options);
  verb.add_option("--robot", options->robot,
                  "The robot that keeps the pose; without it the only prim with IsaacRobotAPI, "
                  "else the default prim")
      .value_name("PRIM")
      .only_with({"--save", "--import"});
  verb.add_flag("--dry-run", options->dry_run, "Print the difference, write nothing")
      .only_with({"--save", "--rename", "--remove", "--import"});
  verb.add_option("--physics", options->physics,
                  "The variant of \"Physics\" whose joints are meant, or PRIM=VARIANT");
  options->files.add_to(verb);
  verb.footer(kPoseFooter);
  choose(verb, chosen, [&globals, options] { return run_pose(globals, *options); });
}

}  // namespace tenon::cli
