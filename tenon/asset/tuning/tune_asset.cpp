// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The table is of the asset as it opens; each engine that is asked about opens it once more under
// its own variant, as `compare` does. What is wished for is computed on the table's scene and put
// into the scenes of the engines by the path of the joint, as the edit will do in the files.
#include "tenon/asset/tuning/tune_asset.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/asset/physics_options.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/asset/tuning/search_scenes.h"
#include "tenon/asset/tuning/tuned_units.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/dynamics/posture_text.h"
#include "tenon/engines/time_step.h"
#include "tenon/make_simulation.h"
#include "tenon/math/angle.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

using tuning::DriveRow;

struct ReadDrives {
  stage::Stage stage;
  std::unique_ptr<scene::PhysicsScene> scene;
  std::vector<DriveRow> rows;
};

Result<ReadDrives> read_drives(const std::string& path, const OpenOptions& open,
                               const TuneOptions& options, Diagnostics& diagnostics) {
  TENON_TRY(stage::Stage stage,
            tenon::open(path, with_readings(open, options.readings), diagnostics));
  auto scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(stage, read_options(options.readings), diagnostics));
  TENON_CHECK(dynamics::apply_masks(options.masks, *scene, diagnostics));
  dynamics::start_inside_limits(*scene);
  std::vector<DriveRow> rows = drive_rows_of(*scene);
  return ReadDrives{std::move(stage), std::move(scene), std::move(rows)};
}

Error no_joint(const std::string& pattern, const std::vector<TunedDrive>& drives) {
  constexpr std::size_t kNamed = 8;
  std::string names;
  for (std::size_t i = 0; i < std::min(drives.size(), kNamed); ++i) {
    names += (names.empty() ? "" : ", ") + drives[i].joint.name().str();
  }
  names += drives.size() > kNamed ? " and " + std::to_string(drives.size() - kNamed) + " more" : "";
  return Error(ErrorCode::NotFound, "no joint is \"" + pattern + "\"")
      .with_rule("tune.no-joint")
      .with_fix(drives.empty() ? "select a variant of \"Physics\" that has joints"
                               : "name one, or give a regular expression for the whole name or "
                                 "path: " +
                                     names);
}

/// Which drives each of the patterns means; an error for one that means none.
Result<std::vector<std::vector<std::size_t>>> matches_of(const std::vector<std::string>& patterns,
                                                         const std::vector<TunedDrive>& drives) {
  std::vector<std::vector<std::size_t>> matches;
  for (const std::string& text : patterns) {
    TENON_TRY(const NamePattern pattern, NamePattern::parse(text));
    std::vector<std::size_t>& found = matches.emplace_back();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      if (pattern.matches(drives[i].joint)) {
        found.push_back(i);
      }
    }
    if (found.empty()) {
      return no_joint(text, drives);
    }
  }
  return matches;
}

// ---- wishes

std::string torque_unit(const DriveRow& row, const char* more) {
  return (is_angular(row.dof) ? "N m" : "N") + std::string(more) +
         (is_angular(row.dof) ? "/rad" : "/m");
}

/// A wish as stiffness and damping; a half of it that is not given stays as it is.
Result<tuning::Gains> wished_gains(const GainWish& wish, TunedDrive& drive) {
  const DriveRow& row = drive.row;
  tuning::Gains gains{wish.stiffness.value_or(row.gains.stiffness),
                      wish.damping.value_or(row.gains.damping)};
  if (!wish.frequency && !wish.damping_ratio) {
    return gains;
  }
  const auto now = gains.stiffness + row.load.passive.stiffness > 0
                       ? std::optional(tuning::response_of(gains, row.load))
                       : std::nullopt;
  if (!wish.frequency && !now) {
    return Error(ErrorCode::Invalid, "the drive has no stiffness, so a damping ratio says nothing")
        .with_prim(drive.joint.str())
        .with_rule("tune.no-ratio")
        .with_fix("give a frequency, too");
  }
  if (!wish.damping_ratio && !wish.damping && !now) {
    return Error(ErrorCode::Invalid, "the drive has no damping ratio to keep")
        .with_prim(drive.joint.str())
        .with_rule("tune.no-ratio")
        .with_fix("give one, too: --damping-ratio 1 (in a file of gains: damping_ratio)");
  }
  const tuning::Response wanted{wish.frequency.value_or(now ? now->frequency : 0),
                                wish.damping_ratio.value_or(now ? now->ratio : 0)};
  const tuning::WantedGains found = tuning::gains_for(wanted, row.load);
  gains.stiffness = wish.frequency ? found.gains.stiffness : gains.stiffness;
  gains.damping = wish.damping ? *wish.damping : found.gains.damping;
  if (found.stiffness_is_least && wish.frequency) {
    drive.notes.push_back("the joint's own spring of " +
                          rounded_text(row.load.passive.stiffness, 4) + " " + torque_unit(row, "") +
                          " is stiffer than asked for: the drive's is 0");
  }
  if (found.damping_is_least && !wish.damping) {
    drive.notes.push_back("the joint's own damping of " +
                          rounded_text(row.load.passive.damping, 4) + " " + torque_unit(row, " s") +
                          " is more than asked for: the drive's is 0");
  }
  return gains;
}

