// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A snap goes to the lower limit, holds, to the upper one, holds, and home. Where a drive does not
// get there the same is done again with one thing less each time (velocity limits, contacts of the
// robot with itself, gravity): what lets it pass is the reason.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/text/rounded_text.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

constexpr double kMostSeconds = 10;  ///< of a way
constexpr double kHoldSeconds = 1;
constexpr StillRule kStill{};

/// What became of the drives of one group.
struct SnapOutcome {
  std::vector<DriveTestResult> results;  // (group_count)
};

class Snap {
 public:
  Snap(TestRun& run, Rig& rig, const std::vector<std::size_t>& group)
      : run_(run), rig_(rig), group_(group) {}

  Result<SnapOutcome> go() {
    TENON_CHECK(rig_.begin(group_));
    for (const std::size_t row : group_) {
      ranges_.push_back(range_of(run_.in.scene, run_.in.rows[row], rig_.home(row)));
      outcome_.results.emplace_back().row = row;
    }
    for (const bool upper : {false, true}) {
      TENON_CHECK(way_to_limit(upper));
    }
    if (stable_) {
      TENON_CHECK(go_to([&](std::size_t i) { return rig_.home(group_[i]); }));
    }
    judge();
    return std::move(outcome_);
  }

 private:
  template <class Target>
  Result<void> go_to(const Target& target) {
    for (std::size_t i = 0; i < group_.size(); ++i) {
      TENON_CHECK(rig_.command(group_[i], target(i)));
    }
    const std::size_t from = rig_.sample_count();
    const auto most = static_cast<std::size_t>(std::ceil(kMostSeconds / rig_.time_step()));
    std::vector<std::size_t> still(group_.size(), 0);  // samples on end
    for (std::size_t n = 0; n < most && !all_still(still); ++n) {
      TENON_TRY(const bool well, one_step());
      if (!well) {
        return {};
      }
      for (std::size_t i = 0; i < group_.size(); ++i) {
        const bool slow = std::fabs(rig_.signal(i).velocity.back()) < kStill.speed;
        still[i] = slow ? still[i] + 1 : 0;
      }
    }
    way_begin_ = from;
    return {};
  }

  bool all_still(const std::vector<std::size_t>& still) const {
    return std::all_of(still.begin(), still.end(), [this](std::size_t samples) {
      return (static_cast<double>(samples) - 1) * rig_.time_step() >= kStill.seconds;
    });
  }

  Result<bool> one_step() {
    TENON_TRY(stable_, rig_.step());
    return stable_ && run_.go_on(rig_.time_step());
  }

  Result<void> way_to_limit(bool upper) {
    if (!stable_ || run_.interrupted()) {
      return {};
    }
    const auto target = [&](std::size_t i) { return upper ? ranges_[i].upper : ranges_[i].lower; };
    TENON_CHECK(go_to(target));
    const std::size_t hold = rig_.sample_count();
    const auto steps = static_cast<std::size_t>(std::ceil(kHoldSeconds / rig_.time_step()));
    for (std::size_t n = 0; n < steps && stable_ && !run_.interrupted(); ++n) {
      TENON_TRY(const bool well, one_step());
      if (!well) {
        break;
      }
    }
    for (std::size_t i = 0; i < group_.size() && stable_; ++i) {
      outcome_.results[i].limits.push_back(limit_result(i, target(i), hold));
    }
    return {};
  }

  LimitResult limit_result(std::size_t i, double target, std::size_t hold) const {
    const Signal& signal = rig_.signal(i);
    LimitResult limit;
    limit.target = target;
    const auto since = still_since(signal, way_begin_, hold, kStill);
    limit.still = since.has_value();
    limit.at = signal.position.back();
    const double at_hold = hold > 0 ? signal.position[hold - 1] : limit.at;
    limit.reached = limit.still && std::fabs(at_hold - target) <= kReached;
    if (since) {
      limit.settling_time = *since - signal.time[way_begin_ > 0 ? way_begin_ - 1 : 0];
    }
    limit.hold = hold_error(signal, hold, signal.size(), target);
    return limit;
  }

  void judge() {
    for (std::size_t i = 0; i < group_.size(); ++i) {
      DriveTestResult& result = outcome_.results[i];
      result.signal = rig_.take_signal(i);
      result.saturation =
          saturation(result.signal, 0, result.signal.size(), rig_.max_force(group_[i]));
      result.verdict = verdict_of(result);
    }
  }

  Verdict verdict_of(const DriveTestResult& result) const {
    if (!stable_) {
      return Verdict::Unstable;
    }
    if (result.limits.size() < 2) {
      return Verdict::Skipped;  // interrupted
    }
    Verdict verdict = Verdict::Pass;
    for (const LimitResult& limit : result.limits) {
      if (!limit.reached) {
        verdict = limit.still && verdict != Verdict::Fail ? Verdict::Blocked : Verdict::Fail;
      }
    }
    return verdict;
  }

  TestRun& run_;
  Rig& rig_;
  const std::vector<std::size_t>& group_;
  std::vector<DriveRange> ranges_;
  SnapOutcome outcome_;
  std::size_t way_begin_ = 0;
  bool stable_ = true;
};

bool is_bad(const DriveTestResult& result) {
  return result.verdict == Verdict::Fail || result.verdict == Verdict::Blocked;
}

