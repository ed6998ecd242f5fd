// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One simulation serves all joints: it goes back to the start between them, where all position
// drives hold. Roots that float are anchored, so that the tests are about joints alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "tenon/asset/benchmarking/benchmark_run.h"
#include "tenon/asset/tuning/search_scenes.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/dynamics/masks.h"
#include "tenon/math/angle.h"
#include "tenon/math/mimic_law.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/tuning/rig.h"

namespace tenon {
namespace {

using scene::Index;
using tuning::DriveRow;

constexpr double kSettleFor = 1;       // [s]
constexpr double kExplodes = 10;       // the diagonal, by that at the start
constexpr std::size_t kLookEach = 20;  // steps
constexpr double kInset = 0.1;         // of targets from limits, by the range
constexpr double kSegment = 1.25;      // [s]
constexpr double kPause = 0.15;        // [s]
constexpr double kHoldError = 0.1;     // [rad], or of the range [m]
constexpr double kHomeError = 0.01;    // [rad]
constexpr double kHomeOfRange = 0.05;  // the same of sliding joints
constexpr double kHomeWithin = 2;      // [s]
constexpr std::size_t kHomeSteps = 8;
constexpr double kPush = 10;           // [N]
constexpr double kPushSettle = 0.3;    // [s]
constexpr double kPushFor = 2.0 / 12;  // [s]
constexpr double kBeyond = 10;         // a limit [% of the range]
constexpr double kRaceFor = 2;         // [s]
constexpr double kRaceInset = 0.05;    // by the range
constexpr double kSpeedMargin = 1.05;  // of the limit
constexpr std::size_t kStartSteps = 5;
constexpr double kStepSize = 30 * kRadians;  // [rad or m]
constexpr double kStepFor = 5;               // [s]
constexpr double kStepBand = 0.05;           // of the step
constexpr double kOvershoot = 50;            // [%]
constexpr double kTurns = 20;
constexpr double kResolved = 0.2;    // omega dt: from there on steps damp what swings
constexpr double kSlow = 0.2;        // [s] of damping by stiffness
constexpr double kWellDamped = 0.3;  // damping ratio
constexpr double kMimicFor = 2;      // [s]
constexpr double kRatioError = 0.1;
constexpr double kStillSpeed = 0.05;  // [rad/s or m/s]
constexpr double kStillFor = 0.1;     // [s]

bool is_bounded(const scene::PhysicsScene& scene, const DriveRow& row) {
  const scene::Limit range = scene::limit_of(scene.joints[row.joint], row.dof);
  return row.position_drive() && std::isfinite(range.lower) && std::isfinite(range.upper) &&
         range.upper - range.lower > 1e-6;
}

double speed_limit(const scene::Joint& joint, const DriveRow& row) {
  return std::min(joint.velocity_limit, joint.drives[*row.drive].envelope.max_velocity);
}

double smooth(double t) { return t * t * (3 - 2 * t); }

/// The joint of one row as it moves.
class JointRun {
 public:
  JointRun(BenchmarkRun& run, const std::vector<DriveRow>& rows, tuning::Rig rig)
      : run_(run), rows_(rows), rig_(std::move(rig)), reach_(run.scene, all_bodies(run.scene)) {
    diagonal_ = std::max(reach_.diagonal(poses_of(rig_.simulation(), run.scene)), 1e-3);
  }

  const scene::PhysicsScene& scene() const { return run_.scene; }
  const std::vector<DriveRow>& rows() const { return rows_; }
  engines::Simulation& simulation() { return rig_.simulation(); }
  const DriveRow& row() const { return rows_[row_]; }
  const scene::Joint& joint() const { return run_.scene.joints[row().joint]; }
  scene::Limit range() const { return scene::limit_of(joint(), row().dof); }
  double size() const { return range().upper - range().lower; }
  const tuning::Signal& signal() const { return rig_.signal(0); }
  double position() const { return signal().position.back(); }
  double speed() const { return std::fabs(signal().velocity.back()); }
  double time_step() const { return run_.time_step; }
  const std::string& failure() const { return failure_; }
  bool angular() const { return is_angular(row().dof); }
  const char* unit() const { return angular() ? "rad" : "m"; }

