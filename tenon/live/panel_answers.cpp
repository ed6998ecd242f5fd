// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the panels of pairs, drives, gains and poses show and set. Their tables are those of the
// verbs, made of the files on another thread; one at a time of each page tells how far it is and
// can be ended. Gains are set in the model as it runs, and are wishes for the verb's functions, so
// that tables, tests and what is saved are made of the same numbers.
#include <algorithm>
#include <array>
#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/asset/drives/drives_json.h"
#include "tenon/asset/pairs/pairs_json.h"
#include "tenon/asset/poses/pose_files.h"
#include "tenon/asset/poses/pose_json.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/tuning/tuned_json.h"
#include "tenon/dynamics/dynamics.h"
#include "tenon/live/move_joint.h"
#include "tenon/live/panel_wishes.h"
#include "tenon/live/session_state.h"
#include "tenon/math/angle.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::live {
namespace {

using PanelState = Session::State;

constexpr std::size_t kMostPoints = 500;  // of a signal of a test
constexpr double kMostFrequency = 1e6;    // [rad/s]
constexpr double kMostRatio = 1e3;
constexpr double kMostGain = 1e12;
constexpr double kLeastPeriod = 0.05;  // [s]
constexpr double kMostPeriod = 60;
constexpr double kLeastAmplitude = 1e-4;  // as a part of the range
constexpr std::array kLiveTests{tuning::TestKind::Snap, tuning::TestKind::Step,
                                tuning::TestKind::Sine};

/// The drives of the scene, computed when somebody asks first.
const std::vector<tuning::DriveRow>& rows_of_drives(PanelState& state) {
  if (!state.drive_rows) {
    const dynamics::Multibody multibody(state.asset.scene());
    const dynamics::Dynamics dynamics(multibody, multibody.start());
    state.drive_rows = tuning::drive_rows(multibody, dynamics);
  }
  return *state.drive_rows;
}

Result<const tuning::DriveRow*> row_of(PanelState& state, scene::Index joint, scene::Dof dof) {
  for (const tuning::DriveRow& row : rows_of_drives(state)) {
    if (row.joint == joint && row.dof == dof && row.drive) {
      if (!row.why_not.empty()) {
        return refused("its drive cannot be tuned: " + row.why_not, "choose another drive");
      }
      return &row;
    }
  }
  return refused("<" + state.asset.scene().joints[joint].path.str() + "> has no drive along " +
                     std::string(scene::dof_name(dof)),
                 "name one that the table of gains lists");
}

Result<void> check_range(const Asked& asked, const char* field, double least, double most) {
  if (asked.has(field) && !(asked.number(field) >= least && asked.number(field) <= most)) {
    return refused("`" + std::string(field) + "` is out of range",
                   "give a number from " + Json(least).dump() + " to " + Json(most).dump());
  }
  return {};
}

Result<void> check_gains(const Asked& asked) {
  TENON_CHECK(check_range(asked, "frequency", 0, kMostFrequency));
  TENON_CHECK(check_range(asked, "dampingRatio", 0, kMostRatio));
  TENON_CHECK(check_range(asked, "stiffness", 0, kMostGain));
  TENON_CHECK(check_range(asked, "damping", 0, kMostGain));
  const bool by_response = asked.has("frequency") || asked.has("dampingRatio");
  const bool by_gains = asked.has("stiffness") || asked.has("damping");
  if (by_response == by_gains) {
    return refused("gains are given either as a response or as numbers",
                   "give `frequency` and `dampingRatio`, or `stiffness` and `damping`");
  }
  return {};
}

/// What is asked for, over what the drive has now.
tuning::Gains asked_gains(const Asked& asked, const tuning::DriveRow& row,
                          const tuning::Gains& now) {
  if (asked.has("stiffness") || asked.has("damping")) {
    return {asked.number("stiffness", now.stiffness), asked.number("damping", now.damping)};
  }
  const bool responds = now.stiffness + row.load.passive.stiffness > 0;
  const tuning::Response known =
      responds ? tuning::response_of(now, row.load) : tuning::Response{0, 1};
  const tuning::Response wanted{asked.number("frequency", known.frequency),
                                asked.number("dampingRatio", known.ratio)};
  return tuning::gains_for(wanted, row.load).gains;
}

Json gains_answer(const PanelState& state, const tuning::DriveRow& row,
                  const tuning::Gains& gains) {
  Json json = {{"stiffness", gains.stiffness}, {"damping", gains.damping}};
  const bool responds = gains.stiffness + row.load.passive.stiffness > 0;
  const auto response =
      responds ? std::optional(tuning::response_of(gains, row.load)) : std::nullopt;
  json["frequency"] = response ? Json(response->frequency) : Json(nullptr);
  json["frequencyHz"] = response ? Json(response->frequency / (2 * kPi)) : Json(nullptr);
  json["dampingRatio"] = response ? Json(response->ratio) : Json(nullptr);
  json["regime"] =
      response ? Json(std::string(regime_name(tuning::regime_of(response->ratio)))) : Json(nullptr);
  const double most =
      tuning::stiffest_stable(tuning::stepping_of(state.asset.engine, state.asset.scene()),
                              response ? response->ratio : 1, state.asset.world->time_step());
  json["stableUpTo"] = answers::finite_or_null(most);
  return json;
}

Result<tuning::TestKind> live_test(const Asked& asked) {
  const auto kind = tuning::test_named(asked.text("test"));
  if (!kind || std::find(kLiveTests.begin(), kLiveTests.end(), *kind) == kLiveTests.end()) {
    return refused("`test` is not snap, step or sine", "name one of them");
  }
  return *kind;
}

}  // namespace

