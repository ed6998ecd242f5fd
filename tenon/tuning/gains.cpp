// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One coordinate with all others held is a mass on a spring and a damper: those of the drive and
// those of the joint add up. Of an acceleration drive the gains count per unit of what it moves, so
// the inertia divides only what the joint has of its own.
//
// Steps: with x the way to the target, a = D dt / m and b = K dt^2 / m one step of a drive whose
// spring is taken at the beginning and whose damper at the end is
//   v' = (v - (K dt / m) x) / (1 + a),  x' = x + dt v',
// with the characteristic polynomial z^2 - (1 + (1 - b) / (1 + a)) z + 1 / (1 + a), which is stable
// for b < 4 + 2 a (Jury). With the damper of the beginning it is z^2 - (2 - a - b) z + 1 - a:
// stable for a < 2 and b < 4 - 2 a. With both at the end it is always stable:
//   v' = (v - (K dt / m) x) / (1 + a + b).
#include "tenon/tuning/gains.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "tenon/base/text/rounded_text.h"
#include "tenon/math/angle.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::tuning {
namespace {

constexpr double kCriticalBand = 1e-3;

/// The joint's own spring and damper as the drive counts.
Gains passive_of(const Load& load) {
  const double unit = load.acceleration ? load.inertia : 1;
  return {load.passive.stiffness / unit, load.passive.damping / unit};
}

double moved_of(const Load& load) { return load.acceleration ? 1 : load.inertia; }

/// The first time at which the closed form has come so far.
double time_at(const Response& response, double part) {
  double low = 0;
  double high = 1 / response.frequency;
  while (step_response(response, high) < part && high * response.frequency < 1e9) {
    low = high;
    high *= 1.1;
  }
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (step_response(response, middle) < part ? low : high) = middle;
  }
  return high;
}

bool is_authored(const scene::PhysicsScene& scene, std::string_view name, std::string_view value) {
  if (scene.scenes.empty() || !scene.scenes.front().parts.mujoco) {
    return false;
  }
  const auto& settings = *scene.scenes.front().parts.mujoco;
  return std::any_of(settings.begin(), settings.end(), [&](const auto& setting) {
    return setting.name == name && (value.empty() || setting.token == value);
  });
}

/// A step of Runge and Kutta multiplies by 1 + z + z^2/2 + z^3/6 + z^4/24 with z = lambda dt.
bool is_stable_by_taylor(double ratio, double coarse) {
  const std::complex<double> root = std::sqrt(std::complex<double>(ratio * ratio - 1, 0));
  for (const double side : {-1.0, 1.0}) {
    const std::complex<double> z = coarse * (-ratio + side * root);
    const std::complex<double> grown = 1.0 + z * (1.0 + z * (0.5 + z * (1.0 / 6 + z / 24.0)));
    if (std::abs(grown) > 1 + 1e-9) {
      return false;
    }
  }
  return true;
}

double taylor_bound(double ratio) {
  constexpr double kStep = 1e-3;
  double coarse = kStep;
  while (coarse < 4 && is_stable_by_taylor(ratio, coarse + kStep)) {
    coarse += kStep;
  }
  return coarse;
}

}  // namespace

Regime regime_of(double ratio) {
  return std::fabs(ratio - 1) <= kCriticalBand ? Regime::Critical
         : ratio < 1                           ? Regime::Underdamped
                                               : Regime::Overdamped;
}

std::string_view regime_name(Regime regime) {
  return regime == Regime::Underdamped ? "underdamped"
         : regime == Regime::Critical  ? "critical"
                                       : "overdamped";
}

Response response_of(const Gains& gains, const Load& load) {
  const Gains passive = passive_of(load);
  const double mass = moved_of(load);
  const double stiffness = std::max(gains.stiffness + passive.stiffness, 0.0);
  const double damping = gains.damping + passive.damping;
  Response response;
  response.frequency = std::sqrt(stiffness / mass);
  response.ratio = stiffness > 0 ? damping / (2 * std::sqrt(stiffness * mass)) : 0;
  return response;
}

