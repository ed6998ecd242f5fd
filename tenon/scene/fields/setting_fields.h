// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

/// The tables of settings that UsdPhysics does not have, and of MuJoCo's actuators.
namespace tenon::scene {

/// The row of the settings of an object.
inline constexpr FieldInfo kSettingsField{
    .name = "settings", .meaning = "beside UsdPhysics", .inlined = true};

template <>
struct Table<BodyForce> {
  static constexpr std::string_view kWord = "force";
  static constexpr Rows kFields{
      field<&BodyForce::source>(
          {.name = "source", .meaning = "the prim that authors it", .role = Role::Identity}),
      field<&BodyForce::force>({.name = "force",
                                .meaning = "constant; of type acceleration in m/s^2",
                                .unit = Unit::Newton}),
      field<&BodyForce::torque>({.name = "torque",
                                 .meaning = "constant; of type acceleration in rad/s^2",
                                 .unit = Unit::NewtonMeter}),
      field<&BodyForce::point>(
          {.name = "point", .meaning = "where it acts, in the body frame", .unit = Unit::Meter}),
      field<&BodyForce::acceleration>({.name = "type",
                                       .meaning = "acceleration: per unit of mass and inertia",
                                       .off = "force",
                                       .on = "acceleration"}),
      field<&BodyForce::body_axes>(
          {.name = "bodyAxes", .meaning = "it turns with the body; else world axes"}),
  };
};

template <>
struct Table<BodySettings> {
  static constexpr std::string_view kWord = "settings";
  static constexpr Rows kFields{
      field<&BodySettings::forces>(
          {.name = "forces", .meaning = "that act all the time", .presence = Presence::WhenSet}),
      field<&BodySettings::max_linear_velocity>({.name = "maxLinearVelocity",
                                                 .meaning = "its speed is cut to it",
                                                 .unit = Unit::MeterPerSecond,
                                                 .presence = Presence::WhenSet}),
      field<&BodySettings::max_angular_velocity>({.name = "maxAngularVelocity",
                                                  .meaning = "its speed is cut to it",
                                                  .unit = Unit::RadianPerSecond,
                                                  .presence = Presence::WhenSet}),
      field<&BodySettings::locked_translation>(
          {.name = "lockedTranslation",
           .meaning = "world axes that it does not move along: 1 x, 2 y, 4 z",
           .presence = Presence::WhenSet}),
      field<&BodySettings::locked_rotation>(
          {.name = "lockedRotation",
           .meaning = "world axes that it does not turn about: 1 x, 2 y, 4 z",
           .presence = Presence::WhenSet}),
      field<&BodySettings::gyroscopic>({.name = "gyroscopic",
                                        .meaning = "false: it turns like a ball",
                                        .presence = Presence::WhenSet}),
      field<&BodySettings::solves_contacts>({.name = "solvesContacts",
                                             .meaning = "false: its contacts exert nothing",
                                             .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<SurfaceVelocity> {
  static constexpr std::string_view kWord = "surface velocity";
  static constexpr Rows kFields{
      field<&SurfaceVelocity::linear>(
          {.name = "linear", .meaning = "of what it carries along", .unit = Unit::MeterPerSecond}),
      field<&SurfaceVelocity::angular>({.name = "angular",
                                        .meaning = "about the origin of the body",
                                        .unit = Unit::RadianPerSecond}),
      field<&SurfaceVelocity::body_axes>(
          {.name = "bodyAxes", .meaning = "it turns with the body; else world axes"}),
  };
};

template <>
struct Table<ColliderSettings> {
  static constexpr std::string_view kWord = "settings";
  static constexpr Rows kFields{
      field<&ColliderSettings::trigger>({.name = "trigger",
                                         .meaning = "touches nothing, tells what enters it",
                                         .presence = Presence::WhenSet}),
      field<&ColliderSettings::torsional_patch>(
          {.name = "torsionalPatchRadius",
           .meaning = "with the depth the radius of the patch that resists turning",
           .unit = Unit::Meter,
           .presence = Presence::WhenSet}),
      field<&ColliderSettings::min_torsional_patch>({.name = "minTorsionalPatchRadius",
                                                     .meaning = "the least radius of that patch",
                                                     .unit = Unit::Meter,
                                                     .presence = Presence::WhenSet}),
      field<&ColliderSettings::surface_velocity>({.name = "surfaceVelocity",
                                                  .meaning = "of the surface on the body",
                                                  .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<Compliance> {
  static constexpr std::string_view kWord = "compliance";
  static constexpr Rows kFields{
      field<&Compliance::stiffness>(
          {.name = "stiffness", .meaning = "N/m, of type acceleration 1/s^2; 0: hard"}),
      field<&Compliance::damping>(
          {.name = "damping", .meaning = "N s/m, of type acceleration 1/s"}),
      field<&Compliance::acceleration>({.name = "type",
                                        .meaning = "acceleration: per unit of effective mass",
                                        .off = "force",
                                        .on = "acceleration"}),
      field<&Compliance::damping_combine>(
          {.name = "dampingCombine", .meaning = "how two become that of a pair"}),
  };
};

template <>
struct Table<LimitSpring> {
  static constexpr std::string_view kWord = "limit spring";
  static constexpr Rows kFields{
      field<&LimitSpring::dof>(
          {.name = "dof", .meaning = "degree of freedom", .role = Role::Identity}),
      field<&LimitSpring::stiffness>(
          {.name = "stiffness", .meaning = "beyond the bound; 0: hard", .unit = Unit::Stiffness}),
      field<&LimitSpring::damping>(
          {.name = "damping", .meaning = "beyond the bound", .unit = Unit::Damping}),
      field<&LimitSpring::restitution>(
          {.name = "restitution", .meaning = "of a hard bound: speed after to speed before"}),
      field<&LimitSpring::bounce_threshold>({.name = "bounceThreshold",
                                             .meaning = "slower impacts do not rebound",
                                             .unit = Unit::Velocity}),
  };
};

template <>
struct Table<DriveEnvelope> {
  static constexpr std::string_view kWord = "envelope";
  static constexpr Rows kFields{
      field<&DriveEnvelope::max_velocity>({.name = "maxVelocity",
                                           .meaning = "above it the drive exerts nothing",
                                           .unit = Unit::Velocity,
                                           .presence = Presence::WhenSet}),
      field<&DriveEnvelope::speed_effort_gradient>(
          {.name = "speedEffortGradient",
           .meaning = "|v| <= maxVelocity - speedEffortGradient |effort|",
           .presence = Presence::WhenSet}),
      field<&DriveEnvelope::velocity_resistance>(
          {.name = "velocityResistance",
           .meaning = "|effort| <= maxForce - velocityResistance |v|",
           .unit = Unit::Damping,
           .presence = Presence::WhenSet}),
  };
};

}  // namespace tenon::scene