/// What the others of a wish were given goes below what a later one says.
void put_over(const GainWish& wish, GainWish& sum) {
  if (wish.frequency || wish.stiffness) {
    sum.frequency = wish.frequency;
    sum.stiffness = wish.stiffness;
  }
  if (wish.damping_ratio || wish.damping) {
    sum.damping_ratio = wish.damping_ratio;
    sum.damping = wish.damping;
  }
}

/// The wish of each drive; `named`: by a pattern of the file or of the options.
struct DriveWishes {
  std::vector<GainWish> wishes;  // (drive_count)
  std::vector<char> named;       // (drive_count)
};

Result<DriveWishes> wishes_of(const TuneOptions& options, const std::vector<TunedDrive>& drives) {
  DriveWishes found{std::vector<GainWish>(drives.size()), std::vector<char>(drives.size(), 0)};
  if (!options.gains_file.empty()) {
    TENON_TRY(const std::vector<PatternWish> read,
              read_gain_file(options.gains_file, options.open.files));
    for (const PatternWish& one : read) {
      bool any = false;
      for (std::size_t i = 0; i < drives.size(); ++i) {
        if (one.joints.matches(drives[i].joint)) {
          any = true;
          found.named[i] = 1;
          put_over(one.wish, found.wishes[i]);
        }
      }
      if (!any) {
        return no_joint(one.joints.text(), drives).in_file(options.gains_file).at(one.line, 1);
      }
    }
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (drives[i].asked) {
      put_over(options.wish, found.wishes[i]);
    }
    found.named[i] = found.named[i] != 0 || !options.joints.empty() ? 1 : 0;
    for (const DriveWish& one : options.drive_wishes) {
      if (one.joint == drives[i].joint && one.dof == drives[i].row.dof) {
        put_over(one.wish, found.wishes[i]);
        found.named[i] = 1;
      }
    }
  }
  return found;
}

Result<void> add_wishes(const TuneOptions& options, const TunedUnits& units, TunedAsset& tuned) {
  TENON_TRY(const DriveWishes wishes, wishes_of(options, tuned.drives));
  tuned.wished = !options.wish.empty() || !options.gains_file.empty() ||
                 !options.drive_wishes.empty() || options.search;
  for (std::size_t i = 0; i < tuned.drives.size(); ++i) {
    TunedDrive& drive = tuned.drives[i];
    const GainWish& wish = wishes.wishes[i];
    if (wish.empty() || !drive.row.drive || !drive.row.why_not.empty()) {
      continue;
    }
    if (drive.row.velocity_drive && wishes.named[i] == 0) {
      drive.notes.emplace_back("it follows velocities: not tuned unless --joints names it");
      continue;
    }
    TENON_TRY(const tuning::Gains gains, wished_gains(wish, drive));
    drive.to_authored = units.rounded(drive.row, gains);
    DriveRow& to = drive.to.emplace(drive.row);
    to.gains = units.to_si(to, drive.to_authored);
    to.velocity_drive = to.gains.stiffness == 0 && to.gains.damping > 0;
    to.response.reset();
    if (to.gains.stiffness + to.load.passive.stiffness > 0) {
      to.response = tuning::response_of(to.gains, to.load);
    }
  }
  return {};
}

void add_drive_request(TunedAsset& tuned) {
  for (const TunedDrive& drive : tuned.drives) {
    if (drive.changes()) {
      const scene::Joint& joint = tuned.scene->joints[drive.row.joint];
      tuned.request.drive.push_back(drive_request(joint, drive.row.dof, drive.to_authored));
    }
  }
  tuned.request.all_engines = true;
}

// ---- engines

