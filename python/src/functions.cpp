// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs on files. Each reads with the interpreter let go, gives the answer as values, and
// writes behind the guard of guarded_write.h, so that no output goes over a file that was read.
#include "functions.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "failure.h"
#include "guarded_write.h"
#include "interruptions.h"
#include "json.h"
#include "options.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/answers/parts_json.h"
#include "tenon/asset/answers/structured_json.h"
#include "tenon/asset/authoring/author_asset.h"
#include "tenon/asset/checking/check_assets.h"
#include "tenon/asset/checking/checked_json.h"
#include "tenon/asset/comparing/compare_files.h"
#include "tenon/asset/comparing_engines/compare_engines.h"
#include "tenon/asset/comparing_engines/compared_engines_json.h"
#include "tenon/asset/convert_file.h"
#include "tenon/asset/converting/converted_json.h"
#include "tenon/asset/converting/describe_asset.h"
#include "tenon/asset/converting/read_gains.h"
#include "tenon/asset/converting/robot_files.h"
#include "tenon/asset/layers/output_place.h"
#include "tenon/asset/poses/pose_edits.h"
#include "tenon/asset/poses/pose_json.h"
#include "tenon/asset/structure_asset.h"
#include "tenon/asset/updating/base_copy.h"
#include "tenon/asset/updating/update_asset.h"
#include "tenon/asset/updating/updated_json.h"
#include "tenon/check/rule.h"
#include "tenon/guard/worker_place.h"
#include "tenon/make_simulation.h"
#include "tenon/structure/written_note.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using answers::Json;
using Files = std::vector<std::filesystem::path>;
/// A verb that Ctrl-C ends before it writes.
using Job = LeavableCall<Json>;

/// An answer with what was found on the way, as "diagnostics".
nb::object answered(const Json& json, const Diagnostics& found) {
  nb::object answer = to_python(json);
  answer["diagnostics"] = to_list(found);
  return answer;
}

/// What `verb(job)` answers; it owns all that it takes.
template <class Verb>
nb::object answer_of(Verb verb) {
  const auto job = std::make_shared<Job>();
  const Json json = or_raise(unlocked([&] { return (*job)(std::move(verb)); }), job->found);
  return answered(json, job->found);
}

nb::object check(const Files& paths, const OpenArguments& arguments, const std::string& profile,
                 bool fix, bool suggested) {
  CheckAssetsOptions options;
  options.check.open = open_options_of(arguments);
  options.check.readings = readings_of(arguments);
  options.check.profile = profile;
  options.correct = fix;
  options.suggested = suggested;
  std::vector<std::string> names;
  for (const std::filesystem::path& path : paths) {
    names.push_back(path.string());
  }
  if (suggested && !fix) {
    raise(Error(ErrorCode::Invalid, "suggested says what fix corrects")
              .with_rule("usage.conflict")
              .with_fix("give fix=True, too"));
  }
  const auto job = std::make_shared<Job>();
  return to_python(or_raise(unlocked([&] {
    return (*job)([names = std::move(names), options, fix](Job& work) mutable -> Result<Json> {
      if (fix) {
        options.write = [&work](const std::string& /*asset*/,
                                const std::vector<EditedFile>& files) -> Result<void> {
          TENON_CHECK(check_may_write(work));
          return write_files(files);
        };
      }
      TENON_TRY(const CheckedAssets checked, check_assets(names, options));
      return checked_json(checked, fix ? "corrected" : "");
    });
  })));
}

nb::object diff(const std::filesystem::path& before, const std::filesystem::path& after,
                const OpenArguments& arguments, const std::string& mode, double tolerance) {
  CompareOptions options;
  options.open = open_options_of(arguments);
  options.tolerance = tolerance;
  options.mode = mode == "physics"    ? CompareMode::Physics
                 : mode == "composed" ? CompareMode::Composed
                                      : CompareMode::Files;
  Diagnostics found;
  const Json json =
      or_raise(unlocked([&]() -> Result<Json> {
                 TENON_TRY(const ComparedFiles compared,
                           compare_files(before.string(), after.string(), options, found));
                 return compared_json(before.string(), after.string(), compared);
               }),
               found);
  return answered(json, found);
}