  /// From the start, for `seconds` at rest.
  Result<void> begin(std::size_t row, double seconds) {
    failure_.clear();
    steps_ = 0;
    row_ = row;
    TENON_CHECK(rig_.begin({row}));
    return wait(seconds);
  }
  Result<void> command(double position) { return rig_.command(row_, position); }
  /// false: the run of this joint is over.
  Result<bool> step() {
    if (!failure_.empty() || !run_.go_on()) {
      return false;
    }
    TENON_TRY(const bool stable, rig_.step());
    const bool look = ++steps_ % kLookEach == 0;
    const double size = look ? reach_.diagonal(poses_of(rig_.simulation(), run_.scene)) : diagonal_;
    if (!stable || !(size <= kExplodes * diagonal_)) {
      failure_ = "it becomes unstable after " +
                 rounded_text(static_cast<double>(steps_) * run_.time_step, 3) + " s";
    }
    return failure_.empty();
  }
  Result<void> wait(double seconds) { return move(std::nullopt, 0, seconds); }
  /// Along a smooth step; or, from nowhere, with the target as it is.
  Result<void> move(std::optional<double> from, double to, double seconds) {
    const auto count =
        static_cast<std::size_t>(std::max(1.0, std::round(seconds / run_.time_step)));
    for (std::size_t i = 1; i <= count; ++i) {
      if (from) {
        const double share = static_cast<double>(i) / static_cast<double>(count);
        TENON_CHECK(command(*from + (to - *from) * smooth(share)));
      }
      TENON_TRY(const bool goes_on, step());
      if (!goes_on) {
        break;
      }
    }
    return {};
  }
  /// What keeps the joint from where it is to be.
  std::string cause() const {
    const double most = rig_.max_force(row_);
    const double effort = signal().effort.empty() ? 0 : std::fabs(signal().effort.back());
    const std::string torque = angular() ? " N m" : " N";
    if (effort >= 0.98 * most) {
      return "the drive is at its maxForce of " + rounded_text(most, 3) + torque;
    }
    const auto& response = row().response;
    if (const double slow = response ? 2 * response->ratio / response->frequency : 0;
        slow > kSlow) {
      return "it is damped too much: its damping by its stiffness is " + rounded_text(slow, 3) +
             " s";
    }
    return speed() > kStillSpeed
               ? "it still moves at " + rounded_text(speed(), 3) + " " + unit() + "/s"
               : "it stands still, and the drive exerts " + rounded_text(effort, 3) + torque +
                     ": weight, a contact or a limit holds it";
  }

 private:
  static std::vector<Index> all_bodies(const scene::PhysicsScene& scene) {
    std::vector<Index> bodies(scene.bodies.size());
    std::iota(bodies.begin(), bodies.end(), Index{0});
    return bodies;
  }

