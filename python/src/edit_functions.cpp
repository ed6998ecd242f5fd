// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The verbs that make a file or edit one as a whole: new, pose, undo. Those that answer and convert
// are in functions.cpp, edits of an opened stage in bind_edits.cpp.
#include "edit_functions.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answer_of.h"
#include "failure.h"
#include "guarded_write.h"
#include "options.h"
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/authoring/author_asset.h"
#include "tenon/asset/poses/pose_edits.h"
#include "tenon/asset/poses/pose_files.h"
#include "tenon/asset/poses/pose_json.h"
#include "tenon/asset/undoing/undo_edit.h"

namespace tenon::python {
namespace {

using namespace nb::literals;

// ---- poses

nb::object poses(const std::filesystem::path& path, const OpenArguments& arguments,
                 const std::filesystem::path& output) {
  return answer_of([path, output, open = open_options_of(arguments),
                    readings = readings_of(arguments)](Job& job) -> Result<Json> {
    std::optional<GuardedRun> guard;
    if (!output.empty()) {
      guard.emplace();
    }
    TENON_TRY(const PoseOfAsset asset, pose_of_asset(path.string(), open, readings, {}, job.found));
    if (!output.empty()) {
      TENON_CHECK(check_may_write(job));
      TENON_CHECK(write_made({{output.string(), poses_file(asset)}}));
    }
    return named_poses_json(asset);
  });
}

/// Writes edits of named poses; what was done is in `json` then.
Result<void> write_pose_edits(const std::string& path, const OpenOptions& open,
                              const std::vector<AssetEdit>& edits, Job& job, Json& json) {
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

/// Keeps what was found under a name.
Result<void> save_pose(const std::string& path, const OpenOptions& open, const PoseOfAsset& asset,
                       const std::string& name, const std::string& robot, Job& job, Json& json) {
  TENON_TRY(const Path keeper, robot_of_poses(asset, robot));
  TENON_TRY(const physics::NamedPose saved, pose_to_save(asset, keeper, name, job.found));
  TENON_TRY(const std::vector<AssetEdit> edits, save_edits(asset, keeper, {saved}));
  return write_pose_edits(path, open, edits, job, json);
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

/// Of named poses that are kept: one of these.
struct PoseChanges {
  std::map<std::string, std::string> rename;  ///< old name -> new name
  std::vector<std::string> remove;
  std::string import_file;
};

Result<std::vector<AssetEdit>> pose_changes(const PoseOfAsset& asset, const PoseChanges& changes,
                                            const std::string& robot, const OpenOptions& open) {
  if (!changes.remove.empty()) {
    return removal_edits(asset, changes.remove);
  }
  if (!changes.import_file.empty()) {
    TENON_TRY(const Path keeper, robot_of_poses(asset, robot));
    TENON_TRY(const auto saved, read_poses_file(asset, keeper, changes.import_file, open.files));
    return save_edits(asset, keeper, saved);
  }
  std::vector<AssetEdit> edits;
  for (const auto& [old, name] : changes.rename) {
    TENON_TRY(const std::vector<AssetEdit> one, rename_edits(asset, old + "=" + name));
    edits.insert(edits.end(), one.begin(), one.end());
  }
  return edits;
}

nb::object edit_poses(const std::filesystem::path& path, const OpenArguments& arguments,
                      const std::map<std::string, std::string>& rename,
                      const std::vector<std::string>& remove,
                      const std::filesystem::path& import_file, const std::string& robot) {
  const PoseChanges changes{rename, remove, import_file.string()};
  return answer_of([path, changes, robot, open = open_options_of(arguments),
                    readings = readings_of(arguments)](Job& job) -> Result<Json> {
    TENON_TRY(const PoseOfAsset asset, pose_of_asset(path.string(), open, readings, {}, job.found));
    TENON_TRY(const std::vector<AssetEdit> edits, pose_changes(asset, changes, robot, open));
    Json json = Json::object();
    TENON_CHECK(write_pose_edits(path.string(), open, edits, job, json));
    return json;
  });
}

// ---- new files, and what was edited before

void make_new(const std::filesystem::path& path, const NewAsset& wanted, bool force) {
  or_raise(unlocked([&]() -> Result<void> {
    if (!force && bytes::stamp_of(path.string())) {
      return Error(ErrorCode::Io, "there is a file of that name")
          .in_file(path.string())
          .with_rule("file.exists")
          .with_fix("choose another name, or replace it with force=True");
    }
    TENON_TRY(MadeFile made, new_asset(path.string(), wanted));
    return write_made({std::move(made)});
  }));
}

nb::object undo(const std::filesystem::path& path, bool dry_run) {
  return to_python(or_raise(unlocked([&]() -> Result<Json> {
    TENON_TRY(const UndoneEdit edit, undo_edit(path.string(), bytes::Files()));
    if (!dry_run) {
      TENON_CHECK(restore_undone(edit));
    }
    return undone_json(edit, dry_run);
  })));
}

void bind_poses(nb::module_& module) {
  module.def("poses", &poses, "path"_a, "arguments"_a, "output"_a,
             nb::sig("def poses(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "output: str | os.PathLike[str]) -> dict[str, Any]"));
  module.def("pose", &pose, "path"_a, "arguments"_a, "texts"_a, "ik"_a, "rotation"_a, "hold"_a,
             "tolerance"_a.none(), "starts"_a, "seed"_a, "save"_a, "robot"_a,
             nb::sig("def pose(path: str | os.PathLike[str], arguments: OpenArguments, texts: "
                     "Sequence[str], ik: Sequence[str], rotation: Sequence[str], hold: "
                     "Sequence[str], tolerance: float | None, starts: int, seed: int, save: str, "
                     "robot: str) -> dict[str, Any]"));
  module.def("edit_poses", &edit_poses, "path"_a, "arguments"_a, "rename"_a, "remove"_a,
             "import_file"_a, "robot"_a,
             nb::sig("def edit_poses(path: str | os.PathLike[str], arguments: OpenArguments, "
                     "rename: Mapping[str, str], remove: Sequence[str], "
                     "import_file: str | os.PathLike[str], robot: str) -> dict[str, Any]"));
}

}  // namespace

void bind_edit_functions(nb::module_& module) {
  bind_poses(module);
  module.def(
      "new_asset",
      [](const std::filesystem::path& path, const std::string& up_axis, double meters_per_unit,
         double kilograms_per_unit, const std::string& default_prim,
         std::optional<double> time_codes_per_second, std::optional<double> start_time_code,
         std::optional<double> end_time_code, bool force) {
        make_new(path,
                 {.up_axis = up_axis,
                  .meters_per_unit = meters_per_unit,
                  .kilograms_per_unit = kilograms_per_unit,
                  .default_prim = default_prim,
                  .time_codes_per_second = time_codes_per_second,
                  .start_time_code = start_time_code,
                  .end_time_code = end_time_code},
                 force);
      },
      "path"_a, "up_axis"_a, "meters_per_unit"_a, "kilograms_per_unit"_a, "default_prim"_a,
      "time_codes_per_second"_a.none(), "start_time_code"_a.none(), "end_time_code"_a.none(),
      "force"_a,
      nb::sig("def new_asset(path: str | os.PathLike[str], up_axis: str, "
              "meters_per_unit: float, kilograms_per_unit: float, default_prim: str, "
              "time_codes_per_second: float | None, start_time_code: float | None, "
              "end_time_code: float | None, force: bool) -> None"));
  module.def("undo", &undo, "path"_a, "dry_run"_a,
             nb::sig("def undo(path: str | os.PathLike[str], dry_run: bool) -> dict[str, Any]"));
}

}  // namespace tenon::python
