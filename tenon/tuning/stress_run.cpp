// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Commands as a policy in training gives them: a random walk of each target, or a random limit
// every ten steps. What is unstable is looked at once more without contacts of the robot with
// itself, and joint by joint. The largest stable walk is found by bisection of its sigma. Random
// numbers are those of the seed alone, on every machine.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "tenon/math/angle.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

constexpr double kSeconds = 10;
constexpr double kSigma = 0.01;   // of the range
constexpr double kMostSigma = 1;  // of the range
constexpr int kBisections = 5;
constexpr std::size_t kEverySteps = 10;

/// Uniform and normal numbers that do not depend on the library.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : bits_(seed) {}

  /// In (0, 1].
  double uniform() {
    constexpr double kParts = 9007199254740992.0;  // 2^53
    return (static_cast<double>(bits_() >> 11u) + 1) / kParts;
  }
  double normal() {
    const double size = std::sqrt(-2 * std::log(uniform()));
    return size * std::cos(2 * kPi * uniform());
  }

 private:
  std::mt19937_64 bits_;
};

struct StressPlan {
  const std::vector<std::size_t>* group = nullptr;
  double sigma = 0;
  bool record = false;
};

struct StressOutcome {
  bool stable = true;
  std::vector<double> speeds;   // (group_count)
  std::vector<Signal> signals;  // (group_count)
};

Result<StressOutcome> stress(TestRun& run, Rig& rig, const StressPlan& plan) {
  const std::vector<std::size_t>& group = *plan.group;
  TENON_CHECK(rig.begin(group));
  rig.record(plan.record);
  rig.bound_speeds(kUnstableSpeed);
  Noise noise(run.in.options.seed);
  std::vector<DriveRange> ranges;
  std::vector<double> targets;
  for (const std::size_t row : group) {
    ranges.push_back(range_of(run.in.scene, run.in.rows[row], rig.home(row)));
    targets.push_back(std::clamp(rig.home(row), ranges.back().lower, ranges.back().upper));
  }
  const double seconds = run.in.options.duration.value_or(kSeconds);
  const auto count = static_cast<std::size_t>(std::ceil(seconds / rig.time_step()));
  StressOutcome outcome;
  for (std::size_t n = 0; n < count && outcome.stable; ++n) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      const DriveRange& range = ranges[i];
      if (!run.in.options.adversarial) {
        targets[i] = std::clamp(targets[i] + plan.sigma * range.size() * noise.normal(),
                                range.lower, range.upper);
      } else if (n % kEverySteps == 0) {
        targets[i] = noise.uniform() > 0.5 ? range.upper : range.lower;
      }
      TENON_CHECK(rig.command(group[i], targets[i]));
    }
    TENON_TRY(outcome.stable, rig.step());
    if (!run.go_on(rig.time_step())) {
      break;
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    outcome.speeds.push_back(rig.largest_speed(i));
    outcome.signals.push_back(rig.take_signal(i));
  }
  return outcome;
}

/// Why a group is unstable.
Result<std::string> reason_of(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                              double sigma) {
  const scene::PhysicsScene apart = without_self_collision(run.in.scene);
  TENON_TRY(Rig other, Rig::make(apart, run.in.rows, run.in.make, run.in.options.time_step));
  TENON_TRY(const StressOutcome outcome, stress(run, other, {&group, sigma, false}));
  if (outcome.stable) {
    return std::string("contacts of the robot with itself, not gains: it is stable without");
  }
  std::string names;
  for (const std::size_t row : group) {
    const std::vector<std::size_t> alone{row};
    TENON_TRY(const StressOutcome one, stress(run, rig, {&alone, sigma, false}));
    if (!one.stable) {
      names += (names.empty() ? "" : ", ") +
               run.in.scene.joints[run.in.rows[row].joint].path.name().str();
    }
  }
  return names.empty() ? std::string("each joint is stable alone, all together are not")
                       : "gains: unstable alone: " + names;
}

/// The largest stable sigma, between one that is stable (0: none) and the bound of the search.
Result<StressResult> largest_stable(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                                    double sigma, bool stable) {
  StressResult found;
  double good = stable ? sigma : 0;
  double bad = stable ? scene::kUnlimited : sigma;
  while (!std::isfinite(bad) && good < kMostSigma && !run.interrupted()) {
    const double next = std::min(4 * good, kMostSigma);
    TENON_TRY(const StressOutcome outcome, stress(run, rig, {&group, next, false}));
    (outcome.stable ? good : bad) = next;
  }
  for (int i = 0; i < kBisections && std::isfinite(bad) && !run.interrupted(); ++i) {
    const double middle = good > 0 ? std::sqrt(good * bad) : bad / 4;
    TENON_TRY(const StressOutcome outcome, stress(run, rig, {&group, middle, false}));
    (outcome.stable ? good : bad) = middle;
  }
  found.largest_stable = good;
  found.at_least = !std::isfinite(bad);
  return found;
}

}  // namespace

Result<void> run_stress(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                        DriveTests& tests) {
  const double sigma = run.in.options.amplitude.value_or(kSigma);
  tests.seed = run.in.options.seed;
  tests.amplitude = run.in.options.adversarial ? 0 : sigma;
  TENON_TRY(StressOutcome outcome, stress(run, rig, {&group, sigma, true}));
  std::string reason;
  if (!outcome.stable) {
    TENON_TRY(reason, reason_of(run, rig, group, sigma));
  }
  StressResult found;
  if (!run.in.options.adversarial && !run.interrupted()) {
    TENON_TRY(found, largest_stable(run, rig, group, sigma, outcome.stable));
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    DriveTestResult result;
    result.row = group[i];
    result.signal = std::move(outcome.signals[i]);
    result.stress = found;
    result.stress->sigma = tests.amplitude;
    result.stress->largest_speed = outcome.speeds[i];
    result.verdict = outcome.stable ? Verdict::Pass : Verdict::Unstable;
    result.saturation = saturation(result.signal, 0, result.signal.size(), rig.max_force(group[i]));
    if (!reason.empty()) {
      result.reasons.push_back(reason);
    }
    const std::string saturated = saturation_note(run, group[i], result.saturation);
    if (!saturated.empty()) {
      result.reasons.push_back(saturated);
    }
    tests.results.push_back(std::move(result));
  }
  return {};
}

}  // namespace tenon::tuning
