// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Steps and sines begin at home, or as close to it as the range lets the whole motion lie inside.
// A step waits there until everything stands, so that what came before is not measured with it.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/tuning/rig.h"

namespace tenon::tuning {
namespace {

constexpr double kStepPeriod = 2;  // [s]
constexpr double kSinePeriod = 2;  // [s]
constexpr double kSinePeriods = 4;
constexpr double kAmplitude = 0.1;     // of the range
constexpr double kSettledPart = 0.02;  // of a step
constexpr double kWaiting = 5;         // [s] at most, before a step

double amplitude_of(const TestRun& run) { return run.in.options.amplitude.value_or(kAmplitude); }

/// Steps until `seconds` are over; false where the run is unstable or interrupted.
Result<bool> advance(TestRun& run, Rig& rig, double seconds) {
  const auto count = static_cast<std::size_t>(std::ceil(seconds / rig.time_step() - 1e-9));
  for (std::size_t n = 0; n < count; ++n) {
    TENON_TRY(const bool stable, rig.step());
    if (!stable || !run.go_on(rig.time_step())) {
      return false;
    }
  }
  return true;
}

Way way_of(const TestRun& run, const Rig& rig, std::size_t row) {
  const double home = rig.home(row);
  const DriveRange range = range_of(run.in.scene, run.in.rows[row], home);
  const double size = amplitude_of(run) * range.size();
  const double from = std::clamp(home, range.lower, range.upper);
  const bool up = from + size <= range.upper || range.upper - from >= from - range.lower;
  return {from, std::clamp(up ? from + size : from - size, range.lower, range.upper)};
}

Verdict stopped_verdict(const TestRun& run) {
  return run.interrupted() ? Verdict::Skipped : Verdict::Unstable;
}

void add_saturation(const TestRun& run, DriveTestResult& result) {
  for (const std::string& text : {saturation_note(run, result.row, result.saturation),
                                  speed_note(run, result.row, result.signal)}) {
    if (!text.empty()) {
      result.reasons.push_back(text);
    }
  }
}

void judge_step(const TestRun& run, const Rig& rig, const Way& way, DriveTestResult& result) {
  const DriveRow& row = run.in.rows[result.row];
  const bool angular = is_angular(row.dof);
  const StepMetrics& metrics = *result.step;
  result.verdict = Verdict::Pass;
  if (std::fabs(metrics.steady_error) > kReached) {
    const double speed = std::fabs(result.signal.velocity.back());
    result.verdict = speed < StillRule().speed ? Verdict::Blocked : Verdict::Fail;
    result.reasons.push_back("it ends " + rounded_text(std::fabs(metrics.steady_error), 3) +
                             (angular ? " rad" : " m") + " from its target");
  }
  if (metrics.overshoot > kOvershootGoal) {
    const double form = row.response ? overshoot_of(row.response->ratio) : 0;
    result.reasons.push_back("overshoot " + rounded_text(100 * metrics.overshoot, 3) +
                             " % (the form: " + rounded_text(100 * form, 3) + " %)");
  }
  if (row.response) {
    const std::string coarse = sampling_note(row.response->frequency, rig.time_step());
    if (!coarse.empty()) {
      result.reasons.push_back(coarse);
    }
  }
  const double short_of = std::fabs(metrics.steady_error);
  if (result.verdict == Verdict::Pass && short_of > kSettledPart * std::fabs(way.to - way.from)) {
    result.reasons.push_back("it ends " + rounded_text(short_of, 3) + (angular ? " rad" : " m") +
                             " from its target, as weight or friction takes the rest");
  }
  add_saturation(run, result);
}

/// Where a sine is centred so that it lies inside the range.
double center_of(const DriveRange& range, double home, double amplitude) {
  const double low = range.lower + amplitude;
  const double high = range.upper - amplitude;
  return low > high ? (range.lower + range.upper) / 2 : std::clamp(home, low, high);
}

void judge_sine(const TestRun& run, DriveTestResult& result) {
  constexpr double kNothing = 0.1;
  constexpr double kHalfPower = 0.7071;
  const DriveRow& row = run.in.rows[result.row];
  const SineMetrics& metrics = *result.sine;
  const std::string bandwidth =
      row.response ? rounded_text(bandwidth_of(*row.response) / (2 * kPi), 3) + " Hz" : "";
  result.verdict = metrics.gain < kNothing ? Verdict::Blocked : Verdict::Pass;
  if (metrics.gain < kHalfPower) {
    result.reasons.push_back("undershoot: it makes " + rounded_text(100 * metrics.gain, 3) +
                             " % of the amplitude" +
                             (bandwidth.empty() ? "" : "; its bandwidth is " + bandwidth));
  } else if (metrics.gain > 1 / kHalfPower) {
    result.reasons.push_back("it rings: " + rounded_text(100 * metrics.gain, 3) +
                             " % of the amplitude");
  }
  result.saturation = metrics.saturation;
  add_saturation(run, result);
}

}  // namespace

Result<std::optional<std::size_t>> step_all(TestRun& run, Rig& rig,
                                            const std::vector<std::size_t>& group,
                                            std::vector<Way>& ways, double period) {
  TENON_CHECK(rig.begin(group));
  ways.clear();
  for (const std::size_t row : group) {
    ways.push_back(way_of(run, rig, row));
    TENON_CHECK(rig.command(row, ways.back().from));
  }
  constexpr double kLook = 0.25;
  constexpr StillRule kStands{1e-5, kLook / 2};
  bool still = false;
  for (double waited = 0; waited < kWaiting && !still; waited += kLook) {
    TENON_TRY(const bool well, advance(run, rig, kLook));
    if (!well) {
      return std::optional<std::size_t>();
    }
    still = true;
    const auto look = static_cast<std::size_t>(kLook / rig.time_step());
    const std::size_t end = rig.sample_count();
    for (std::size_t i = 0; i < group.size(); ++i) {
      still = still && still_since(rig.signal(i), end - std::min(look, end), end, kStands);
    }
  }
  const std::size_t begin = rig.sample_count() - 1;
  for (std::size_t i = 0; i < group.size(); ++i) {
    TENON_CHECK(rig.command(group[i], ways[i].to));
  }
  TENON_TRY(const bool well, advance(run, rig, period));
  return well ? std::optional<std::size_t>(begin) : std::nullopt;
}

Result<void> run_step(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests) {
  tests.period = run.in.options.period.value_or(kStepPeriod);
  tests.amplitude = amplitude_of(run);
  std::vector<Way> ways;
  TENON_TRY(const auto begin, step_all(run, rig, group, ways, tests.period));
  for (std::size_t i = 0; i < group.size(); ++i) {
    DriveTestResult result;
    result.row = group[i];
    result.signal = rig.take_signal(i);
    if (begin) {
      result.step = step_metrics(result.signal, *begin, ways[i].to, rig.max_force(group[i]));
      result.saturation = result.step->saturation;
      judge_step(run, rig, ways[i], result);
      if (group.size() == 1) {
        TENON_CHECK(judge_form(run, tests.period, result));
      }
    } else {
      result.verdict = stopped_verdict(run);
    }
    tests.results.push_back(std::move(result));
  }
  return {};
}

Result<void> run_sine(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                      DriveTests& tests) {
  tests.period = run.in.options.period.value_or(kSinePeriod);
  tests.amplitude = amplitude_of(run);
  const double seconds = run.in.options.duration.value_or(kSinePeriods * tests.period);
  TENON_CHECK(rig.begin(group));
  std::vector<double> centers;
  std::vector<double> sizes;
  for (const std::size_t row : group) {
    const DriveRange range = range_of(run.in.scene, run.in.rows[row], rig.home(row));
    sizes.push_back(std::min(tests.amplitude * range.size(), range.size() / 2));
    centers.push_back(center_of(range, rig.home(row), sizes.back()));
  }
  const auto count = static_cast<std::size_t>(std::ceil(seconds / rig.time_step()));
  bool well = true;
  for (std::size_t n = 0; n < count && well; ++n) {
    const double phase = 2 * kPi * static_cast<double>(n + 1) * rig.time_step() / tests.period;
    for (std::size_t i = 0; i < group.size(); ++i) {
      TENON_CHECK(rig.command(group[i], centers[i] + sizes[i] * std::sin(phase)));
    }
    TENON_TRY(const bool stable, rig.step());
    well = stable && run.go_on(rig.time_step());
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    DriveTestResult result;
    result.row = group[i];
    result.signal = rig.take_signal(i);
    if (well) {
      const auto first = static_cast<std::size_t>(tests.period / rig.time_step());
      result.sine = sine_metrics(result.signal, std::min(first, result.signal.size() / 2), sizes[i],
                                 tests.period, rig.max_force(group[i]));
      judge_sine(run, result);
    } else {
      result.verdict = stopped_verdict(run);
    }
    tests.results.push_back(std::move(result));
  }
  return {};
}

Result<void> run_steps(TestRun& run, Rig& rig, const std::vector<std::size_t>& group,
                       DriveTests& tests) {
  tests.period = run.in.options.period.value_or(kStepPeriod);
  tests.amplitude = amplitude_of(run);
  const double own = rig.time_step();
  std::vector<DriveTestResult> results(group.size());
  std::vector<std::vector<Signal>> signals;  // from the step on, by time step
  std::vector<double> sizes(group.size(), 1);
  bool stable = true;
  for (const double part : {4.0, 2.0, 1.0, 0.5, 0.25, 0.125}) {
    TENON_TRY(Rig one, Rig::make(run.in.scene, run.in.rows, run.in.make, own * part));
    std::vector<Way> ways;
    TENON_TRY(const auto begin, step_all(run, one, group, ways, tests.period));
    if (run.interrupted()) {
      break;
    }
    signals.emplace_back(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
      StepsRow row;
      row.time_step = one.time_step();
      Signal signal = one.take_signal(i);
      if (begin) {
        row.metrics = step_metrics(signal, *begin, ways[i].to, one.max_force(group[i]));
        sizes[i] = std::fabs(ways[i].to - ways[i].from);
        Signal& kept = signals.back()[i];
        for (std::size_t at = *begin; at < signal.size(); ++at) {
          kept.time.push_back(signal.time[at] - signal.time[*begin]);
          kept.position.push_back(signal.position[at]);
        }
      } else {
        row.gap = scene::kUnlimited;
      }
      stable = stable && (begin || part > 1);
      results[i].steps.push_back(row);
      results[i].signal = part == 1 ? std::move(signal) : std::move(results[i].signal);
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    results[i].row = group[i];
    results[i].verdict = !stable             ? Verdict::Unstable
                         : run.interrupted() ? Verdict::Skipped
                                             : Verdict::Pass;
    for (std::size_t n = 0; n < results[i].steps.size(); ++n) {
      StepsRow& row = results[i].steps[n];
      const double gap = largest_gap(signals[n][i], signals.back()[i]);
      row.gap = row.gap > 0 ? row.gap : gap / std::max(sizes[i], 1e-12);
    }
    tests.results.push_back(std::move(results[i]));
  }
  return {};
}

}  // namespace tenon::tuning
