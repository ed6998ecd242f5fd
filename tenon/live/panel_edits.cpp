// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the panels write: pairs, limits, gains, poses and fixes of findings. Each makes the edits of
// its verb and goes the way of every edit of the session; with "dryRun" it tells the difference
// alone. Nothing here takes a name of a file from a page.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/asset/checking/check_assets.h"
#include "tenon/asset/drives/drives_asset.h"
#include "tenon/asset/edit_request.h"
#include "tenon/asset/pairs/pairs_edits.h"
#include "tenon/asset/poses/pose_edits.h"
#include "tenon/asset/poses/pose_files.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/live/panel_wishes.h"
#include "tenon/live/session_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::live {
namespace {

using PageState = Session::State;

std::vector<std::string> pairs_of_rows(const Asked& asked, const char* field) {
  std::vector<std::string> pairs;
  for (const Asked& row : asked.rows(field)) {
    pairs.push_back(row.path("bodyA").str() + "," + row.path("bodyB").str());
  }
  return pairs;
}

Result<std::optional<double>> limit_of_row(const Asked& row, const char* field) {
  if (!row.has(field)) {
    return std::optional<double>();
  }
  const double value = row.number(field);
  if (!(value > 0)) {
    return refused("`" + std::string(field) + "` of <" + row.text("joint") + "> is not above 0",
                   "give a number above 0, or leave it out");
  }
  return std::optional(value);
}

/// The asset as it is in its files.
Result<PoseOfAsset> pose_in_files(const PageState& state) {
  Diagnostics found;
  return pose_of_asset(state.options.asset.path, edit_options(state).open,
                       state.options.asset.readings, {}, found);
}

/// Where the bodies of the session are.
Result<std::vector<Pose>> live_bodies(PageState& state, const scene::PhysicsScene& scene) {
  TENON_TRY(engines::World * world, state.world());
  const std::vector<scene::Body>& known = state.asset.scene().bodies;
  const bool same = std::equal(scene.bodies.begin(), scene.bodies.end(), known.begin(), known.end(),
                               [](const auto& a, const auto& b) { return a.path == b.path; });
  if (!same) {
    return Error(ErrorCode::Invalid, "the bodies of the files are no longer those that are shown")
        .with_rule("live.file-changed")
        .with_fix("open the asset again, then save the pose");
  }
  std::vector<Pose> bodies;
  for (scene::Index i = 0; i < known.size(); ++i) {
    bodies.push_back(world->body_state(i).pose);
  }
  return bodies;
}

Result<Json> make_pose_edits(PageState& state, const std::vector<AssetEdit>& edits,
                             const Asked& asked, Outbox& out) {
  return make_edits(state, edits, edit_options(state), MayRest::Yes, asked.flag("dryRun"), out);
}

bool is_asked_for(const Diagnostic& finding, const Asked& asked) {
  const auto same = [&](const char* field, const std::string& value) {
    return !asked.has(field) || asked.text(field) == value;
  };
  const bool in_line = !asked.has("line") || asked.integer("line") == finding.line;
  return same("rule", finding.rule) && same("prim", finding.prim) &&
         same("property", finding.property) && in_line &&
         (!asked.has("file") || asked.text("file") == shown_path(finding.file));
}

}  // namespace

Result<Json> filter_pairs(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  PairsRequest request;
  request.filter = pairs_of_rows(asked, "filter");
  request.unfilter = pairs_of_rows(asked, "unfilter");
  read_anew();
  const EditOptions options = edit_options(state);
  Diagnostics found;
  TENON_TRY(const PairsOfAsset pairs,
            bodies_of_asset(state.options.asset.path, options.open, found));
  TENON_TRY(const PairsEdits made,
            pairs_edits(state.options.asset.path, pairs, request, options, found));
  return make_edits(state, made.edits, options, MayRest::No, asked.flag("dryRun"), out);
}