  BenchmarkRun& run_;
  const std::vector<DriveRow>& rows_;
  tuning::Rig rig_;
  Reach reach_;
  double diagonal_ = 0;  ///< at the start [m]
  std::size_t row_ = 0;
  std::size_t steps_ = 0;
  std::string failure_;  ///< why the run of this joint is over; empty: it is not
};

// ---- the tests; a run that is over makes no further steps

/// Goes to a target and holds there; the median of the distance during the pause is judged.
Result<void> sweep_to(JointRun& run, const char* end, double from, double to, BenchmarkRow& row) {
  TENON_CHECK(run.move(from, to, kSegment));
  const std::size_t first = run.signal().size();
  TENON_CHECK(run.wait(kPause));
  std::vector<double> errors;
  for (std::size_t i = first; i < run.signal().size(); ++i) {
    errors.push_back(std::fabs(run.signal().position[i] - to));
  }
  std::sort(errors.begin(), errors.end());
  const double error = errors.empty() ? 0 : errors[errors.size() / 2];
  row.numbers.emplace_back(end, error);
  if (row.verdict == BenchmarkVerdict::Pass || error > row.measured) {
    const double asked = 1.5 * std::fabs(to - from) / kSegment;  // in the middle of a smooth step
    const double limit = speed_limit(run.joint(), run.row());
    judge_row(row, "distance from a target", error,
              kHoldError * (run.angular() ? 1 : std::min(run.size(), 1.0)), run.unit(),
              "it is " + rounded_text(error, 3) + " " + run.unit() + " away from its " + end +
                  " target of " + rounded_text(to, 3) + ": " +
                  (asked > limit ? "the sweep takes " + rounded_text(asked, 3) + " " + run.unit() +
                                       "/s, its velocity limit is " + rounded_text(limit, 3)
                                 : run.cause()));
  }
  return {};
}

Result<void> sweep_joint(JointRun& run, std::size_t i, BenchmarkRow& row) {
  TENON_CHECK(run.begin(i, kSettleFor));
  const scene::Limit range = run.range();
  const double size = std::min(run.size(), 2 * kPi);
  const double middle = std::clamp(0.0, range.lower + size / 2, range.upper - size / 2);
  const double upper = middle + size * (0.5 - kInset);
  const double lower = middle - size * (0.5 - kInset);
  const double home = range.lower > 0 ? lower : range.upper < 0 ? upper : 0;
  const double most = run.angular() ? kHomeError : std::min(kHomeError, kHomeOfRange * run.size());
  TENON_CHECK(sweep_to(run, "upper", run.position(), upper, row));
  TENON_CHECK(sweep_to(run, "lower", upper, lower, row));
  TENON_CHECK(run.move(lower, home, kSegment));
  std::size_t near = 0;
  for (double time = 0; near < kHomeSteps && time < kHomeWithin; time += run.time_step()) {
    TENON_CHECK(run.step());
    near = std::fabs(run.position() - home) <= most ? near + 1 : 0;
  }
  row.numbers.emplace_back("home", std::fabs(run.position() - home));
  if (row.verdict == BenchmarkVerdict::Pass) {
    judge_row(row, "distance from home", std::fabs(run.position() - home), most, run.unit(),
              "it does not come back to " + rounded_text(home, 3) + ": " + run.cause());
  }
  return {};
}

Result<void> push_joint(JointRun& run, std::size_t i, BenchmarkRow& row) {
  const double h = std::sqrt(0.5);
  const std::array<Vec3d, 6> directions{Vec3d{{1, 0, 0}}, Vec3d{{0, 1, 0}}, Vec3d{{0, 0, 1}},
                                        Vec3d{{h, h, 0}}, Vec3d{{0, h, h}}, Vec3d{{h, 0, h}}};
  Span beyond{0, 0};
  Span moved{0, 0};
  Span effort{0, 0};
  for (std::size_t k = 0; k < 12 && beyond.most <= kBeyond; ++k) {
    TENON_CHECK(run.begin(i, kPushSettle));
    if (!run.failure().empty()) {
      break;
    }
    const auto& body1 = run.joint().body1;
    const auto body = body1 && !run.scene().bodies[*body1].kinematic ? body1 : run.joint().body0;
    const double from = run.position();
    const std::size_t first = run.signal().size();
    if (body) {
      const Vec3d force = directions[k / 2] * (k % 2 == 0 ? kPush : -kPush);
      TENON_CHECK(run.simulation().set_body_wrench(*body, {force, {}}));
    }
    TENON_CHECK(run.wait(kPushFor));
    for (std::size_t s = first; s < run.signal().size(); ++s) {
      const double at = run.signal().position[s];
      beyond.add(100 * std::max(at - run.range().upper, run.range().lower - at) / run.size());
      moved.add(std::fabs(at - from));
      effort.add(run.signal().effort.empty() ? 0 : std::fabs(run.signal().effort[s]));
    }
  }
  row.numbers = {{"moved", moved.most}, {"peakEffort", effort.most}};
  judge_row(row, "beyond a limit, of the range", beyond.most, kBeyond, "%",
            "10 N push it beyond a limit: neither the drive nor the limit holds");
  return {};
}

Result<void> race_joint(JointRun& run, std::size_t i, BenchmarkRow& row) {
  TENON_CHECK(run.begin(i, kSettleFor));
  const scene::Limit range = run.range();
  const double limit = speed_limit(run.joint(), run.row());
  const double inset = kRaceInset * run.size();
  const bool low = run.position() <= (range.lower + range.upper) / 2;
  TENON_CHECK(run.command(low ? range.upper - inset : range.lower + inset));
  double peak = 0;
  double still = 0;
  for (std::size_t k = 0; static_cast<double>(k) * run.time_step() < kRaceFor; ++k) {
    TENON_TRY(const bool goes_on, run.step());
    peak = k >= kStartSteps ? std::max(peak, run.speed()) : peak;
    still = run.speed() < kStillSpeed ? still + run.time_step() : 0;
    if (!goes_on || still > kStillFor) {
      break;
    }
  }
  row.numbers = {{"limit", limit}};
  judge_row(row, "peak speed", peak, kSpeedMargin * limit, run.angular() ? "rad/s" : "m/s",
            "it reaches " + rounded_text(peak, 3) + " " + run.unit() +
                "/s, its velocity limit is " + rounded_text(limit, 3));
  return {};
}

double step_target(const scene::Limit& range, double from) {
  const double farther = range.upper - from >= from - range.lower ? range.upper : range.lower;
  return from + kStepSize <= range.upper   ? from + kStepSize
         : from - kStepSize >= range.lower ? from - kStepSize
                                           : farther;
}

/// How a joint answered a step.
struct Answer {
  double from = 0;
  double to = 0;
  double overshoot = 0;  ///< by the step
  double turns = 0;
  bool settled = false;

