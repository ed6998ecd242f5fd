// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/math/functions.h"
#include "tenon/math/vector.h"

/// Settings of bodies, colliders and drives that UsdPhysics does not have and engines may use, each
/// with its meaning where it is not authored.
namespace tenon::scene {

/// A constant force and torque on a body.
struct BodyForce {
  Path source;                ///< the prim that authors it: the body, or one below it
  Vec3d force;                ///< [N]; with `acceleration` [m/s^2], times the mass
  Vec3d torque;               ///< [N m]; with `acceleration` [rad/s^2], times the inertia
  Vec3d point;                ///< where the force acts, in the body frame [m]
  bool acceleration = false;  ///< per unit of mass and inertia
  bool body_axes = false;     ///< force and torque turn with the body; else world axes
};

struct BodySettings {
  std::vector<BodyForce> forces;
  /// Speeds are cut to these after each step [m/s], [rad/s].
  double max_linear_velocity = kInfinity;
  double max_angular_velocity = kInfinity;
  int locked_translation = 0;   ///< world axes that it does not move along: 1 x, 2 y, 4 z
  int locked_rotation = 0;      ///< world axes that it does not turn about: 1 x, 2 y, 4 z
  bool gyroscopic = true;       ///< false: turns as if its inertia were that of a ball
  bool solves_contacts = true;  ///< false: its contacts exert nothing
};

/// Touching bodies are carried along the surface with this velocity.
struct SurfaceVelocity {
  Vec3d linear;           ///< [m/s]
  Vec3d angular;          ///< about the body's origin [rad/s]
  bool body_axes = true;  ///< in the axes of the body; else world axes
};

struct ColliderSettings {
  bool trigger = false;  ///< touches nothing, tells what enters and leaves it
  /// Radius of the patch by which a contact resists turning about its normal [m]: at least
  /// `min_torsional_patch`, and that of a ball of radius `torsional_patch` pressed in so deep.
  double torsional_patch = 0;
  double min_torsional_patch = 0;
  std::optional<SurfaceVelocity> surface_velocity;
};

/// The effort of a motor at a speed: beside its own maximum it is at most max_force -
/// velocity_resistance |v|, and |v| at most max_velocity - speed_effort_gradient |F|.
struct DriveEnvelope {
  double max_velocity = kInfinity;   ///< [m/s or rad/s]
  double speed_effort_gradient = 0;  ///< [m/s/N or rad/s/(N m)]
  double velocity_resistance = 0;    ///< [N s/m or N m s/rad]
};

}  // namespace tenon::scene
