// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "tenon/base/diagnostics.h"
#include "tenon/math/angle.h"
#include "tenon/math/vector.h"
#include "tenon/stage/stage.h"

namespace tenon::physics {

/// From the stage's units to SI: multiply (S-12).
struct Units {
  double length = 0.01;  ///< metres per unit; unauthored 0.01 (S-7)
  double mass = 1;       ///< kilograms per unit (S-8)
  Vec3d up{{0, 1, 0}};
  double rate = 1;  ///< units of time per second in UsdPhysics attributes (S-10)

  double density() const { return mass / (length * length * length); }
  double inertia() const { return mass * length * length; }
  double force() const { return mass * length; }
  double torque() const { return mass * length * length; }
};

/// Values that mean "unset" or "unlimited": infinite, or beyond half of what a float holds (S-4).
inline bool is_sentinel(double value) { return std::isinf(value) || std::fabs(value) >= 0.5e38; }

/// `value` with sentinels as true infinities.
inline double unlimited_or(double value) {
  return is_sentinel(value) ? std::copysign(std::numeric_limits<double>::infinity(), value) : value;
}

/// S-7 to S-9; unusable metadata are reported and the fallbacks taken. Rates of time codes that are
/// not positive numbers are reported and taken as they are.
Units read_units(const stage::Stage& stage, Diagnostics& diagnostics);

}  // namespace tenon::physics