  double size() const { return std::max(std::fabs(to - from), 1e-9); }
};

Result<Answer> answer_of(JointRun& run) {
  const double from = run.position();
  Answer answer{from, step_target(run.range(), from)};
  TENON_CHECK(run.command(answer.to));
  double last = 0;
  double still = 0;
  bool goes_on = true;
  for (double time = 0; goes_on && time < kStepFor && still <= kStillFor; time += run.time_step()) {
    TENON_TRY(goes_on, run.step());
    const double error = run.position() - answer.to;
    const double velocity = run.signal().velocity.back();
    answer.overshoot =
        std::max(answer.overshoot, (answer.to > answer.from ? error : -error) / answer.size());
    if (run.speed() > kStillSpeed) {
      answer.turns += last * velocity < 0 ? 1 : 0;
      last = velocity;
    }
    answer.settled = std::fabs(error) <= kStepBand * answer.size();
    still = answer.settled && run.speed() < kStillSpeed ? still + run.time_step() : 0;
  }
  return answer;
}

Result<void> step_joint(JointRun& run, std::size_t i, BenchmarkRow& row) {
  TENON_CHECK(run.begin(i, kSettleFor));
  TENON_TRY(const Answer answer, answer_of(run));
  const tuning::Response form = run.row().response.value_or(tuning::Response{0, 1});
  const bool hidden = form.frequency * run.time_step() > kResolved &&
                      tuning::overshoot_of(form.ratio) > answer.overshoot;
  const double overshoot = hidden ? tuning::overshoot_of(form.ratio) : answer.overshoot;
  row.numbers = {{"overshoot", answer.overshoot},
                 {"turns", answer.turns},
                 {"frequency", form.frequency / (2 * kPi)},
                 {"dampingRatio", form.ratio}};
  const std::string cause =
      form.ratio < kWellDamped
          ? "the drive has too little damping, a damping ratio of " + rounded_text(form.ratio, 3)
          : "its damping ratio is " + rounded_text(form.ratio, 3) +
                ": a contact, a limit or another joint shakes it";
  judge_row(row, "overshoot", 100 * overshoot, kOvershoot, "%",
            hidden ? "its gains overshoot at " + rounded_text(form.frequency / (2 * kPi), 3) +
                         " Hz, which the time step hides: " + cause
                   : "it overshoots: " + cause);
  if (row.verdict == BenchmarkVerdict::Pass && answer.turns > kTurns) {
    judge_row(row, "changes of direction", answer.turns, kTurns, "", "it swings: " + cause);
  } else if (row.verdict == BenchmarkVerdict::Pass && !answer.settled) {
    judge_row(row, "distance from the target", std::fabs(run.position() - answer.to),
              kStepBand * answer.size(), run.unit(),
              "it does not settle within 5 s: " + run.cause());
  }
  return {};
}

/// What row `i` follows in the end, which can be driven through its range, and by which laws, its
/// own first.
struct Leader {
  std::size_t row = 0;
  std::vector<const scene::Mimic*> laws;

