// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/math/functions.h"
#include "tenon/math/vector.h"

namespace tenon::robot {

inline constexpr double kUnlimited = kInfinity;

enum class SiteSensorKind : std::uint8_t {
  Imu,          ///< acceleration, angular velocity, orientation
  Contact,      ///< contacts of the link within `radius`
  ForceTorque,  ///< what carries the link exerts on it
  Frame,        ///< where the site is and how it moves
  Rays,         ///< how far along `directions` something is
};

/// What is measured at a site, along its axes.
struct SiteSensor {
  std::string name;
  SiteSensorKind kind = SiteSensorKind::Imu;
  double radius = 0;  ///< of Contact [m]; below 0: the whole link
  double period = 0;  ///< from one measurement to the next [s]; 0: always
  // Of Rays.
  std::vector<Vec3d> directions{};  ///< unit
  double min_range = 0;             ///< nearer is nothing [m]
  double max_range = kUnlimited;    ///< farther is nothing [m]
};

}  // namespace tenon::robot