TuneOptions wished_tuning(const Session::State& state) {
  TuneOptions options;
  options.open = edit_options(state).open;
  options.readings = state.options.asset.readings;
  options.engine = state.asset.engine;
  options.time_step = state.options.asset.time_step;
  options.masks = state.options.asset.masks;
  for (const auto& [drive, gains] : state.gains) {
    DriveWish& wish = options.drive_wishes.emplace_back();
    wish.joint = drive.first;
    wish.dof = drive.second;
    wish.wish.stiffness = gains.stiffness;
    wish.wish.damping = gains.damping;
  }
  return options;
}

Result<Json> ask_pairs(Session::State& state, ClientNumber client, const Asked& asked, Outbox&) {
  TENON_TRY(const std::shared_ptr<Work> work, state.begin_work(client, "pairs"));
  BodyPairsOptions options;
  options.samples = asked.integer("postures", 1000);
  options.seed = asked.integer("seed", 0);
  options.environment = asked.flag("environment");
  options.all = asked.flag("all");
  options.progress = [work](std::size_t done, std::size_t of) {
    work->at(static_cast<double>(done) / static_cast<double>(of), "looking for contacts");
  };
  options.is_over = [work] { return work->is_ended(); };
  state.later = [options, open = edit_options(state).open,
                 path = state.options.asset.path]() -> Result<Json> {
    Diagnostics found;
    TENON_TRY(const PairsOfAsset pairs, pairs_of_asset(path, open, options, found));
    return pairs_json(pairs);
  };
  return Json();
}

Result<Json> ask_drives(Session::State& state, ClientNumber client, const Asked& asked, Outbox&) {
  TENON_TRY(const std::shared_ptr<Work> work, state.begin_work(client, "drives"));
  DrivesOptions options;
  options.open = edit_options(state).open;
  options.samples = asked.integer("postures", 100);
  options.seed = asked.integer("seed", 0);
  options.go_on = [work](std::size_t done, std::size_t of) {
    work->at(static_cast<double>(done) / static_cast<double>(of), "looking at postures");
    return !work->is_ended();
  };
  state.later = [options, path = state.options.asset.path]() -> Result<Json> {
    Diagnostics found;
    TENON_TRY(const DrivesOfAsset drives, drives_of_asset(path, options, found));
    return drives_json(drives);
  };
  return Json();
}

Result<Json> ask_gains(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  TuneOptions options = wished_tuning(state);
  options.force = true;  // it is a table
  state.later = [options, path = state.options.asset.path]() -> Result<Json> {
    Diagnostics found;
    TENON_TRY(const TunedAsset tuned, tune_asset(path, options, found));
    return tuned_json(tuned);
  };
  return Json();
}

Result<Json> set_live_gains(Session::State& state, ClientNumber, const Asked& asked, Outbox&) {
  TENON_CHECK(state.world());
  TENON_TRY(const scene::Index joint, state.joint(asked.path("joint")));
  const auto dof = scene::dof_of(asked.text("dof"));
  if (!dof) {
    return refused("`dof` names no degree of freedom", "name one as the table of gains does");
  }
  TENON_CHECK(check_gains(asked));
  TENON_TRY(const tuning::DriveRow* row, row_of(state, joint, *dof));
  const auto key = std::make_pair(state.asset.scene().joints[joint].path, *dof);
  const auto known = state.gains.find(key);
  const tuning::Gains now = known == state.gains.end() ? row->gains : known->second;
  const tuning::Gains wanted = asked_gains(asked, *row, now);
  TENON_CHECK(state.set_gains(joint, *dof, wanted));
  state.gains[key] = wanted;
  state.act();
  return gains_answer(state, *row, wanted);
}

Result<Json> forget_gains(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  for (const auto& [drive, gains] : std::exchange(state.gains, {})) {
    if (const auto joint = state.joint(drive.first)) {
      const std::vector<scene::Drive>& drives = state.asset.scene().joints[*joint].drives;
      for (const scene::Drive& own : drives) {
        if (own.dof == drive.second && state.asset.world) {
          TENON_CHECK(state.set_gains(*joint, drive.second, {own.stiffness, own.damping}));
        }
      }
    }
  }
  return Json::object();
}