/// The gains that are to be go into the scene of an engine.
void put_gains(const std::vector<TunedDrive>& drives, TunedEngine& engine) {
  bool changed = false;
  for (const TunedDrive& drive : drives) {
    if (!drive.to) {
      continue;
    }
    for (scene::Joint& joint : engine.scene->joints) {
      if (!(joint.path == drive.joint)) {
        continue;
      }
      for (scene::Drive& one : joint.drives) {
        if (one.dof == drive.row.dof) {
          one.stiffness = drive.to->gains.stiffness;
          one.damping = drive.to->gains.damping;
          changed = true;
        }
      }
    }
  }
  if (changed) {
    engine.rows = drive_rows_of(*engine.scene);
  }
}

Result<TunedEngine> open_engine(const std::string& path, const std::string& name,
                                const ReadDrives& table, const TuneOptions& options) {
  TunedEngine engine;
  engine.engine = name;
  engine.version = engine_info(name).version;
  OpenOptions open = options.open;
  engine.variant = select_own_variant(name, table.stage, open);
  Diagnostics ignored;  // the table's are told
  TENON_TRY(ReadDrives read, read_drives(path, open, options, ignored));
  engine.scene = std::move(read.scene);
  engine.rows = std::move(read.rows);
  engines::SimulationOptions simulation;
  simulation.time_step = options.time_step;
  engine.time_step =
      engines::choose_time_step(*engine.scene, simulation, name, "tune.step", ignored);
  return engine;
}

/// What the step of an engine makes of the response of a drive.
Result<void> judge_sampling(const TuneOptions& options, const TunedEngine& engine,
                            TunedDrive& drive, Diagnostics& diagnostics) {
  const DriveRow& row = drive.to ? *drive.to : drive.row;
  if (!row.response || !row.why_not.empty()) {
    return {};
  }
  const double most = tuning::stiffest_stable(tuning::stepping_of(engine.engine, *engine.scene),
                                              row.response->ratio, engine.time_step);
  if (row.response->frequency > most) {
    Error error =
        Error(ErrorCode::Invalid, rounded_text(row.response->frequency / (2 * kPi), 4) +
                                      " Hz is unstable on " + engine.engine + " with steps of " +
                                      rounded_text(engine.time_step, 4) + " s, which hold up to " +
                                      rounded_text(most / (2 * kPi), 4) + " Hz")
            .with_prim(drive.joint.str())
            .with_rule("tune.unstable")
            .with_fix("give a lower --frequency or a smaller time step, or --force");
    if (drive.to && !options.force) {
      return error;
    }
    Diagnostic finding = error.diagnostic();
    finding.severity = Severity::Warning;
    diagnostics.add(std::move(finding));
    return {};
  }
  const std::string note = tuning::sampling_note(row.response->frequency, engine.time_step);
  if (!note.empty() &&
      std::find(drive.notes.begin(), drive.notes.end(), note) == drive.notes.end()) {
    drive.notes.push_back(note);
  }
  return {};
}

// ---- tests

/// Groups of rows of an engine by the drives of the table.
std::vector<std::vector<std::size_t>> groups_on(
    const TunedAsset& tuned, const TunedEngine& engine,
    const std::vector<std::vector<std::size_t>>& groups) {
  std::vector<std::vector<std::size_t>> found;
  for (const auto& group : groups) {
    auto& rows = found.emplace_back();
    for (const std::size_t i : group) {
      for (std::size_t r = 0; r < engine.rows.size(); ++r) {
        if (engine.scene->joints[engine.rows[r].joint].path == tuned.drives[i].joint &&
            engine.rows[r].dof == tuned.drives[i].row.dof) {
          rows.push_back(r);
        }
      }
    }
  }
  return found;
}

Result<std::vector<std::vector<std::size_t>>> test_groups(const TuneOptions& options,
                                                          const TunedAsset& tuned) {
  if (!options.sequence.empty()) {
    return matches_of(options.sequence, tuned.drives);
  }
  std::vector<std::vector<std::size_t>> groups;
  const bool together = options.test == tuning::TestKind::Stress;
  for (std::size_t i = 0; i < tuned.drives.size(); ++i) {
    if (!tuned.drives[i].asked) {
      continue;
    }
    if (groups.empty() || !together) {
      groups.emplace_back();
    }
    groups.back().push_back(i);
  }
  return groups;
}

