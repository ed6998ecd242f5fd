// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Groups run one after the other on one simulation, which is reset between them. What a test would
// record at most is counted before its first step, since all of it stays in memory.
#include "tenon/tuning/drive_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/vector.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

using Groups = std::vector<std::vector<std::size_t>>;

struct NamedTest {
  TestKind kind;
  std::string_view name;
  Result<void> (*run)(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests);
};

constexpr std::array kTests{
    NamedTest{TestKind::Snap, "snap", run_snap},
    NamedTest{TestKind::Step, "step", run_step},
    NamedTest{TestKind::Sine, "sine", run_sine},
    NamedTest{TestKind::Stress, "stress", run_stress},
    NamedTest{TestKind::Steps, "steps", run_steps},
};

/// Of one group at most [s].
double seconds_of(const DriveTestOptions& options) {
  switch (options.kind) {
    case TestKind::Snap:
      return 32;
    case TestKind::Step:
      return 5 + options.period.value_or(2);
    case TestKind::Steps:
      return 6 * (5 + options.period.value_or(2));
    case TestKind::Sine:
      return options.duration.value_or(4 * options.period.value_or(2));
    case TestKind::Stress:
      break;
  }
  return options.duration.value_or(10);
}

bool can_be_tested(const scene::PhysicsScene& scene, const DriveRow& row,
                   const DriveTestOptions& options) {
  return row.position_drive() && (options.kind != TestKind::Snap || !range_of(scene, row, 0).open);
}