nb::object compare(const std::filesystem::path& path, const OpenArguments& arguments,
                   const std::vector<std::string>& engines, std::optional<double> duration,
                   double time_step, double frames, std::size_t trials,
                   const std::filesystem::path& commands, const std::string& bounds) {
  CompareEnginesOptions options;
  options.open = open_options_of(arguments);
  options.readings = readings_of(arguments);
  options.engines = engines;
  options.duration = duration;
  options.time_step = time_step;
  options.frames_per_second = frames;
  options.trials = trials;
  options.commands = commands.string();
  if (!bounds.empty()) {
    options.bounds = or_raise(gap_bounds(bounds));
  }
  return answer_of([path, options](Job& job) mutable -> Result<Json> {
    options.listener.go_on = [&job](double /*seconds*/, double /*duration*/) {
      return job.go_on();
    };
    TENON_TRY(const ComparedEngines compared, compare_engines(path.string(), options, job.found));
    return compared_engines_json(compared, true);
  });
}

nb::object poses(const std::filesystem::path& path, const OpenArguments& arguments) {
  return answer_of([path, open = open_options_of(arguments),
                    readings = readings_of(arguments)](Job& job) -> Result<Json> {
    TENON_TRY(const PoseOfAsset asset, pose_of_asset(path.string(), open, readings, {}, job.found));
    return named_poses_json(asset);
  });
}

/// Keeps what was found under a name; the edits are in `json` then.
Result<void> save_pose(const std::string& path, const OpenOptions& open, const PoseOfAsset& asset,
                       const std::string& name, const std::string& robot, Job& job, Json& json) {
  TENON_TRY(const Path keeper, robot_of_poses(asset, robot));
  TENON_TRY(const physics::NamedPose saved, pose_to_save(asset, keeper, name, job.found));
  TENON_TRY(const std::vector<AssetEdit> edits, save_edits(asset, keeper, {saved}));
  EditedAsset edited;
  if (!edits.empty()) {
    Diagnostics again;  // the asset was read before
    TENON_TRY(edited, edit_asset(path, edits, {open, "", ""}, again));
    TENON_CHECK(check_may_write(job));
    TENON_CHECK(write_files(edited.files));
  }
  json.update(edited_json(edits, edited, false));
  return {};
}

nb::object pose(const std::filesystem::path& path, const OpenArguments& arguments,
                const std::vector<std::string>& texts, const std::vector<std::string>& ik,
                const std::vector<std::string>& rotation, const std::vector<std::string>& hold,
                std::optional<double> tolerance, std::size_t starts, std::uint64_t seed,
                const std::string& save, const std::string& robot) {
  PoseRequest request;
  request.pose = texts;
  request.ik = ik;
  request.rotation = rotation;
  request.hold = hold;
  request.tolerance = tolerance;
  request.starts = starts;
  request.seed = seed;
  return answer_of([path, request, save, robot, open = open_options_of(arguments),
                    readings = readings_of(arguments)](Job& job) -> Result<Json> {
    TENON_TRY(const PoseOfAsset asset,
              pose_of_asset(path.string(), open, readings, request, job.found));
    Json json = posture_json(asset);
    if (!save.empty() && asset.is_reached()) {
      TENON_CHECK(save_pose(path.string(), open, asset, save, robot, job, json));
    }
    return json;
  });
}

/// How a robot's description is to be read, as tenon_usd hands it over. `rules` are texts by the
/// name of what they give: gains, armature, friction, collision.
ConvertFileOptions convert_options(const OpenArguments& arguments, const std::string& name,
                                   const std::map<std::string, std::vector<std::string>>& rules,
                                   std::optional<double> density, bool start_valid, bool fix_base,
                                   bool float_base, bool merge_fixed, bool scene,
                                   std::optional<bool> self_collision,
                                   const std::map<std::string, std::string>& packages,
                                   const std::string& model,
                                   const std::map<std::string, std::string>& arg) {
  ConvertFileOptions options;
  options.open = arguments.open;
  options.name = name;
  options.packages = packages;
  options.model = model;
  options.arguments = arg;
  options.robot.fix_base = fix_base;
  options.robot.float_base = float_base;
  options.robot.merge_fixed = merge_fixed;
  options.robot.scene = scene;
  options.robot.self_collision = self_collision;
  options.robot.density = density;
  if (start_valid) {
    options.robot.start = convert::StartPose::Valid;
  }
  const auto texts = [&rules](const char* what) {
    const auto found = rules.find(what);
    return found == rules.end() ? std::vector<std::string>() : found->second;
  };
  or_raise(read_rules({texts("gains"), texts("armature"), texts("friction"), texts("collision")},
                      options.open.files, options.robot));
  return options;
}

/// What happens to an existing asset: neither of these, or it is converted again from its source
/// and keeps its edits.
struct UpdateArguments {
  bool update = false;
  std::string conflicts;  ///< "edits", "source", "fail" or empty

  diff::Side keep() const { return conflicts == "source" ? diff::Side::Source : diff::Side::Edits; }
};