/// The same group in another scene.
Result<std::vector<Verdict>> verdicts_in(TestRun& run, const scene::PhysicsScene& scene,
                                         const std::vector<std::size_t>& group) {
  TENON_TRY(Rig rig, Rig::make(scene, run.in.rows, run.in.make, run.in.options.time_step));
  TENON_TRY(const SnapOutcome outcome, Snap(run, rig, group).go());
  std::vector<Verdict> verdicts;
  for (const DriveTestResult& result : outcome.results) {
    verdicts.push_back(result.verdict);
  }
  return verdicts;
}

std::string unit_of(const DriveRow& row) { return is_angular(row.dof) ? " rad" : " m"; }

/// How far the worse of both ends is missed.
std::string missed(const DriveTestResult& result, const DriveRow& row) {
  double most = 0;
  for (const LimitResult& limit : result.limits) {
    most = limit.reached ? most : std::max(most, std::fabs(limit.at - limit.target));
  }
  return rounded_text(most, 3) + unit_of(row);
}

/// Runs the group again with one thing less each time, and says what let a drive pass.
class Reasons {
 public:
  Reasons(TestRun& run, const std::vector<std::size_t>& group, std::vector<DriveTestResult>& found)
      : run_(run), group_(group), found_(found), told_(found.size(), false) {}

  Result<void> find() {
    const scene::PhysicsScene& scene = run_.in.scene;
    TENON_CHECK(without(without_velocity_limits(scene), "velocity limits", [&](std::size_t i) {
      const double most = scene.joints[row(i).joint].velocity_limit;
      return "the velocity limit" +
             (std::isfinite(most) ? " of " + rounded_text(most, 4) + unit_of(row(i)) + "/s"
                                  : " of a joint") +
             ": it passes without";
    }));
    TENON_CHECK(without(without_self_collision(scene), "self-collision", [&](std::size_t) {
      return std::string("self-collision: it passes without; the limit lies beyond the geometry");
    }));
    for (std::size_t i = 0; i < found_.size(); ++i) {
      constexpr double kMostly = 0.5;
      if (is_open(i) && (found_[i].saturation >= kMostly || friction_holds(i))) {
        told_[i] = true;
        found_[i].reasons.push_back("its maxForce is too small for what it moves: it ends " +
                                    missed(found_[i], row(i)) + " away");
      }
    }
    TENON_CHECK(without(without_gravity(scene), "gravity", [&](std::size_t i) {
      return "the weight that it carries: it passes without gravity and ends " +
             missed(found_[i], row(i)) + " away with it; raise its stiffness";
    }));
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (is_open(i)) {
        found_[i].reasons.push_back("a mimic, another joint or a wrong limit: it ends " +
                                    missed(found_[i], row(i)) + " away");
      }
    }
    return {};
  }

 private:
  const DriveRow& row(std::size_t i) const { return run_.in.rows[group_[i]]; }
  /// Friction of the joint is as large as what its drive can do.
  bool friction_holds(std::size_t i) const {
    const scene::Joint& joint = run_.in.scene.joints[row(i).joint];
    return row(i).drive && joint.friction >= joint.drives[*row(i).drive].max_force;
  }
  bool is_open(std::size_t i) const { return is_bad(found_[i]) && !told_[i]; }

  template <class Reason>
  Result<void> without(const scene::PhysicsScene& scene, const char* what, const Reason& reason) {
    bool needed = false;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      needed = needed || is_open(i);
    }
    if (!needed || run_.interrupted()) {
      return {};
    }
    if (run_.in.options.next_part) {
      run_.in.options.next_part(std::string("looking for reasons, without ") + what);
    }
    TENON_TRY(const std::vector<Verdict> verdicts, verdicts_in(run_, scene, group_));
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (is_open(i) && verdicts[i] == Verdict::Pass) {
        told_[i] = true;
        found_[i].reasons.push_back(reason(i));
      }
    }
    return {};
  }

  TestRun& run_;
  const std::vector<std::size_t>& group_;
  std::vector<DriveTestResult>& found_;
  std::vector<bool> told_;
};

/// What to look at although it passes.
void add_advice(const DriveRow& row, DriveTestResult& result) {
  constexpr double kSlow = 2;  // [s]
  double slowest = 0;
  double error = 0;
  for (const LimitResult& limit : result.limits) {
    slowest = std::max(slowest, limit.settling_time.value_or(0));
    error = std::max(error, limit.hold.most);
  }
  if (result.verdict != Verdict::Pass) {
    return;
  }
  if (slowest > kSlow && row.response && regime_of(row.response->ratio) == Regime::Overdamped) {
    result.reasons.push_back("slow: overdamped, damping ratio " +
                             rounded_text(row.response->ratio, 3));
  }
  if (error > kReached) {
    result.reasons.push_back("rings while it holds: up to " + rounded_text(error, 3) +
                             unit_of(row) + " from its target");
  }
}

}  // namespace

Result<void> run_snap(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests) {
  TENON_TRY(SnapOutcome outcome, Snap(run, rig, group).go());
  TENON_CHECK(Reasons(run, group, outcome.results).find());
  for (DriveTestResult& result : outcome.results) {
    add_advice(run.in.rows[result.row], result);
    for (const std::string& note : {saturation_note(run, result.row, result.saturation),
                                    speed_note(run, result.row, result.signal)}) {
      if (!note.empty()) {
        result.reasons.push_back(note);
      }
    }
    tests.results.push_back(std::move(result));
  }
  return {};
}

}  // namespace tenon::tuning
