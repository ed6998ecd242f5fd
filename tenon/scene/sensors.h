// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/math/functions.h"
#include "tenon/math/transform.h"

/// Sensors of an asset: what they are fixed to and how they measure. Engines need not know them;
/// their readings are computed from what every engine gives (tenon/engines/sensors.h).
namespace tenon::scene {

enum class SensorKind : std::uint8_t {
  Contact,      ///< how hard the body is touched
  Imu,          ///< proper acceleration, angular velocity and orientation of its frame
  ForceTorque,  ///< what the joint that holds the body exerts on it
  Joint,        ///< coordinates, velocities and drive efforts of a joint
  Frame,        ///< where its frame is and how that moves
  Rays,         ///< how far along rays other bodies and what stands still are
};

/// "contact", "imu", "forceTorque", "joint", "frame", "rays".
std::string_view sensor_kind_name(SensorKind kind);

struct Sensor {
  Path path;  ///< the prim; of Joint that of the joint
  SensorKind kind = SensorKind::Contact;
  bool enabled = true;                  ///< false: it reads nothing
  std::optional<std::uint32_t> body{};  ///< that it is fixed to; none: Joint
  /// Of Joint: the one that it measures; of ForceTorque: the one that holds the body.
  std::optional<std::uint32_t> joint{};
  Pose pose;          ///< X_BS in the body frame [m]
  double period = 0;  ///< from one measurement to the next [s]; 0: one in each step
  // Of Contact.
  double radius = kInfinity;     ///< about its origin; points farther away do not count [m]
  double min_force = 0;          ///< less is no contact [N]
  double max_force = kInfinity;  ///< more reads as this [N]
  // Of Imu: a reading is the mean of so many measurements, the last ones.
  int acceleration_width = 1;
  int velocity_width = 1;
  int orientation_width = 1;
  // Of Rays, in its frame.
  std::vector<Vec3d> ray_origins;     ///< (ray_count) [m]
  std::vector<Vec3d> ray_directions;  ///< (ray_count), unit
  double min_range = 0;               ///< what is nearer to an origin is nothing [m]
  double max_range = kInfinity;       ///< what is farther is nothing [m]
};

}  // namespace tenon::scene
