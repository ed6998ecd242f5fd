// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

/// How well one coordinate follows its command, from what was read back after each step. [m, s] or
/// [rad, s], efforts in [N] or [N m].
namespace tenon::tuning {

/// One row for each step, equally far apart. Each list has (sample_count) entries.
struct Signal {
  std::vector<double> time;
  std::vector<double> command;
  std::vector<double> position;
  std::vector<double> velocity;
  std::vector<double> effort;  ///< of the drive; empty: the engine does not give any

  std::size_t size() const { return time.size(); }
};

/// Still for `seconds` on end: slower than `speed`.
struct StillRule {
  double speed = 0.01;
  double seconds = 0.25;
};

/// The first moment [s] from `begin` (a sample) on at which the velocity has been below the bound
/// for so long; none: never before `end`.
std::optional<double> still_since(const Signal& signal, std::size_t begin, std::size_t end,
                                  const StillRule& rule);

/// How far it is from `target` in the samples begin..end.
struct HoldError {
  double mean = 0;
  double most = 0;
};
HoldError hold_error(const Signal& signal, std::size_t begin, std::size_t end, double target);

/// The share of the samples in which the effort is at its bound; 0 without one.
double saturation(const Signal& signal, std::size_t begin, std::size_t end, double max_force);

struct StepMetrics {
  double overshoot = 0;             ///< beyond the target, by the size of the step
  std::optional<double> rise_time;  ///< from 10 % to 90 % of the step [s]; none: never got there
  std::optional<double> settling_time;  ///< to stay within 2 % of the step around the target [s]
  double steady_error = 0;              ///< target less the mean of the last tenth
  double saturation = 0;
};

/// Of a step at sample `begin` from where the signal is then to `target`. Crossings are found
/// between samples (linear).
StepMetrics step_metrics(const Signal& signal, std::size_t begin, double target, double max_force);

struct SineMetrics {
  double position_error = 0;  ///< root of the mean square
  double velocity_error = 0;  ///< the same of the velocity
  double lag = 0;             ///< [s] of the first harmonic
  double gain = 0;            ///< its amplitude by that of the command
  double offset = 0;          ///< mean of position less mean of command
  double saturation = 0;
};

/// Of center + amplitude sin(2 pi t / period), over the last whole periods from sample `begin` on.
SineMetrics sine_metrics(const Signal& signal, std::size_t begin, double amplitude, double period,
                         double max_force);

/// The largest distance between two signals at the times of the first one.
double largest_gap(const Signal& first, const Signal& second);

}  // namespace tenon::tuning
