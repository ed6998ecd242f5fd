// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The ending of the input decides the direction: assets become descriptions in the formats of
// other programs, all else is a description and becomes an asset. Outputs carry a note of what was
// written (tenon/structure/written_note.h). By it a later run sees that somebody edited them: it
// asks before the work and once more when nobody else can write.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <tuple>
#include <utility>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/update.h"
#include "cli/verb.h"
#include "cli/verbs/simready_arguments.h"
#include "tenon/asset/convert_file.h"
#include "tenon/asset/converting/converted_json.h"
#include "tenon/asset/converting/describe_asset.h"
#include "tenon/asset/converting/read_gains.h"
#include "tenon/asset/converting/robot_files.h"
#include "tenon/asset/layers/output_place.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset/updating/updated_json.h"
#include "tenon/asset_policy.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/written_note.h"

namespace tenon::cli {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string input;
  std::string output;
  std::vector<std::string> packages;
  std::vector<std::string> arguments;
  FileAccess files;
  RuleTexts rules;
  std::optional<double> density;
  std::string name;
  std::string model;
  std::string names;  ///< empty: those of the settings, else "current"
  std::string schema;
  std::string physics;
  std::string format;
  std::string assets;
  bool fix_base = false;
  bool float_base = false;
  std::string self_collision;
  std::string start;
  bool merge_fixed = false;
  bool scene = false;
  bool flat = false;
  bool force = false;
  SimReadyArguments simready;
  UpdateArguments update{.made_by = "convert"};
};

Result<ConvertFileOptions> convert_options(const ConvertArguments& options) {
  ConvertFileOptions result;
  result.open = options.files.open_options();
  result.robot.flat = options.flat;
  result.robot.fix_base = options.fix_base;
  result.robot.float_base = options.float_base;
  result.robot.merge_fixed = options.merge_fixed;
  if (!options.self_collision.empty()) {
    result.robot.self_collision = options.self_collision == "on";
  }
  if (options.start == "valid") {
    result.robot.start = convert::StartPose::Valid;
  }
  result.robot.scene = options.scene;
  result.name = options.name;
  result.model = options.model;
  result.robot.tutorial = options.names == "tutorial";
  result.robot.flat |= result.robot.tutorial;
  result.robot.robot_type = options.simready.robot_type;
  result.robot.keep_source = !options.simready.wanted();  // its meshes are no files of a scene
  // What stands is held. What walks is told by --float-base: a root may be the world.
  result.robot.fix_base |= options.simready.wanted() && !options.float_base &&
                           structure::is_held(options.simready.robot_type);
  const bool both = options.schema.empty() ? result.robot.tutorial || options.simready.wanted()
                                           : options.schema == "both";
  result.robot.schema = options.schema == "legacy" ? convert::SchemaGeneration::Legacy
                        : both                     ? convert::SchemaGeneration::Both
                                                   : convert::SchemaGeneration::Current;
  result.robot.density = options.density;
  TENON_CHECK(read_rules(options.rules, result.open.files, result.robot));
  for (const std::string& text : options.packages) {
    TENON_TRY(auto package, split_assignment(text));
    result.packages.insert(std::move(package));
  }
  for (const std::string& text : options.arguments) {
    TENON_TRY(auto argument, split_assignment(text));
    result.arguments.insert(std::move(argument));
  }
  return result;
}

Result<structure::StructureOptions> structure_options(const ConvertArguments& options) {
  structure::StructureOptions result;
  TENON_CHECK(options.simready.put_into(result, options.input));
  if (options.names == "tutorial") {
    result.names = structure::Names::Tutorial;
    result.all_engines = true;
  }
  return result;
}

/// The file is as it is to be already: an image of the asset that is read, for one.
bool is_there(const MadeFile& file) {
  bytes::FileRules rules;
  rules.is_input = false;
  const auto present = bytes::FileBytes::open(file.path, rules);
  return present && (*present)->text() == file.contents;
}

/// What was edited since it was written stays, without --force; what is not known to have been
/// written, too. Files beside it that are as they are to be are left alone.
Result<void> write(NotedFiles made, const ConvertArguments& options, Outputs& outputs) {
  std::erase_if(made.files, [&options](const MadeFile& file) {
    return file.path != options.output && is_there(file);
  });
  outputs.put_all(std::move(made.files));
  if (!options.force) {
    outputs.check_before_commit([&options, beside = std::move(made.beside)] {
      return structure::check_not_edited(options.output, beside);
    });
  }
  return outputs.commit();
}