/// Groups of drives that can be tested, without those that cannot.
Groups groups_of(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                 const DriveTestOptions& options) {
  Groups groups = options.groups;
  if (groups.empty()) {
    groups.resize(options.kind == TestKind::Stress ? 1 : rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      groups[options.kind == TestKind::Stress ? 0 : i].push_back(i);
    }
  }
  for (auto& group : groups) {
    std::erase_if(group, [&](std::size_t i) {
      return i >= rows.size() || !can_be_tested(scene, rows[i], options);
    });
  }
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

Result<void> check_length(const Groups& groups, const DriveTestOptions& options, double step) {
  std::size_t drives = 0;
  for (const auto& group : groups) {
    drives += group.size();
  }
  const double samples = static_cast<double>(drives) * seconds_of(options) / step;
  if (samples > static_cast<double>(limits::kRecordedStates)) {
    return Error(ErrorCode::Limit, "the test may record " + shortest(std::ceil(samples)) +
                                       " states of drives; the limit is " +
                                       std::to_string(limits::kRecordedStates))
        .with_rule("tune.too-long")
        .with_fix("give a larger --dt, fewer --joints, or a shorter --period and --duration");
  }
  return {};
}

/// Why drives that were asked for are not tested.
void add_skipped(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                 const DriveTestOptions& options, DriveTests& tests) {
  std::vector<char> asked(rows.size(), options.groups.empty() ? 1 : 0);
  for (const auto& group : options.groups) {
    for (const std::size_t i : group) {
      asked[i] = 1;
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const DriveRow& row = rows[i];
    if (asked[i] == 0 || !row.drive || can_be_tested(scene, row, options)) {
      continue;
    }
    DriveTestResult result;
    result.row = i;
    result.reasons.push_back(!row.why_not.empty()      ? row.why_not
                             : row.gains.stiffness > 0 ? "it has no limits to go to"
                             : row.velocity_drive ? "it follows velocities: it has no stiffness"
                                                  : "it has no stiffness");
    tests.results.push_back(std::move(result));
  }
}

}  // namespace

std::string_view test_name(TestKind kind) { return kTests[static_cast<std::size_t>(kind)].name; }

std::optional<TestKind> test_named(std::string_view name) {
  for (const NamedTest& test : kTests) {
    if (test.name == name) {
      return test.kind;
    }
  }
  return std::nullopt;
}

std::vector<std::string> test_names() {
  std::vector<std::string> names;
  for (const NamedTest& test : kTests) {
    names.emplace_back(test.name);
  }
  return names;
}

std::string_view verdict_name(Verdict verdict) {
  constexpr std::array<std::string_view, 5> kNames{"pass", "fail", "blocked", "unstable",
                                                   "skipped"};
  return kNames[static_cast<std::size_t>(verdict)];
}

bool DriveTests::has(Verdict verdict) const {
  return std::any_of(results.begin(), results.end(),
                     [verdict](const auto& result) { return result.verdict == verdict; });
}

DriveRange range_of(const scene::PhysicsScene& scene, const DriveRow& row, double home) {
  const scene::Limit limit = scene::limit_of(scene.joints[row.joint], row.dof);
  const double room = is_angular(row.dof) ? 1 : 0.1;
  DriveRange range{limit.lower, limit.upper, false};
  if (!std::isfinite(range.lower) || !std::isfinite(range.upper)) {
    range.open = true;
    const double middle = std::clamp(home, std::max(range.lower, -1e9), std::min(range.upper, 1e9));
    range.lower = std::max(range.lower, middle - room);
    range.upper = std::min(range.upper, middle + room);
  }
  return range;
}

scene::PhysicsScene without_self_collision(const scene::PhysicsScene& scene) {
  scene::PhysicsScene apart = scene;
  const scene::JointForest forest = scene::joint_forest(scene);
  scene::CollisionFilter& filter = apart.filter;
  filter.sets_of_collider.resize(scene.colliders.size());
  Index next = 0;
  for (const auto& sets : filter.sets_of_collider) {
    for (const Index set : sets) {
      next = std::max(next, set + 1);
    }
  }
  for (const scene::SetPairs* pairs : {&filter.sets_off, &filter.permanent_sets_off}) {
    for (const auto& [first, second] : *pairs) {
      next = std::max({next, first + 1, second + 1});
    }
  }
  for (const scene::JointPairs& of : filter.joint_pairs) {
    for (const auto& [first, second] : of.sets) {
      next = std::max({next, first + 1, second + 1});
    }
  }
  std::vector<char> used(scene.bodies.size(), 0);  // by island
  for (Index c = 0; c < scene.colliders.size(); ++c) {
    const auto& body = scene.colliders[c].body;
    if (body && *body < forest.bodies.size()) {
      const Index island = forest.bodies[*body].island;
      used[island] = 1;
      filter.sets_of_collider[c].push_back(next + island);  // above all others: still ascending
    }
  }
  for (Index island = 0; island < used.size(); ++island) {
    if (used[island] != 0) {
      filter.sets_off.emplace_back(next + island, next + island);
      filter.permanent_sets_off.emplace_back(next + island, next + island);
    }
  }
  for (scene::Articulation& articulation : apart.articulations) {
    articulation.self_collision = false;
  }
  return apart;
}

scene::PhysicsScene without_velocity_limits(const scene::PhysicsScene& scene) {
  scene::PhysicsScene free = scene;
  for (scene::Joint& joint : free.joints) {
    joint.velocity_limit = scene::kUnlimited;
    for (scene::Drive& drive : joint.drives) {
      drive.envelope.max_velocity = scene::kUnlimited;
    }
  }
  return free;
}

scene::PhysicsScene without_gravity(const scene::PhysicsScene& scene) {
  scene::PhysicsScene floating = scene;
  for (scene::Scene& one : floating.scenes) {
    one.gravity = Vec3d{};
  }
  floating.scene_tracks.clear();
  return floating;
}

Result<DriveTests> test_drives(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                               const MakeSimulation& make, const DriveTestOptions& options) {
  DriveTests tests;
  tests.kind = options.kind;
  const Groups groups = groups_of(scene, rows, options);
  TENON_TRY(Rig rig, Rig::make(scene, rows, make, options.time_step));
  tests.time_step = rig.time_step();
  TENON_CHECK(check_length(groups, options, tests.time_step));
  TestRun run({scene, rows, make, options},
              seconds_of(options) * static_cast<double>(groups.size()));
  for (const auto& group : groups) {
    if (run.interrupted()) {
      break;
    }
    const std::size_t before = tests.results.size();
    TENON_CHECK(kTests[static_cast<std::size_t>(options.kind)].run(run, rig, group, tests));
    for (std::size_t i = before; options.found && i < tests.results.size(); ++i) {
      options.found(tests.results[i]);
    }
  }
  add_skipped(scene, rows, options, tests);
  std::stable_sort(tests.results.begin(), tests.results.end(),
                   [](const auto& a, const auto& b) { return a.row < b.row; });
  tests.interrupted = run.interrupted();
  return tests;
}

}  // namespace tenon::tuning