Result<void> test_engine(const TuneOptions& options, const TunedAsset& tuned,
                         const std::vector<std::vector<std::size_t>>& groups, TunedEngine& engine,
                         Diagnostics& diagnostics) {
  tuning::DriveTestOptions test = options.test_options;
  test.kind = *options.test;
  test.groups = groups_on(tuned, engine, groups);
  test.time_step = options.time_step;
  if (options.listener.next_part) {
    options.listener.next_part("testing on " + engine.engine);
    test.next_part = [&](const std::string& what) {
      options.listener.next_part(engine.engine + ": " + what);
    };
  }
  test.go_on = options.listener.go_on;
  if (options.found) {
    test.found = [&](const tuning::DriveTestResult& result) { options.found(engine, result); };
  }
  Diagnostics found;
  const tuning::MakeSimulation make = [&](const scene::PhysicsScene& scene,
                                          const engines::SimulationOptions& simulation) {
    Diagnostics all;  // of reruns the same
    auto made = make_simulation(engine.engine, scene, simulation, all);
    found = found.empty() ? all : found;
    return made;
  };
  TENON_TRY(engine.tests, tuning::test_drives(*engine.scene, engine.rows, make, test));
  for (const Diagnostic& finding : found) {
    if (finding.severity != Severity::Info) {
      diagnostics.add(finding);
    }
  }
  return {};
}

/// What was found, as wishes; where nothing meets the goal, a note.
void wish_found(TunedAsset& tuned, std::vector<DriveWish>& wishes) {
  for (const SearchedRow& row : tuned.search->drives) {
    TunedDrive& drive = tuned.drives[row.drive];
    if (!row.found.met) {
      drive.notes.emplace_back("no gains were found that meet the goal");
      continue;
    }
    DriveWish& one = wishes.emplace_back();
    one.joint = drive.joint;
    one.dof = drive.row.dof;
    one.wish.frequency = row.found.response.frequency;
    one.wish.damping_ratio = row.found.response.ratio;
  }
}

}  // namespace

std::vector<DriveRow> drive_rows_of(const scene::PhysicsScene& scene) {
  const dynamics::Multibody multibody(scene);
  const dynamics::Dynamics dynamics(multibody, multibody.start());
  return tuning::drive_rows(multibody, dynamics);
}

bool TunedDrive::changes() const {
  return to &&
         (to_authored.stiffness != authored.stiffness || to_authored.damping != authored.damping);
}

bool TunedAsset::interrupted() const {
  const bool tests = std::any_of(engines.begin(), engines.end(), [](const TunedEngine& engine) {
    return engine.tests && engine.tests->interrupted;
  });
  return tests || (search && search->interrupted);
}

bool TunedAsset::has(tuning::Verdict verdict) const {
  return std::any_of(engines.begin(), engines.end(), [verdict](const TunedEngine& engine) {
    return engine.tests && engine.tests->has(verdict);
  });
}

Result<TunedAsset> tune_asset(const std::string& path, const TuneOptions& options,
                              Diagnostics& diagnostics) {
  TENON_TRY(ReadDrives table, read_drives(path, options.open, options, diagnostics));
  const TunedUnits units(table.stage, options.readings);
  TunedAsset tuned;
  for (const DriveRow& row : table.rows) {
    TunedDrive& drive = tuned.drives.emplace_back();
    drive.joint = table.scene->joints[row.joint].path;
    drive.row = row;
    drive.authored = row.drive ? units.rounded(row, row.gains) : tuning::Gains{};
    drive.asked = options.joints.empty();
  }
  tuned.scene = std::move(table.scene);
  TENON_TRY(const auto asked, matches_of(options.joints, tuned.drives));
  for (const auto& group : asked) {
    for (const std::size_t i : group) {
      tuned.drives[i].asked = true;
    }
  }
  TENON_TRY(const auto names, chosen_engines(options.engine, table.stage, diagnostics));
  std::vector<TunedEngine> engines;
  for (const std::string& name : names) {
    TENON_TRY(TunedEngine engine, open_engine(path, name, table, options));
    engines.push_back(std::move(engine));
  }
  TuneOptions wanted = options;
  if (options.search) {
    TENON_TRY(tuned.search, search_drives(options, table.stage, tuned, engines));
    wish_found(tuned, wanted.drive_wishes);
  }
  TENON_CHECK(add_wishes(wanted, units, tuned));
  add_drive_request(tuned);
  TENON_TRY(const auto groups, test_groups(options, tuned));
  for (TunedEngine& engine : engines) {
    put_gains(tuned.drives, engine);
    for (TunedDrive& drive : tuned.drives) {
      TENON_CHECK(judge_sampling(options, engine, drive, diagnostics));
    }
    if (options.test && !tuned.interrupted()) {
      TENON_CHECK(test_engine(options, tuned, groups, engine, diagnostics));
    }
    tuned.engines.push_back(std::move(engine));
  }
  return tuned;
}

}  // namespace tenon
