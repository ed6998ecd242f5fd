// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

/// The table of sensors.
namespace tenon::scene {

template <>
struct Table<Sensor> {
  static constexpr std::string_view kWord = "sensor";
  static constexpr Rows kFields{
      field<&Sensor::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&Sensor::kind>({.name = "kind", .meaning = "what it measures", .role = Role::Identity}),
      field<&Sensor::enabled>({.name = "enabled", .meaning = "false: it reads nothing"}),
      field<&Sensor::body>({.name = "body",
                            .meaning = "that it is fixed to; null: it measures a joint",
                            .refers = List::Bodies}),
      field<&Sensor::joint>({.name = "joint",
                             .meaning = "that it measures, or that holds its body",
                             .refers = List::Joints,
                             .presence = Presence::WhenSet}),
      field<&Sensor::pose>({.name = "pose", .meaning = "body <- sensor", .inlined = true}),
      field<&Sensor::period>({.name = "period",
                              .meaning = "from one measurement to the next; 0: each step",
                              .unit = Unit::Second,
                              .presence = Presence::WhenSet}),
      field<&Sensor::radius>({.name = "radius",
                              .meaning = "about its origin; contacts farther away do not count",
                              .unit = Unit::Meter,
                              .presence = Presence::WhenSet}),
      field<&Sensor::min_force>({.name = "minForce",
                                 .meaning = "less is no contact",
                                 .unit = Unit::Newton,
                                 .presence = Presence::WhenSet}),
      field<&Sensor::max_force>({.name = "maxForce",
                                 .meaning = "more reads as this",
                                 .unit = Unit::Newton,
                                 .presence = Presence::WhenSet}),
      field<&Sensor::acceleration_width>({.name = "accelerationWidth",
                                          .meaning = "measurements in the mean that is read",
                                          .presence = Presence::WhenSet}),
      field<&Sensor::velocity_width>({.name = "velocityWidth",
                                      .meaning = "measurements in the mean that is read",
                                      .presence = Presence::WhenSet}),
      field<&Sensor::orientation_width>({.name = "orientationWidth",
                                         .meaning = "measurements in the mean that is read",
                                         .presence = Presence::WhenSet}),
      field<&Sensor::ray_origins>({.name = "rayOrigins",
                                   .meaning = "in its frame",
                                   .unit = Unit::Meter,
                                   .presence = Presence::WhenSet}),
      field<&Sensor::ray_directions>({.name = "rayDirections",
                                      .meaning = "unit, in its frame",
                                      .presence = Presence::WhenSet}),
      field<&Sensor::min_range>({.name = "minRange",
                                 .meaning = "what is nearer is nothing",
                                 .unit = Unit::Meter,
                                 .presence = Presence::WhenSet}),
      field<&Sensor::max_range>({.name = "maxRange",
                                 .meaning = "what is farther is nothing",
                                 .unit = Unit::Meter,
                                 .presence = Presence::WhenSet}),
  };
};

}  // namespace tenon::scene