Result<Json> set_limits(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  DrivesOptions options;
  options.open = edit_options(state).open;
  for (const Asked& row : asked.rows("limits")) {
    WantedLimits& wanted = options.limits.emplace_back();
    const auto dof = scene::dof_of(row.text("dof"));
    if (!dof) {
      return refused("`dof` of <" + row.text("joint") + "> names no degree of freedom",
                     "name one as the table of drives does");
    }
    wanted.joint = row.path("joint");
    wanted.dof = *dof;
    TENON_TRY(wanted.effort, limit_of_row(row, "maxEffort"));
    TENON_TRY(wanted.speed, limit_of_row(row, "speedLimit"));
  }
  read_anew();
  Diagnostics found;
  TENON_TRY(const DrivesOfAsset drives, drives_of_asset(state.options.asset.path, options, found));
  return make_edits(state, drives.edits, edit_options(state), MayRest::No, asked.flag("dryRun"),
                    out);
}

Result<Json> save_gains(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  Diagnostics found;
  const std::string& path = state.options.asset.path;
  TENON_TRY(const TunedAsset tuned, tune_asset(path, wished_tuning(state), found));
  const EditOptions options = edit_options(state);
  std::vector<AssetEdit> edits;
  if (!tuned.request.drive.empty()) {
    TENON_TRY(edits, read_edits(path, tuned.request, options));
  }
  const bool dry_run = asked.flag("dryRun");
  auto kept = dry_run ? state.gains : std::exchange(state.gains, {});
  auto done = make_edits(state, edits, options, MayRest::No, dry_run, out);
  if (!done) {
    state.gains = std::move(kept);
  }
  return done;
}

Result<Json> save_pose(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  TENON_TRY(PoseOfAsset pose, pose_in_files(state));
  TENON_TRY(const std::vector<Pose> bodies, live_bodies(state, *pose.scene));
  pose.posture = posture_of_bodies(*pose.multibody, bodies);
  TENON_TRY(const Path robot, robot_of_poses(pose, ""));
  Diagnostics found;
  TENON_TRY(const physics::NamedPose saved, pose_to_save(pose, robot, asked.text("name"), found));
  TENON_TRY(const std::vector<AssetEdit> edits, save_edits(pose, robot, {saved}));
  return make_pose_edits(state, edits, asked, out);
}

Result<Json> rename_pose(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  TENON_TRY(const PoseOfAsset pose, pose_in_files(state));
  TENON_TRY(const std::vector<AssetEdit> edits,
            rename_edits(pose, asked.path("pose").str() + "=" + asked.text("name")));
  return make_pose_edits(state, edits, asked, out);
}

Result<Json> remove_pose(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  TENON_TRY(const PoseOfAsset pose, pose_in_files(state));
  TENON_TRY(const std::vector<AssetEdit> edits, removal_edits(pose, {asked.path("pose").str()}));
  return make_pose_edits(state, edits, asked, out);
}

Result<Json> import_poses(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  TENON_TRY(const PoseOfAsset pose, pose_in_files(state));
  TENON_TRY(const Path robot, robot_of_poses(pose, ""));
  TENON_TRY(const std::vector<physics::NamedPose> saved,
            poses_of_text(pose, robot, asked.text("text")));
  TENON_TRY(const std::vector<AssetEdit> edits, save_edits(pose, robot, saved));
  return make_pose_edits(state, edits, asked, out);
}

Result<Json> apply_fixes(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  read_anew();
  CheckAssetsOptions options;
  options.check.open = state.options.asset.open;
  options.check.readings = state.options.asset.readings;
  options.correct = true;
  options.suggested = asked.flag("suggested");
  options.wanted = [&asked](const check::Finding& finding) {
    return is_asked_for(finding.diagnostic, asked);
  };
  TENON_TRY(CheckedAssets checked, check_assets({state.options.asset.path}, options));
  EditedAsset made;
  made.files = std::move(checked.corrected);
  if (made.files.empty()) {
    return Error(ErrorCode::NotFound, "no finding that is meant has a fix")
        .with_rule("live.no-fix")
        .with_fix("check the asset again: it may have changed");
  }
  return write_made(state, {}, made, asked.flag("dryRun"), out);
}

}  // namespace tenon::live