  double expected(double position) const {
    return std::accumulate(laws.rbegin(), laws.rend(), position,
                           [](double at, const auto* law) { return mimic_position(*law, at); });
  }
};

std::optional<Leader> leader_of(const scene::PhysicsScene& scene, const std::vector<DriveRow>& rows,
                                std::size_t i) {
  Leader leader;
  Index joint = rows[i].joint;
  scene::Dof dof = rows[i].dof;
  while (leader.laws.size() <= scene.joints.size()) {
    const scene::Mimic* law = dynamics::mimic_of(scene.joints[joint], dof);
    if (law == nullptr || !scene.joints[joint].enabled) {
      break;
    }
    leader.laws.push_back(law);
    joint = law->leader;
    dof = law->leader_dof;
  }
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const DriveRow& row) {
    return row.joint == joint && row.dof == dof && is_bounded(scene, row);
  });
  if (leader.laws.empty() || found == rows.end()) {
    return std::nullopt;
  }
  leader.row = static_cast<std::size_t>(found - rows.begin());
  return leader;
}

/// The leader of row `i` goes through its range and back.
Result<void> lead_joint(JointRun& run, std::size_t i, BenchmarkRow& row) {
  const DriveRow& follower = run.rows()[i];
  const Leader led_by = *leader_of(run.scene(), run.rows(), i);
  TENON_CHECK(run.begin(led_by.row, kSettleFor));
  const double low = run.range().lower + kInset * run.size();
  const double sweep = (1 - 2 * kInset) * run.size();
  Span led;
  Span followed;
  Span expected;
  bool goes_on = true;
  for (double time = 0; goes_on && time <= kMimicFor; time += run.time_step()) {
    TENON_CHECK(run.command(low + sweep * smooth(1 - std::fabs(2 * time / kMimicFor - 1))));
    TENON_TRY(goes_on, run.step());
    led.add(run.position());
    expected.add(led_by.expected(run.position()));
    followed.add(run.simulation().joint_state(follower.joint).position[follower.part]);
  }
  const std::string leader = run.joint().path.name().str();
  const double ratio = expected.size() / std::max(led.size(), 1e-9);
  const double found = followed.size() / std::max(led.size(), 1e-9);
  row.numbers = {{"leader", led.size()}, {"follower", followed.size()}, {"ratio", found}};
  judge_row(row, "error of the ratio", std::fabs(found - ratio), kRatioError, "",
            "it moves " + rounded_text(found, 3) + " times as far as its leader " + leader +
                ", which should be " + rounded_text(ratio, 3));
  if (led.size() < sweep / 2) {
    fail_row(row, "its leader " + leader + " moves too little: " + run.cause());
  }
  return {};
}

// ---- what each test is about

