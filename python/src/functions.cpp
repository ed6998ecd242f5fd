// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs on files. Each reads with the interpreter let go, gives the answer as values, and
// writes behind the guard of guarded_write.h, so that no output goes over a file that was read.
#include "functions.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answer_of.h"
#include "edit_functions.h"
#include "failure.h"
#include "guarded_write.h"
#include "json.h"
#include "options.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/answers/parts_json.h"
#include "tenon/asset/answers/structured_json.h"
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
#include "tenon/asset/structure_asset.h"
#include "tenon/asset/updating/base_copy.h"
#include "tenon/asset/updating/update_asset.h"
#include "tenon/asset/updating/updated_json.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/check/rule.h"
#include "tenon/guard/worker_place.h"
#include "tenon/make_simulation.h"
#include "tenon/structure/written_note.h"

namespace tenon::python {
namespace {

using namespace nb::literals;
using Files = std::vector<std::filesystem::path>;

/// Raises for rules and engines that there are not.
void check_known(const check::Selection& rules) {
  or_raise(check_selection(rules));
  const std::vector<std::string>& known = check::known_engines();
  for (const std::string& engine : rules.engines) {
    if (std::find(known.begin(), known.end(), engine) == known.end()) {
      raise(Error(ErrorCode::Invalid, "\"" + engine + "\" is not an engine with rules of its own")
                .with_rule("usage.value")
                .with_fix("expected " + comma_list(known)));
    }
  }
}

nb::object check(const Files& paths, const OpenArguments& arguments, const std::string& profile,
                 const std::map<std::string, std::vector<std::string>>& rules,
                 const std::filesystem::path& baseline, bool fix, bool suggested) {
  CheckAssetsOptions options;
  options.check.open = open_options_of(arguments);
  options.check.readings = readings_of(arguments);
  options.check.profile = profile;
  options.check.rules = {rules.at("only"), rules.at("skip"), rules.at("for_")};
  check_known(options.check.rules);
  options.baseline = baseline.string();
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

/// What form an asset is made in, by the words that the command has for it; those of functions.py
/// are known.
struct AssetForm {
  std::string names;   ///< "tutorial"; else those of today
  std::string schema;  ///< "current", "legacy", "both"; else as usual
  std::string robot_type;

  /// Raises for a kind of robot that there is not.
  static AssetForm of(const std::map<std::string, std::string>& words) {
    AssetForm form{words.at("names"), words.at("schema"), words.at("robot_type")};
    const std::vector<std::string> known = structure::known_robot_types();
    if (!form.robot_type.empty() &&
        std::find(known.begin(), known.end(), form.robot_type) == known.end()) {
      raise(Error(ErrorCode::Invalid, "\"" + form.robot_type + "\" is no kind of robot")
                .with_rule("usage.value")
                .with_fix("expected one of: " + comma_list(known)));
    }
    return form;
  }
  bool is_tutorial() const { return names == "tutorial"; }
  structure::StructureOptions structure_options() const {
    structure::StructureOptions options;
    options.names = is_tutorial() ? structure::Names::Tutorial : structure::Names::Current;
    options.robot_type = robot_type;
    return options;
  }
  void apply_to(convert::ConvertOptions& robot) const {
    using convert::SchemaGeneration;
    robot.tutorial = is_tutorial();
    robot.flat |= is_tutorial();
    robot.robot_type = robot_type;
    const bool both = schema.empty() ? is_tutorial() : schema == "both";
    robot.schema = schema == "legacy" ? SchemaGeneration::Legacy
                   : both             ? SchemaGeneration::Both
                                      : SchemaGeneration::Current;
  }
};

/// How a robot's description is to be read, as tenon_usd hands it over. `rules` are texts by the
/// name of what they give: gains, armature, friction, collision.
ConvertFileOptions convert_options(const OpenArguments& arguments, const std::string& name,
                                   const std::map<std::string, std::vector<std::string>>& rules,
                                   std::optional<double> density, bool start_valid, bool fix_base,
                                   bool float_base, bool merge_fixed, bool scene, bool flat,
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
  options.robot.flat = flat;
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
                          const ConvertFileOptions& options, const AssetForm& form, bool force,
                          const UpdateArguments& how, Job& job) {
  GuardedRun guard;
  const bool folder = names_folder(output);
  if (!folder && form.is_tutorial()) {
    return Error(ErrorCode::Invalid, "names is about the files of a folder")
        .with_rule("convert.option")
        .with_fix("name a folder as the output, with a / at its end");
  }
  if (how.update && !folder && output.ends_with(".usdz")) {
    return Error(ErrorCode::Unsupported, "a package cannot be updated")
        .with_fix("convert into a folder, or give force=True to replace the package");
  }
  TENON_CHECK(how.update ? Result<void>() : check_free(output, folder, force));
  TENON_TRY(ConvertedFile converted, convert_file(input, options, job.found));
  const RobotCounts counts = counts_of(converted);
  std::optional<UpdatedAsset> updated;
  if (folder) {
    structure::StructureOptions structured = form.structure_options();
    structured.all_engines = form.is_tutorial();
    TENON_TRY(const structure::StructuredAsset asset,
              structured_robot(converted, job.found, structured));
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
                   bool merge_fixed, bool scene, bool flat, std::optional<bool> self_collision,
                   const std::map<std::string, std::string>& packages, const std::string& model,
                   const std::map<std::string, std::string>& arg, bool force, bool update,
                   const std::string& conflicts, const std::string& format,
                   const std::string& assets, const std::map<std::string, std::string>& words) {
  ConvertFileOptions options =
      convert_options(arguments, name, rules, density, start_valid, fix_base, float_base,
                      merge_fixed, scene, flat, self_collision, packages, model, arg);
  const AssetForm form = AssetForm::of(words);
  form.apply_to(options.robot);
  const UpdateArguments how{update, conflicts};
  return answer_of([input, output, options, form, force, how, format,
                    assets](Job& job) -> Result<Json> {
    if (!is_asset(input)) {
      if (!format.empty() || !assets.empty()) {
        return Error(
                   ErrorCode::Invalid,
                   "format and assets are about descriptions of an asset, and this makes an asset")
            .with_rule("convert.option")
            .with_fix("leave them out");
      }
      return import_robot(input.string(), output.string(), options, form, force, how, job);
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
                     const std::string& conflicts, bool overridable_colliders,
                     const std::map<std::string, std::string>& words) {
  using structure::LinkNesting;
  using structure::SchemaGeneration;
  const AssetForm form = AssetForm::of(words);
  structure::StructureOptions options = form.structure_options();
  options.name = name;
  options.engines = engines;
  options.overridable_colliders = overridable_colliders;
  options.schema = form.schema == "current"  ? SchemaGeneration::Current
                   : form.schema == "legacy" ? SchemaGeneration::Legacy
                   : form.schema == "both"   ? SchemaGeneration::Both
                                             : SchemaGeneration::AsAuthored;
  const std::string& links = words.at("links");
  options.links = links == "flat"     ? LinkNesting::Flat
                  : links == "nested" ? LinkNesting::Nested
                                      : LinkNesting::AsAuthored;
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
  module.def("check", &check, "paths"_a, "arguments"_a, "profile"_a, "rules"_a, "baseline"_a,
             "fix"_a, "suggested"_a,
             nb::sig("def check(paths: Sequence[str | os.PathLike[str]], arguments: "
                     "OpenArguments, profile: str, rules: Mapping[str, Sequence[str]], "
                     "baseline: str | os.PathLike[str], fix: bool, suggested: bool) "
                     "-> dict[str, Any]"));
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
}

}  // namespace

void bind_functions(nb::module_& module) {
  bind_checks(module);
  bind_edit_functions(module);
  module.def("convert", &convert, "input"_a, "output"_a, "arguments"_a, "name"_a, "rules"_a,
             "density"_a.none(), "start_valid"_a, "fix_base"_a, "float_base"_a, "merge_fixed"_a,
             "scene"_a, "flat"_a, "self_collision"_a.none(), "packages"_a, "model"_a, "arg"_a,
             "force"_a, "update"_a, "conflicts"_a, "format"_a, "assets"_a, "words"_a,
             nb::sig("def convert(input: str | os.PathLike[str], output: str | os.PathLike[str], "
                     "arguments: OpenArguments, name: str, rules: Mapping[str, Sequence[str]], "
                     "density: float | None, start_valid: bool, fix_base: bool, "
                     "float_base: bool, merge_fixed: bool, scene: bool, flat: bool, "
                     "self_collision: bool | None, "
                     "packages: Mapping[str, str], model: str, arg: Mapping[str, str], "
                     "force: bool, update: bool, "
                     "conflicts: str, format: str, assets: str, words: Mapping[str, str]) "
                     "-> dict[str, Any]"));
  module.def("structure", &structure, "path"_a, "folder"_a, "arguments"_a, "name"_a, "force"_a,
             "engines"_a, "update"_a, "conflicts"_a, "overridable_colliders"_a, "words"_a,
             nb::sig("def structure(path: str | os.PathLike[str], "
                     "folder: str | os.PathLike[str], arguments: OpenArguments, name: str, "
                     "force: bool, engines: Sequence[str], update: bool, conflicts: str, "
                     "overridable_colliders: bool, words: Mapping[str, str]) -> dict[str, Any]"));
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