/// The asset in `folder` with what the source changed, written; nothing where none is there or
/// wanted. Errors: those of update_folder; Invalid "update.conflict" where conflicts are to fail.
Result<std::optional<UpdatedAsset>> update_written(const structure::Package& made,
                                                   const std::string& folder,
                                                   const UpdateArguments& how, Job& job) {
  if (!how.update) {
    return std::optional<UpdatedAsset>();
  }
  TENON_TRY(auto updated,
            update_folder(made, folder, {how.keep(), how.conflicts == "edits"}, job.found));
  if (updated && how.conflicts == "fail" && !updated->conflicts.empty()) {
    return Error(ErrorCode::Invalid, "edits and the source changed the same thing, in " +
                                         std::to_string(updated->conflicts.size()) +
                                         " places; nothing is written")
        .in_file(folder)
        .with_rule("update.conflict")
        .with_fix("give conflicts=\"edits\" or \"source\"");
  }
  if (updated) {
    TENON_CHECK(check_may_write(job));
    TENON_CHECK(write_files(updated->files));
  }
  return updated;
}

Json with_update(Json answer, const std::optional<UpdatedAsset>& updated,
                 const UpdateArguments& how) {
  return updated ? with_updated(std::move(answer), *updated, how.keep()) : answer;
}

/// What was edited since it was written stays, unless it is forced.
Result<void> write_noted(const NotedFiles& made, const std::string& output, bool force, Job& job) {
  if (!force) {
    TENON_CHECK(structure::check_not_edited(output, made.beside));
  }
  TENON_CHECK(check_may_write(job));
  return write_made(made.files);
}

/// Where nothing but an asset that nobody edited may be written over.
Result<void> check_free(const std::string& output, bool folder, bool force) {
  return folder  ? structure::check_folder(output, {.force = force})
         : force ? Result<void>()
                 : structure::check_not_edited(output);
}

/// A robot in one file, with the files next to it.
Result<std::optional<UpdatedAsset>> write_robot_file(ConvertedFile converted,
                                                     const std::string& output, bool force,
                                                     const UpdateArguments& how, Job& job) {
  TENON_TRY(const NotedFiles made, robot_files(std::move(converted), output, job.found));
  std::optional<UpdatedAsset> updated;
  if (how.update) {
    TENON_TRY(const structure::Package package, package_of(made, output));
    const std::string folder = std::filesystem::absolute(output).parent_path().string();
    TENON_TRY(updated, update_written(package, folder, how, job));
  }
  if (!updated) {
    TENON_CHECK(write_noted(made, output, force, job));
  }
  return updated;
}

/// A description as an asset: a folder of Asset Structure 3.0, or a file.
Result<Json> import_robot(const std::string& input, const std::string& output,
                          const ConvertFileOptions& options, bool force, const UpdateArguments& how,
                          Job& job) {
  GuardedRun guard;
  const bool folder = names_folder(output);
  if (how.update && !folder && output.ends_with(".usdz")) {
    return Error(ErrorCode::Unsupported, "a package cannot be updated")
        .with_fix("convert into a folder, or give force=True to replace the package");
  }
  TENON_CHECK(how.update ? Result<void>() : check_free(output, folder, force));
  TENON_TRY(ConvertedFile converted, convert_file(input, options, job.found));
  const RobotCounts counts = counts_of(converted);
  std::optional<UpdatedAsset> updated;
  if (folder) {
    TENON_TRY(const structure::StructuredAsset asset, structured_robot(converted, job.found));
    TENON_TRY(updated, update_written(asset.package, output, how, job));
    if (!updated) {
      TENON_CHECK(check_may_write(job));
      TENON_CHECK(write_with_base(asset.package, output, {.force = force}));
    }
  } else {
    TENON_TRY(updated, write_robot_file(std::move(converted), output, force, how, job));
  }
  return with_update(converted_json(counts, output), updated, how);
}

/// An asset as a description for other programs.
Result<Json> export_robot(const std::string& input, const std::string& output,
                          DescribeOptions options, const std::string& format, bool force,
                          Job& job) {
  GuardedRun guard;
  TENON_TRY(options.format, description_format(output, format));
  TENON_CHECK(force ? Result<void>() : structure::check_not_edited(output));
  TENON_TRY(const AssetDescription description, describe_asset(input, options, output, job.found));
  TENON_CHECK(write_noted(description.made, output, force, job));
  return description_json(description, output);
}

bool is_asset(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  }
  return ending == ".usd" || ending == ".usda" || ending == ".usdc" || ending == ".usdz";
}

