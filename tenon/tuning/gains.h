// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/dynamics/dynamics.h"
#include "tenon/scene/physics_scene.h"

/// Gains of drives as the response that they give, tests of drives, and what comes of them. SI
/// throughout: gains about an axis are per radian.
namespace tenon::tuning {

using scene::Index;

/// m q'' + D q' + K (q - target) = 0 as a second-order system.
struct Response {
  double frequency = 0;  ///< omega = sqrt(K / m) [rad/s]
  double ratio = 0;      ///< zeta = D / (2 sqrt(K m))
};

struct Gains {
  double stiffness = 0;  ///< [N m/rad or N/m]; of an acceleration drive [1/s^2]
  double damping = 0;    ///< [N m s/rad or N s/m]; of an acceleration drive [1/s]
};

enum class Regime : std::uint8_t { Underdamped, Critical, Overdamped };

/// Critical within one thousandth of 1.
Regime regime_of(double ratio);
/// "underdamped", "critical", "overdamped".
std::string_view regime_name(Regime regime);

/// What a drive of one coordinate has to move, and what moves that beside it.
struct Load {
  double inertia = 0;         ///< [kg m^2 or kg]
  bool acceleration = false;  ///< the gains of the drive are per unit of inertia
  Gains passive{};            ///< spring and damper of the joint itself [N m/rad, ... or N/m, ...]
};

/// The response of drive and joint together. `inertia` must be above 0 and finite.
Response response_of(const Gains& gains, const Load& load);

/// What a drive is to be given.
struct WantedGains {
  Gains gains;
  bool stiffness_is_least = false;  ///< the joint's own spring alone is stiffer than asked for
  bool damping_is_least = false;    ///< the joint's own damper alone damps more than asked for
};

/// The inverse of response_of: what the joint's own spring and damper give is taken off, never
/// below 0.
WantedGains gains_for(const Response& wanted, const Load& load);

// ---- the closed form: from rest at 0 to a target of 1

/// Where it is after `time` [s].
double step_response(const Response& response, double time);
/// exp(-pi zeta / sqrt(1 - zeta^2)); 0 from a ratio of 1 on.
double overshoot_of(double ratio);
/// From 10 % to 90 % of the way [s].
double rise_time_of(const Response& response);
/// Where the amplitude falls to 1 / sqrt(2), of a target that is followed by position alone
/// [rad/s].
double bandwidth_of(const Response& response);

// ---- time steps

/// When an engine takes the force of a drive that acts in a step.
enum class Stepping : std::uint8_t {
  Explicit,        ///< spring and damper of the beginning
  RungeKutta4,     ///< of four times in the step
  ImplicitDamper,  ///< the spring of the beginning, the damper of the end
  Implicit,        ///< both of the end, at least where the step is coarse for them
};

/// What tenon's adapter of an engine does with the drives of a scene, with the integrator and
/// solver that the asset authors.
Stepping stepping_of(std::string_view engine, const scene::PhysicsScene& scene);

/// The largest frequency [rad/s] at which a drive alone stays stable; infinite where every one
/// does. With a = 2 zeta omega dt, b = (omega dt)^2 the roots of the step leave the unit circle at
/// b = 4 - 2 a or a = 2 (Explicit), at b = 4 + 2 a (ImplicitDamper), where the Taylor polynomial of
/// fourth degree does (RungeKutta4).
double stiffest_stable(Stepping stepping, double ratio, double time_step);

/// Above this omega dt a response is slower than its form.
inline constexpr double kUnderSampled = 0.5;
/// "" where the step is fine enough; else "under-sampled: omega*dt = 0.63 > 0.5 (the response will
/// be slower than the form)".
std::string sampling_note(double frequency, double time_step);

// ---- the drives of a scene

/// One drive, or a joint that has none, and whether it can be tuned.
struct DriveRow {
  Index joint = 0;
  std::optional<Index> drive;  ///< into Joint::drives; none: the joint has none
  scene::Dof dof = scene::Dof::RotX;
  std::optional<std::size_t> coordinate;  ///< of Multibody::coordinates()
  std::size_t part = 0;                   ///< of joint_state(): its place there
  Gains gains;
  Load load;
  std::optional<Response> response;  ///< none: no stiffness, or nothing to move
  std::string why_not;               ///< it cannot be tuned; empty: it can
  bool velocity_drive = false;       ///< damping without stiffness: it follows velocities
  bool position_drive() const { return drive && why_not.empty() && gains.stiffness > 0; }
};

/// Every drive of every joint with a coordinate, and a row for each such joint that has none, in
/// the order of the scene. `inertia` is EffectiveInertia::held at the posture of `dynamics`.
std::vector<DriveRow> drive_rows(const dynamics::Multibody& multibody,
                                 const dynamics::Dynamics& dynamics);

}  // namespace tenon::tuning