WantedGains gains_for(const Response& wanted, const Load& load) {
  const Gains passive = passive_of(load);
  const double mass = moved_of(load);
  const double stiffness = mass * wanted.frequency * wanted.frequency - passive.stiffness;
  const double damping = 2 * wanted.ratio * mass * wanted.frequency - passive.damping;
  return {{std::max(stiffness, 0.0), std::max(damping, 0.0)}, stiffness < 0, damping < 0};
}

double step_response(const Response& response, double time) {
  const double omega = response.frequency;
  const double zeta = response.ratio;
  const double square = 1 - zeta * zeta;
  if (std::fabs(square) < 1e-9) {
    return 1 - std::exp(-omega * time) * (1 + omega * time);
  }
  if (square > 0) {
    const double damped = omega * std::sqrt(square);
    return 1 - std::exp(-zeta * omega * time) *
                   (std::cos(damped * time) + zeta * omega / damped * std::sin(damped * time));
  }
  const double root = std::sqrt(-square);
  const double slow = omega * (zeta - root);
  const double fast = omega * (zeta + root);
  return 1 - (fast * std::exp(-slow * time) - slow * std::exp(-fast * time)) / (fast - slow);
}

double overshoot_of(double ratio) {
  return ratio < 1 ? std::exp(-kPi * ratio / std::sqrt(1 - ratio * ratio)) : 0;
}

double rise_time_of(const Response& response) {
  return response.frequency > 0 ? time_at(response, 0.9) - time_at(response, 0.1)
                                : scene::kUnlimited;
}

double bandwidth_of(const Response& response) {
  const double bend = 1 - 2 * response.ratio * response.ratio;
  return response.frequency * std::sqrt(bend + std::sqrt(bend * bend + 1));
}

// MuJoCo: steps are implicit in velocity, and drives that are stiff for the step are solved where
// it ends (engines/mujoco/run/coupled_drives.h), unless the asset authors an integrator or the
// solver pgs. PhysX and Jolt damp by K dt at least (engines/physx/run/drives.cpp,
// engines/jolt/run/coordinate_law.cpp): where 2 zeta < omega dt both terms are of the end, else
// b <= a, which is stable.
Stepping stepping_of(std::string_view engine, const scene::PhysicsScene& scene) {
  if (engine != "mujoco") {
    return Stepping::Implicit;
  }
  if (is_authored(scene, "option:integrator", "rk4")) {
    return Stepping::RungeKutta4;
  }
  if (is_authored(scene, "option:integrator", "euler")) {
    return Stepping::Explicit;
  }
  const bool fixed =
      is_authored(scene, "option:integrator", "") || is_authored(scene, "option:solver", "pgs");
  return fixed ? Stepping::ImplicitDamper : Stepping::Implicit;
}

double stiffest_stable(Stepping stepping, double ratio, double time_step) {
  switch (stepping) {
    case Stepping::Explicit: {
      // x^2 + 4 zeta x - 4 = 0 and 2 zeta x = 2 for x = omega dt
      const double by_spring = 2 * (std::sqrt(ratio * ratio + 1) - ratio);
      return std::min(by_spring, ratio > 0 ? 1 / ratio : scene::kUnlimited) / time_step;
    }
    case Stepping::RungeKutta4:
      return taylor_bound(ratio) / time_step;
    case Stepping::ImplicitDamper:
      return 2 * (std::sqrt(ratio * ratio + 1) + ratio) / time_step;
    case Stepping::Implicit:
      break;
  }
  return scene::kUnlimited;
}

std::string sampling_note(double frequency, double time_step) {
  const double coarse = frequency * time_step;
  return coarse > kUnderSampled ? "under-sampled: omega*dt = " + rounded_text(coarse, 3) +
                                      " > 0.5 (the response will be slower than the form)"
                                : "";
}

}  // namespace tenon::tuning