using RunJoint = Result<void>(JointRun& run, std::size_t row, BenchmarkRow& result);
struct JointTest {
  BenchmarkTest test;
  RunJoint* run;
  double seconds;  ///< of one joint at most
  const char* needs;
};
constexpr const char* kNeeds = "no joint has a position drive and two limits";
/// In the order of BenchmarkTest.
constexpr std::array kJointTests{
    JointTest{BenchmarkTest::FullRangeSweep, sweep_joint, 7.5, kNeeds},
    JointTest{BenchmarkTest::EffortLimit, push_joint, 5.6, kNeeds},
    JointTest{BenchmarkTest::VelocityLimit, race_joint, 3,
              "no joint has a position drive, two limits and a velocity limit"},
    JointTest{BenchmarkTest::MimicJoint, lead_joint, 3,
              "no joint follows one that has a position drive and two limits"},
    JointTest{BenchmarkTest::DriveGains, step_joint, 6, kNeeds},
};

bool is_about(BenchmarkTest test, const scene::PhysicsScene& scene,
              const std::vector<DriveRow>& rows, std::size_t i) {
  return test == BenchmarkTest::MimicJoint
             ? leader_of(scene, rows, i).has_value()
             : is_bounded(scene, rows[i]) &&
                   (test != BenchmarkTest::VelocityLimit ||
                    std::isfinite(speed_limit(scene.joints[rows[i].joint], rows[i])));
}

Result<BenchmarkResult> test_joints(BenchmarkRun& run, JointRun& joint, const JointTest& test) {
  std::vector<BenchmarkRow> results;
  for (std::size_t i = 0; i < joint.rows().size(); ++i) {
    if (!is_about(test.test, run.scene, joint.rows(), i)) {
      continue;
    }
    run.planned += test.seconds;
    BenchmarkRow& row = results.emplace_back();
    row.prim = run.scene.joints[joint.rows()[i].joint].path;
    row.axis = dof_name(joint.rows()[i].dof);
    TENON_CHECK(test.run(joint, i, row));
    if (!joint.failure().empty()) {
      fail_row(row, joint.failure());
    }
  }
  return results.empty() ? skipped_test(test.test, test.needs)
                         : test_result(test.test, std::move(results));
}

Result<void> anchor_roots(scene::PhysicsScene& scene) {
  const scene::JointForest forest = scene::joint_forest(scene);
  dynamics::Masks masks;
  for (const Index root : forest.roots) {
    const scene::Body& body = scene.bodies[root];
    if (!forest.bodies[root].fixed && body.enabled && !body.kinematic) {
      masks.anchor.push_back(body.path.str());
    }
  }
  Diagnostics ignored;
  return dynamics::apply_masks(masks, scene, ignored);
}

}  // namespace

Result<std::vector<BenchmarkResult>> run_joint_tests(BenchmarkRun& run,
                                                     const std::vector<BenchmarkTest>& tests) {
  std::vector<BenchmarkResult> results;
  if (tests.empty()) {
    return results;
  }
  TENON_CHECK(anchor_roots(run.scene));
  const std::vector<DriveRow> rows = drive_rows_of(run.scene);
  if (std::none_of(rows.begin(), rows.end(),
                   [&](const DriveRow& row) { return is_bounded(run.scene, row); })) {
    for (const BenchmarkTest test : tests) {
      results.push_back(skipped_test(test, kNeeds));
    }
    return results;
  }
  TENON_TRY(tuning::Rig rig, tuning::Rig::make(run.scene, rows, run.make, run.time_step));
  JointRun joint(run, rows, std::move(rig));
  for (const BenchmarkTest test : tests) {
    if (run.listener->next_part) {
      run.listener->next_part(benchmark_test_names()[static_cast<std::size_t>(test)]);
    }
    const auto first = static_cast<std::size_t>(BenchmarkTest::FullRangeSweep);
    auto result = test_joints(run, joint, kJointTests[static_cast<std::size_t>(test) - first]);
    if (run.interrupted) {
      break;
    }
    results.push_back(result ? std::move(*result) : blocked_test(test, result.error()));
  }
  return results;
}

}  // namespace tenon