nb::object convert(const std::filesystem::path& input, const std::filesystem::path& output,
                   const OpenArguments& arguments, const std::string& name,
                   const std::map<std::string, std::vector<std::string>>& rules,
                   std::optional<double> density, bool start_valid, bool fix_base, bool float_base,
                   bool merge_fixed, bool scene, std::optional<bool> self_collision,
                   const std::map<std::string, std::string>& packages, const std::string& model,
                   const std::map<std::string, std::string>& arg, bool force, bool update,
                   const std::string& conflicts, const std::string& format,
                   const std::string& assets) {
  const ConvertFileOptions options =
      convert_options(arguments, name, rules, density, start_valid, fix_base, float_base,
                      merge_fixed, scene, self_collision, packages, model, arg);
  const UpdateArguments how{update, conflicts};
  return answer_of([input, output, options, force, how, format, assets](Job& job) -> Result<Json> {
    if (!is_asset(input)) {
      if (!format.empty() || !assets.empty()) {
        return Error(
                   ErrorCode::Invalid,
                   "format and assets are about descriptions of an asset, and this makes an asset")
            .with_rule("convert.option")
            .with_fix("leave them out");
      }
      return import_robot(input.string(), output.string(), options, force, how, job);
    }
    if (how.update) {
      return Error(ErrorCode::Unsupported,
                   "update is about assets, and this makes a description of one")
          .with_fix("leave update out");
    }
    return export_robot(input.string(), output.string(), {options.open, {}, assets}, format, force,
                        job);
  });
}

nb::object structure(const std::filesystem::path& path, const std::filesystem::path& folder,
                     const OpenArguments& arguments, const std::string& name, bool force,
                     const std::vector<std::string>& engines, bool update,
                     const std::string& conflicts) {
  structure::StructureOptions options;
  options.name = name;
  options.engines = engines;
  const UpdateArguments how{update, conflicts};
  const OpenOptions open = open_options_of(arguments);
  return answer_of([path, folder, options, open, force, how](Job& job) -> Result<Json> {
    GuardedRun guard;
    if (!folder.empty() && !how.update) {
      TENON_CHECK(structure::check_folder(folder.string(), {.force = force}));
    }
    TENON_TRY(const structure::StructuredAsset asset,
              structure_asset(path.string(), open, options, job.found));
    if (folder.empty()) {
      return structured_json(asset);
    }
    TENON_TRY(const auto updated, update_written(asset.package, folder.string(), how, job));
    if (!updated) {
      TENON_CHECK(check_may_write(job));
      TENON_CHECK(write_with_base(asset.package, folder.string(), {.force = force}));
    }
    return with_update(structured_json(asset), updated, how);
  });
}

void make_new(const std::filesystem::path& path, const std::string& up_axis, double meters_per_unit,
              double kilograms_per_unit, const std::string& prim) {
  or_raise(unlocked([&]() -> Result<void> {
    if (bytes::stamp_of(path.string())) {
      return Error(ErrorCode::Io, "there is a file of that name")
          .in_file(path.string())
          .with_rule("file.exists")
          .with_fix("choose another name, or remove the file");
    }
    TENON_TRY(MadeFile made, new_asset(path.string(), {.up_axis = up_axis,
                                                       .meters_per_unit = meters_per_unit,
                                                       .kilograms_per_unit = kilograms_per_unit,
                                                       .default_prim = prim}));
    return write_made({std::move(made)});
  }));
}

/// A file, and others whose names are relative to it.
void write_files_beside(const std::filesystem::path& path, const nb::bytes& contents,
                        const nb::dict& beside) {
  MadeFiles files;
  for (const auto& [name, bytes] : beside) {
    const auto held = nb::cast<nb::bytes>(bytes);
    files.push_back({(path.parent_path() / nb::cast<std::string>(name)).string(),
                     std::string(held.c_str(), held.size())});
  }
  files.push_back({path.string(), std::string(contents.c_str(), contents.size())});
  or_raise(unlocked([&] { return write_made(files); }));
}

nb::list engines() {
  nb::list rows;
  for (const engines::EngineInfo& engine : unlocked([] { return list_engines(); })) {
    nb::dict row;
    row["name"] = engine.name.c_str();
    row["version"] = engine.version.c_str();
    row["available"] = engine.available;
    row["how_to_get"] = engine.how_to_get.c_str();
    rows.append(row);
  }
  return rows;
}