Result<Json> test_live_drives(Session::State& state, ClientNumber client, const Asked& asked,
                              Outbox&) {
  TENON_TRY(const tuning::TestKind kind, live_test(asked));
  TENON_CHECK(check_range(asked, "period", kLeastPeriod, kMostPeriod));
  TENON_CHECK(check_range(asked, "amplitude", kLeastAmplitude, 1));
  TENON_TRY(const std::shared_ptr<Work> work, state.begin_work(client, "testDrives"));
  TuneOptions options = wished_tuning(state);
  options.force = true;  // what is unstable is a result
  options.test = kind;
  for (const Path& joint : asked.paths("joints")) {
    options.joints.push_back(joint.str());
  }
  if (asked.has("period") && kind != tuning::TestKind::Snap) {
    options.test_options.period = asked.number("period");
  }
  if (asked.has("amplitude") && kind != tuning::TestKind::Snap) {
    options.test_options.amplitude = asked.number("amplitude");
  }
  options.listener.go_on = [work](double seconds, double duration) {
    work->at(duration > 0 ? std::min(seconds / duration, 1.0) : 0, "testing");
    return !work->is_ended();
  };
  options.found = [work, kind](const TunedEngine& engine, const tuning::DriveTestResult& result) {
    work->found({{"is", "tested"},
                 {"engine", engine.engine},
                 {"test", std::string(test_name(kind))},
                 {"result", tested_json(engine, result, kMostPoints)}});
  };
  state.later = [options, path = state.options.asset.path]() -> Result<Json> {
    Diagnostics found;
    TENON_TRY(const TunedAsset tuned, tune_asset(path, options, found));
    Json json = tuned_json(tuned);
    json["interrupted"] = tuned.interrupted();
    return json;
  };
  return Json();
}

Result<Json> cancel_work(Session::State& state, ClientNumber client, const Asked&, Outbox&) {
  for (const std::shared_ptr<Work>& work : state.works) {
    if (work->client() == client) {
      work->end();
    }
  }
  return Json::object();
}

// ---- poses

Result<Json> ask_poses(Session::State& state, ClientNumber, const Asked&, Outbox&) {
  state.later = [open = edit_options(state).open, readings = state.options.asset.readings,
                 path = state.options.asset.path]() -> Result<Json> {
    Diagnostics found;
    TENON_TRY(const PoseOfAsset pose, pose_of_asset(path, open, readings, {}, found));
    Json json = named_poses_json(pose);
    json["file"] = poses_file(pose);
    return json;
  };
  return Json();
}

namespace {

/// Drives that hold positions of a joint are to hold this one.
Result<void> hold_at(PanelState& state, scene::Index index, double position) {
  const scene::Joint& joint = state.asset.scene().joints[index];
  for (scene::Index i = 0; i < joint.drives.size(); ++i) {
    if (joint.drives[i].stiffness > 0) {
      const engines::DriveTarget target{position, 0};
      TENON_CHECK(state.asset.world->set_drive_target(index, i, target));
      state.targets[std::make_pair(joint.path, i)] = target;
    }
  }
  return {};
}

}  // namespace

Result<Json> go_to_pose(Session::State& state, ClientNumber, const Asked& asked, Outbox& out) {
  TENON_TRY(engines::World * world, state.world());
  TENON_CHECK(state.check_not_stopped());
  const bool hold = asked.flag("hold");
  if (state.playing && !hold) {
    return refused("the simulation is running: joints are moved by hand while it is paused",
                   "pause first, or let the drives go there");
  }
  const scene::PhysicsScene& scene = state.asset.scene();
  const dynamics::Multibody multibody(scene);
  TENON_TRY(const physics::NamedPose named,
            named_pose(physics::named_poses(*state.asset.stage), asked.path("pose").str()));
  TENON_TRY(const dynamics::Posture posture,
            posture_from_texts(*state.asset.stage, multibody, {named.path.str()}));
  std::size_t moved = 0;
  for (const physics::NamedPoseJoint& one : named.joints) {
    const auto index = state.joint(one.joint);
    if (!index || !scene.joints[*index].mimics.empty() ||
        world->joint_state(*index).position.size() != 1) {
      continue;
    }
    const std::vector<double>& position = posture.joints[*index];
    if (!state.playing) {
      TENON_CHECK(move_joint(state.asset, *index, position));
    }
    if (hold) {
      TENON_CHECK(hold_at(state, *index, position.front()));
    }
    ++moved;
  }
  state.act();
  state.moved = true;
  state.tell_observers(out);
  return Json{{"joints", moved}};
}

}  // namespace tenon::live
