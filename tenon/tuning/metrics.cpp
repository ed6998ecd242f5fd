// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Times of crossings are interpolated between samples, so that a rise of a few steps is not rounded
// to the step. The overshoot is that of a parabola through the largest sample and its neighbours,
// for the same reason. Lag and gain of a sine are those of its first harmonic, by projection onto
// sine and cosine over whole periods.
#include "tenon/tuning/metrics.h"

#include <algorithm>
#include <cmath>

#include "tenon/math/angle.h"

namespace tenon::tuning {
namespace {

constexpr double kSettled = 0.02;   ///< of the step
constexpr double kAtBound = 0.999;  ///< of the largest force

/// The way of sample `i` as a part of the step.
double part_at(const Signal& signal, std::size_t i, double from, double size) {
  return (signal.position[i] - from) / size;
}

/// The first time at which `part` of the step is reached.
std::optional<double> crossing(const Signal& signal, std::size_t begin, double from, double size,
                               double part) {
  for (std::size_t i = begin + 1; i < signal.size(); ++i) {
    const double before = part_at(signal, i - 1, from, size);
    const double after = part_at(signal, i, from, size);
    if (before < part && after >= part) {
      return signal.time[i - 1] +
             (part - before) / (after - before) * (signal.time[i] - signal.time[i - 1]);
    }
  }
  return std::nullopt;
}

double peak_of(const Signal& signal, std::size_t begin, double from, double size) {
  std::size_t best = begin;
  for (std::size_t i = begin; i < signal.size(); ++i) {
    if (part_at(signal, i, from, size) > part_at(signal, best, from, size)) {
      best = i;
    }
  }
  const double middle = part_at(signal, best, from, size);
  if (best == begin || best + 1 >= signal.size()) {
    return middle;
  }
  const double left = part_at(signal, best - 1, from, size);
  const double right = part_at(signal, best + 1, from, size);
  const double bend = left - 2 * middle + right;
  return bend < 0 ? middle - (left - right) * (left - right) / (8 * bend) : middle;
}

std::optional<double> settling_of(const Signal& signal, std::size_t begin, double target,
                                  double size) {
  std::size_t last_outside = begin;
  for (std::size_t i = begin; i < signal.size(); ++i) {
    if (!(std::fabs(signal.position[i] - target) <= kSettled * std::fabs(size))) {
      last_outside = i;
    }
  }
  if (last_outside + 1 >= signal.size()) {
    return std::nullopt;
  }
  return signal.time[last_outside + 1] - signal.time[begin];
}

}  // namespace

std::optional<double> still_since(const Signal& signal, std::size_t begin, std::size_t end,
                                  const StillRule& rule) {
  std::optional<double> since;
  for (std::size_t i = begin; i < std::min(end, signal.size()); ++i) {
    if (!(std::fabs(signal.velocity[i]) < rule.speed)) {
      since.reset();
      continue;
    }
    since = since.value_or(signal.time[i]);
    if (signal.time[i] - *since >= rule.seconds - 1e-9) {
      return since;
    }
  }
  return std::nullopt;
}

HoldError hold_error(const Signal& signal, std::size_t begin, std::size_t end, double target) {
  HoldError error;
  end = std::min(end, signal.size());
  for (std::size_t i = begin; i < end; ++i) {
    const double one = std::fabs(signal.position[i] - target);
    error.mean += one / static_cast<double>(end - begin);
    error.most = std::max(error.most, one);
  }
  return error;
}

double saturation(const Signal& signal, std::size_t begin, std::size_t end, double max_force) {
  end = std::min(end, signal.effort.size());
  if (!std::isfinite(max_force) || begin >= end) {
    return 0;
  }
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    count += std::fabs(signal.effort[i]) >= kAtBound * max_force ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(end - begin);
}

StepMetrics step_metrics(const Signal& signal, std::size_t begin, double target, double max_force) {
  StepMetrics metrics;
  if (begin >= signal.size()) {
    return metrics;
  }
  const double from = signal.position[begin];
  const double size = target - from;
  if (size != 0) {
    metrics.overshoot = std::max(peak_of(signal, begin, from, size) - 1, 0.0);
    const auto low = crossing(signal, begin, from, size, 0.1);
    const auto high = crossing(signal, begin, from, size, 0.9);
    if (low && high) {
      metrics.rise_time = *high - *low;
    }
    metrics.settling_time = settling_of(signal, begin, target, size);
  }
  const std::size_t tail = std::max<std::size_t>(1, (signal.size() - begin) / 10);
  for (std::size_t i = signal.size() - tail; i < signal.size(); ++i) {
    metrics.steady_error += (target - signal.position[i]) / static_cast<double>(tail);
  }
  metrics.saturation = saturation(signal, begin, signal.size(), max_force);
  return metrics;
}

SineMetrics sine_metrics(const Signal& signal, std::size_t begin, double amplitude, double period,
                         double max_force) {
  SineMetrics metrics;
  const std::size_t count = signal.size();
  if (count < begin + 3 || !(period > 0)) {
    return metrics;
  }
  const double step = signal.time[begin + 1] - signal.time[begin];
  const double periods = std::floor(static_cast<double>(count - begin) * step / period + 1e-9);
  const auto used =
      std::min(static_cast<std::size_t>(std::llround(periods * period / step)), count - begin);
  if (used < 3) {
    return metrics;
  }
  const std::size_t first = count - used;
  const auto samples = static_cast<double>(used);
  const double omega = 2 * kPi / period;
  double in_sine = 0;
  double in_cosine = 0;
  double out_sine = 0;
  double out_cosine = 0;
  for (std::size_t i = first; i < count; ++i) {
    const double sine = std::sin(omega * signal.time[i]);
    const double cosine = std::cos(omega * signal.time[i]);
    in_sine += signal.command[i] * sine;
    in_cosine += signal.command[i] * cosine;
    out_sine += signal.position[i] * sine;
    out_cosine += signal.position[i] * cosine;
    const double error = signal.position[i] - signal.command[i];
    metrics.position_error += error * error / samples;
    metrics.offset += error / samples;
  }
  const double phase_in = std::atan2(in_cosine, in_sine);
  for (std::size_t i = first; i < count; ++i) {
    const double wanted = amplitude * omega * std::cos(omega * signal.time[i] + phase_in);
    const double error = signal.velocity[i] - wanted;
    metrics.velocity_error += error * error / samples;
  }
  metrics.position_error = std::sqrt(metrics.position_error);
  metrics.velocity_error = std::sqrt(metrics.velocity_error);
  const double size = std::hypot(in_sine, in_cosine);
  metrics.gain = size > 0 ? std::hypot(out_sine, out_cosine) / size : 0;
  double behind = phase_in - std::atan2(out_cosine, out_sine);
  behind = behind < -kPi / 2 ? behind + 2 * kPi : behind;
  metrics.lag = behind / omega;
  metrics.saturation = saturation(signal, first, count, max_force);
  return metrics;
}

double largest_gap(const Signal& first, const Signal& second) {
  double most = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    while (at + 1 < second.size() && second.time[at + 1] < first.time[i]) {
      ++at;
    }
    if (at + 1 >= second.size()) {
      break;
    }
    const double span = second.time[at + 1] - second.time[at];
    const double part = span > 0 ? (first.time[i] - second.time[at]) / span : 0;
    const double value =
        second.position[at] + part * (second.position[at + 1] - second.position[at]);
    most = std::max(most, std::fabs(first.position[i] - value));
  }
  return most;
}

}  // namespace tenon::tuning