void bind_checks(nb::module_& module) {
  module.def("check", &check, "paths"_a, "arguments"_a, "profile"_a, "fix"_a, "suggested"_a,
             nb::sig("def check(paths: Sequence[str | os.PathLike[str]], arguments: "
                     "OpenArguments, profile: str, fix: bool, suggested: bool) -> dict[str, Any]"));
  module.def(
      "rules", [] { return to_python(rules_json()); }, nb::sig("def rules() -> dict[str, Any]"));
  module.def(
      "rule_page", [](const std::string& rule) { return message(check::page_of(rule)); }, "rule"_a);
  module.def("diff", &diff, "before"_a, "after"_a, "arguments"_a, "mode"_a, "tolerance"_a,
             nb::sig("def diff(before: str | os.PathLike[str], after: str | os.PathLike[str], "
                     "arguments: OpenArguments, mode: str, tolerance: float) -> dict[str, Any]"));
  module.def("compare", &compare, "path"_a, "arguments"_a, "engines"_a, "duration"_a.none(),
             "time_step"_a, "frames"_a, "trials"_a, "commands"_a, "bounds"_a,
             nb::sig("def compare(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "engines: Sequence[str], duration: float | None, time_step: float, "
                     "frames: float, trials: int, commands: str | os.PathLike[str], "
                     "bounds: str) -> dict[str, Any]"));
  module.def("poses", &poses, "path"_a, "arguments"_a,
             nb::sig("def poses(path: str | os.PathLike[str], arguments: OpenArguments) -> "
                     "dict[str, Any]"));
  module.def("pose", &pose, "path"_a, "arguments"_a, "texts"_a, "ik"_a, "rotation"_a, "hold"_a,
             "tolerance"_a.none(), "starts"_a, "seed"_a, "save"_a, "robot"_a,
             nb::sig("def pose(path: str | os.PathLike[str], arguments: OpenArguments, texts: "
                     "Sequence[str], ik: Sequence[str], rotation: Sequence[str], hold: "
                     "Sequence[str], tolerance: float | None, starts: int, seed: int, save: str, "
                     "robot: str) -> dict[str, Any]"));
}

}  // namespace

void bind_functions(nb::module_& module) {
  bind_checks(module);
  module.def("convert", &convert, "input"_a, "output"_a, "arguments"_a, "name"_a, "rules"_a,
             "density"_a.none(), "start_valid"_a, "fix_base"_a, "float_base"_a, "merge_fixed"_a,
             "scene"_a, "self_collision"_a.none(), "packages"_a, "model"_a, "arg"_a, "force"_a,
             "update"_a, "conflicts"_a, "format"_a, "assets"_a,
             nb::sig("def convert(input: str | os.PathLike[str], output: str | os.PathLike[str], "
                     "arguments: OpenArguments, name: str, rules: Mapping[str, Sequence[str]], "
                     "density: float | None, start_valid: bool, fix_base: bool, "
                     "float_base: bool, merge_fixed: bool, scene: bool, "
                     "self_collision: bool | None, "
                     "packages: Mapping[str, str], model: str, arg: Mapping[str, str], "
                     "force: bool, update: bool, "
                     "conflicts: str, format: str, assets: str) -> dict[str, Any]"));
  module.def("structure", &structure, "path"_a, "folder"_a, "arguments"_a, "name"_a, "force"_a,
             "engines"_a, "update"_a, "conflicts"_a,
             nb::sig("def structure(path: str | os.PathLike[str], "
                     "folder: str | os.PathLike[str], arguments: OpenArguments, name: str, "
                     "force: bool, engines: Sequence[str], update: bool, conflicts: str) "
                     "-> dict[str, Any]"));
  module.def("new_asset", &make_new, "path"_a, "up_axis"_a, "meters_per_unit"_a,
             "kilograms_per_unit"_a, "default_prim"_a,
             nb::sig("def new_asset(path: str | os.PathLike[str], up_axis: str, "
                     "meters_per_unit: float, kilograms_per_unit: float, "
                     "default_prim: str) -> None"));
  module.def("write_files", &write_files_beside, "path"_a, "contents"_a, "beside"_a,
             nb::sig("def write_files(path: str | os.PathLike[str], contents: bytes, "
                     "beside: dict[str, bytes]) -> None"));
  module.def("wait_for_left_calls", &wait_for_left_calls, "Waits for calls that Ctrl-C has left.");
  module.def("end_looks", &end_looks, "Long calls look for signals no more.");
  module.def("engines", &engines, nb::sig("def engines() -> list[dict[str, Any]]"));
  module.def(
      "doctor", [] { return to_python(unlocked([] { return parts_json(optional_parts()); })); },
      nb::sig("def doctor() -> dict[str, Any]"));
  module.def(
      "set_worker",
      [](const std::filesystem::path& path) { guard::set_worker_program(path.string()); }, "path"_a,
      nb::sig("def set_worker(path: str | os.PathLike[str]) -> None"));
}

}  // namespace tenon::python