/// What would be lost is told before the work.
Result<void> claim(const ConvertArguments& options, OutputKind kind, Outputs& outputs) {
  TENON_CHECK(outputs.claim(kind, options.output));
  return options.force ? Result<void>() : structure::check_not_edited(options.output);
}

bool ends_in(const std::string& path, std::initializer_list<const char*> endings) {
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

struct Conversion {
  RobotCounts counts;
  std::string opens;  ///< the file that opens the asset
  std::optional<UpdateOutcome> updated;
};

Result<void> check_options(const ConvertArguments& options, bool folder) {
  if (!folder && options.names == "tutorial") {
    return Error(ErrorCode::Invalid, "--names is about the files of a folder")
        .with_fix("name a folder as the output, with a / at its end");
  }
  TENON_CHECK(options.simready.check());
  if (options.simready.wanted() && (!folder || options.names == "tutorial")) {
    return Error(ErrorCode::Invalid,
                 "--profile simready is about the files of a folder, with names of today")
        .with_fix(folder ? "leave --names tutorial out"
                         : "name a folder as the output, with a / at its end");
  }
  if (options.update.update && !folder && ends_in(options.output, {".usdz"})) {
    return Error(ErrorCode::Unsupported, "a package cannot be updated")
        .with_fix("convert into a folder, or give --force to make the package again");
  }
  return {};
}

Result<Conversion> convert_and_write(const ConvertArguments& options, Diagnostics& diagnostics) {
  TENON_TRY(const ConvertFileOptions wanted, convert_options(options));
  const bool folder = names_folder(options.output);  // straight into Asset Structure 3.0
  const bool updates = options.update.update;
  TENON_CHECK(check_options(options, folder));
  Outputs outputs;
  if (!updates) {
    TENON_CHECK(folder ? structure::check_folder(options.output, {.force = options.force})
                       : claim(options, OutputKind::Layer, outputs));
  }
  TENON_TRY(ConvertedFile converted, convert_file(options.input, wanted, diagnostics));
  Conversion done;
  done.counts = counts_of(converted);
  done.opens = options.output;
  if (folder) {
    TENON_TRY(const structure::StructureOptions form, structure_options(options));
    TENON_TRY(structure::StructuredAsset asset, structured_robot(converted, diagnostics, form));
    TENON_CHECK(
        options.simready.complete(asset.package, wanted.open.files, options.output, diagnostics));
    done.opens = (fs::path(options.output) / asset.package.interface).string();
    if (updates) {
      TENON_TRY(done.updated,
                update(asset.package, options.output, options.update, false, diagnostics));
    }
    if (!done.updated) {
      TENON_CHECK(write_asset(asset.package, options.output, {.force = options.force}, "convert"));
    }
    return done;
  }
  TENON_TRY(NotedFiles made, robot_files(std::move(converted), options.output, diagnostics));
  if (updates) {
    TENON_TRY(const structure::Package package, package_of(made, options.output));
    const fs::path parent = fs::absolute(options.output).parent_path();
    TENON_TRY(done.updated, update(package, parent.string(), options.update, false, diagnostics));
  }
  if (!done.updated) {
    TENON_CHECK(updates ? claim(options, OutputKind::Layer, outputs) : Result<void>());
    TENON_CHECK(write(std::move(made), options, outputs));
  }
  return done;
}

OpenOptions open_options(const ConvertArguments& options) {
  OpenOptions open = options.files.open_options();
  select_physics(options.physics, open);
  return open;
}

/// `opens` is the file to open, where `output` is a folder; `beside` may be empty.
void note_counts(const Report& report, const std::string& opens, const std::string& links,
                 std::size_t joints, const std::string& beside) {
  report.note("wrote " + shown_path(opens) + ": " + links + ", " + counted(joints, "joint") +
              (beside.empty() ? "" : ", " + beside));
}

/// A robot that falls when it is simulated is told once, where nobody asked for it.
void note_free_root(const Report& report, const ConvertArguments& options) {
  const auto found =
      std::find_if(report.diagnostics.begin(), report.diagnostics.end(),
                   [](const Diagnostic& d) { return d.rule == "convert.free-root"; });
  if (found != report.diagnostics.end() && !options.float_base && !report.verbose()) {
    report.note(found->message + " (--fix-base holds it in the world)");
  }
}

/// Options that have nothing to act on in this robot are infos, and told.
void note_without_effect(const Report& report) {
  for (const Diagnostic& finding : report.diagnostics) {
    if (finding.rule == "convert.without-effect" && !report.verbose()) {
      report.note(finding.message);
    }
  }
}

/// Settings that a description has no place for are infos; how many there are is told.
void note_unsupported(const Report& report) {
  const auto count = static_cast<std::size_t>(
      std::count_if(report.diagnostics.begin(), report.diagnostics.end(), [](const Diagnostic& d) {
        return d.rule == "mujoco.not-mapped" && d.severity == Severity::Info;
      }));
  if (count > 0 && !report.verbose()) {
    report.note(counted(count, "setting") + " of the asset " + (count == 1 ? "is" : "are") +
                " unsupported by MJCF and not written; -v lists " + (count == 1 ? "it" : "them"));
  }
}

Error wrong_direction(const std::string& option, const char* about) {
  return Error(ErrorCode::Invalid, option + " has no effect: " + about)
      .with_rule("convert.option")
      .with_fix("leave " + option + " out");
}

/// Refuses what only a description that becomes an asset can be given.
Result<void> check_export_options(const ConvertArguments& options) {
  const RuleTexts& rules = options.rules;
  const std::pair<const char*, bool> given[] = {
      {"--package", !options.packages.empty()},
      {"--arg", !options.arguments.empty()},
      {"--name", !options.name.empty()},
      {"--model", !options.model.empty()},
      {"--names", !options.names.empty()},
      {"--fix-base", options.fix_base},
      {"--float-base", options.float_base},
      {"--self-collision", !options.self_collision.empty()},
      {"--start", !options.start.empty()},
      {"--merge-fixed", options.merge_fixed},
      {"--scene", options.scene},
      {"--flat", options.flat},
      {"--gains", !rules.gains.empty()},
      {"--armature", !rules.armature.empty()},
      {"--friction", !rules.friction.empty()},
      {"--schema", !options.schema.empty()},
      {"--collision", !rules.collision.empty()},
      {"--density", options.density.has_value()},
      {"--profile", !options.simready.profile.empty()},
      {"--robot-type", !options.simready.robot_type.empty()},
      {"--metadata", !options.simready.metadata.empty()},
  };
  for (const auto& [option, is_given] : given) {
    if (is_given) {
      return wrong_direction(option,
                             "it is about assets that are made, and this makes a description");
    }
  }
  return {};
}

/// What there is next to a description.
std::string files_beside(const AssetDescription& description, bool has_assets) {
  switch (description.format) {
    case DescriptionFormat::Mjcf:
      return counted(description.files_beside, has_assets ? "file" : "image");
    case DescriptionFormat::Mjlab:
      return counted(description.files_beside, "file");
    case DescriptionFormat::Urdf:
    case DescriptionFormat::Sdf:
    case DescriptionFormat::Ros2Control:
      return counted(description.files_beside, "mesh file");
    case DescriptionFormat::Srdf:
    case DescriptionFormat::IsaacLab:
      break;
  }
  return {};
}

void note_description(const Report& report, const ConvertArguments& options,
                      const AssetDescription& description) {
  const bool has_bodies = description.format == DescriptionFormat::Mjcf ||
                          description.format == DescriptionFormat::Mjlab ||
                          description.format == DescriptionFormat::IsaacLab;
  note_counts(report, options.output,
              has_bodies ? counted(description.links, "body", "bodies")
                         : counted(description.links, "link"),
              description.joints, files_beside(description, !options.assets.empty()));
}

/// The other way: an asset as a robot's description.
int run_export(Report& report, const ConvertArguments& options) {
  auto format = description_format(options.output, options.format);
  if (!format) {
    return report.fail(format.error());
  }
  if (auto usable = check_export_options(options); !usable) {
    return report.fail(usable.error());
  }
  Outputs outputs;
  if (auto claimed = claim(options, OutputKind::Description, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto description = describe_asset(options.input, {open_options(options), *format, options.assets},
                                    options.output, report.diagnostics);
  if (!description) {
    return report.fail(description.error());
  }
  if (auto written = write(std::move(description->made), options, outputs); !written) {
    return report.fail(written.error());
  }
  note_description(report, options, *description);
  note_unsupported(report);
  return report.finish(
      *format == DescriptionFormat::Mjcf && left_out(report.diagnostics) ? kNo : kOk,
      description_json(*description, options.output));
}

int run_conversion(Report& report, const ConvertArguments& options) {
  const auto converted = repeat_edit(
      report.diagnostics, [&] { return convert_and_write(options, report.diagnostics); });
  if (!converted) {
    return report.fail(converted.error());
  }
  Json body = converted_json(converted->counts, options.output);
  int code = report.diagnostics.has_errors() ? kNo : kOk;
  if (converted->updated) {
    code = std::max(code, tell_update(report, *converted->updated, options.update, options.output));
    body = with_updated(std::move(body), converted->updated->asset, options.update.keep());
  } else {
    note_counts(report, converted->opens, counted(converted->counts.links, "link"),
                converted->counts.joints, counted(converted->counts.meshes, "mesh file"));
  }
  note_free_root(report, options);
  note_without_effect(report);
  return report.finish(code, std::move(body));
}

/// From one description to another by way of an asset.
Error needs_two_steps(const ConvertArguments& options) {
  const std::string asset = fs::path(options.output).replace_extension(".usda").string();
  const std::string format = options.format.empty() ? "" : " --format " + options.format;
  return Error(ErrorCode::Unsupported, "a description becomes an asset, not another description")
      .with_rule("convert.format")
      .with_fix("make the asset first: `tenon convert " + shell_word(options.input) + " " +
                shell_word(asset) + "`, then `tenon convert " + shell_word(asset) + " " +
                shell_word(options.output) + format + "`");
}

int run_convert(const Globals& globals, ConvertArguments options) {
  Report report(globals, "convert", options.input);
  const Progress progress(globals, "converting " + shown_path(options.input));
  if (ends_in(options.input, {".usda", ".usdc", ".usd", ".usdz"})) {
    if (options.update.update) {
      return report.fail(Error(ErrorCode::Unsupported,
                               "--update is about assets, and this makes "
                               "a description of one")
                             .with_fix("leave --update out"));
    }
    return run_export(report, options);
  }
  if (!names_folder(options.output) && is_description(options.output)) {
    return report.fail(needs_two_steps(options));
  }
  for (const auto& [option, value, about] :
       {std::tuple("--physics", &options.physics,
                   "it selects a variant of an asset, and a description has none"),
        std::tuple("--format", &options.format, "it is about descriptions that are made"),
        std::tuple("--assets", &options.assets, "it is about descriptions that are made")}) {
    if (!value->empty()) {
      return report.fail(wrong_direction(option, about));
    }
  }
  if (names_folder(options.output)) {
    auto names = names_for(options.names, options.input, report);
    if (!names) {
      return report.fail(names.error());
    }
    options.names = *std::move(names);
  }
  return run_conversion(report, options);
}

void add_robot_options(const Command& verb, ConvertArguments& options) {
  verb.add_option("--name", options.name,
                  "Name of the robot, and of the file that opens it in a folder; that of the "
                  "description if not given");
  verb.add_option("--model", options.model, "The model to convert, of an SDF file with several");
  verb.add_option("--names", options.names,
                  "Files, names and attributes in a folder: those of Isaac Sim 6, or those of its "
                  "tutorial, with links side by side and variants for PhysX and MuJoCo; without it "
                  "that of tenon.toml, else current")
      .one_of(structure::known_names());
  verb.add_flag("--fix-base", options.fix_base, "Hold the root link in the world")
      .not_with({"--float-base"});
  verb.add_flag("--float-base", options.float_base,
                "The root link is free to move, as that of a walking robot; else it stands still "
                "where it has no mass, or is called world or base_link and no joint floats");
  verb.add_option("--self-collision", options.self_collision,
                  "on or off: whether links of the robot touch each other; if not given, off for "
                  "URDF, and for SDF and MJCF what the model says")
      .one_of({"on", "off"});
  verb.add_option(
          "--start", options.start,
          "zero, where the description has it, or valid: joints whose limits exclude 0 start "
          "inside of them; zero if not given")
      .one_of({"zero", "valid"});
  verb.add_flag("--merge-fixed", options.merge_fixed,
                "Make links on fixed joints parts of the links that hold them");
  verb.add_option("--physics", options.physics,
                  "The variant of the set \"Physics\" of an asset to describe");
  verb.add_option("--format", options.format,
                  "Format of the written description, where the ending does not say so: a "
                  "configuration of isaaclab or mjlab in Python, or URDF with ros2_control")
      .one_of(description_format_names());
  verb.add_option("--assets", options.assets,
                  "Folder for meshes and images, below that of the written description; without it "
                  "one with the description's name, and meshes in the text of MJCF")
      .value_name("DIR");
  verb.add_flag("--scene", options.scene,
                "Keep a MJCF model's world as a PhysicsScene: gravity, time step, options");
  verb.add_flag("--flat", options.flat, "Links side by side, not nested");
  verb.add_flag("--force", options.force,
                "Overwrite an asset or a description that was edited since it was written");
  options.simready.add_to(verb);
  options.update.add_to(verb);
}

void add_drive_options(const Command& verb, ConvertArguments& options) {
  verb.add_option("--gains", options.rules.gains,
                  "K,D: a drive for each joint that follows no other, in N m/rad and N m s/rad "
                  "(N/m and N s/m); REGEX=K,D: for those of these names; or a JSON file "
                  "{\"joint\": [K, D], \"*\": [K, D]}")
      .value_name("[REGEX=]K,D")
      .repeatable();
  verb.add_option("--armature", options.rules.armature,
                  "Rotor inertia of joints with one axis, in kg m^2 or kg, in place of the "
                  "description's")
      .value_name("[REGEX=]VALUE")
      .repeatable();
  verb.add_option("--friction", options.rules.friction,
                  "Coulomb friction of joints with one axis, in N m or N, in place of the "
                  "description's")
      .value_name("[REGEX=]VALUE")
      .repeatable();
  verb.add_option("--schema", options.schema,
                  "Vendors' schemas for joints: current (Newton, PhysX joint axes), legacy (PhysX "
                  "joints and mimics of Isaac Sim 5, MuJoCo) or both; current if not given, both "
                  "with --names tutorial")
      .one_of({"current", "legacy", "both"});
}

void add_body_options(const Command& verb, ConvertArguments& options) {
  verb.add_option("--collision", options.rules.collision,
                  "Collision shape of meshes: hull, decomposition (convex pieces), sphere "
                  "(around the mesh) or none (the mesh itself, which not every engine takes for "
                  "bodies that move); hull if not given")
      .value_name("[REGEX=]hull|decomposition|sphere|none")
      .repeatable();
  verb.add_option("--density", options.density, {0, 1e6, true, false, "kg/m^3"},
                  "Density of links that move and have colliders and no mass");
}

}  // namespace

void add_convert(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "convert",
      "Convert a robot description (URDF, SDF, MJCF) to an asset, or an asset to a description");
  auto options = std::make_shared<ConvertArguments>();
  verb.add_option("input", options->input, "A URDF, SDF or MJCF file, or an asset")
      .required()
      .file_only();
  verb.add_option("output,-o,--output", options->output,
                  "A .usda, .usdc, .usd or .usdz file, or a folder for Asset Structure 3.0; for an "
                  "asset an .xml (MJCF), .urdf, .sdf, .srdf or .py file; also as -o or --output")
      .required();
  verb.add_option("--package", options->packages,
                  "NAME=DIR: where a ROS package or a model of Gazebo is; without "
                  "it, the folders above the input are searched")
      .repeatable();
  verb.add_option("--arg", options->arguments,
                  "NAME=VALUE: an argument of a file with macros of xacro")
      .repeatable();
  options->files.add_to(verb);
  add_robot_options(verb, *options);
  add_drive_options(verb, *options);
  add_body_options(verb, *options);
  verb.footer(
      "Examples:\n  tenon convert hand.urdf hand.usda\n"
      "  tenon convert hand.urdf hand/     one file for each concern, as tenon structure makes it\n"
      "  tenon convert X.urdf hand/ --name inspire_hand --names tutorial\n"
      "  tenon convert arm.urdf arm.usdc --fix-base --gains 400,40\n"
      "  tenon convert hand.urdf hand/ --gains 10,1 --gains 'thumb.*=4,0.4' --armature 0.001\n"
      "  tenon convert hand.urdf hand/ --update    after a change of hand.urdf; edits of hand/ "
      "stay\n"
      "  tenon convert humanoid.xml humanoid.usda\n  tenon convert hand.usda hand.xml\n"
      "  tenon convert hand.usda hand.urdf\n  tenon convert hand.usda hand.sdf\n"
      "  tenon convert hand.usda hand.xml --assets meshes\n"
      "  tenon convert hand.usda hand_cfg.py --format isaaclab\n"
      "  tenon convert ur5.urdf ur5.usdz --package ur_description=../ur_description\n"
      "REGEX=VALUE is for joints (--collision: links) whose whole name matches; of several the "
      "last\n"
      "that matches counts, and a VALUE alone is for all others. One that matches nothing is an "
      "error.\n"
      "Exit code 1: written, but something of the robot is skipped, or an edit and the source\n"
      "changed the same thing (--update); each case is listed.");
  choose(verb, chosen, [&globals, options] { return run_convert(globals, *options); });
}

}  // namespace tenon::cli
