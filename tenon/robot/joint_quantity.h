// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tenon/math/angle.h"

/// Numbers of joints that know their unit, so that none reaches a file in the wrong one: formats of
/// robots and engines count angles in radians, layers (UsdPhysics, PhysX, Newton) in degrees.
namespace tenon::robot {

/// What the coordinate of a joint is.
enum class Motion : std::uint8_t {
  Angular,  ///< an angle [rad; in layers degrees]
  Linear,   ///< a length [m]
};

/// A number of one joint, held in SI. `Power` is the exponent of the coordinate in its unit.
template <int Power>
class JointQuantity {
 public:
  constexpr JointQuantity() = default;

  /// From metres, radians, newtons, seconds.
  static constexpr JointQuantity from_si(double value, Motion motion) { return {value, motion}; }
  /// From the units of a layer with metersPerUnit = kilogramsPerUnit = 1: degrees for radians.
  static constexpr JointQuantity from_layer(double value, Motion motion) {
    return {value / factor(motion), motion};
  }

  constexpr double si() const { return value_; }
  constexpr double in_layer() const { return value_ * factor(motion_); }
  constexpr Motion motion() const { return motion_; }
  constexpr bool operator==(const JointQuantity&) const = default;

 private:
  constexpr JointQuantity(double value, Motion motion) : value_(value), motion_(motion) {}

  /// Layer units for one SI unit.
  static constexpr double factor(Motion motion) {
    if (motion == Motion::Linear || Power == 0) {
      return 1;
    }
    return Power > 0 ? kDegreesPerRadian : 1 / kDegreesPerRadian;
  }

  double value_ = 0;
  Motion motion_ = Motion::Linear;
};

using JointPosition = JointQuantity<1>;    ///< rad or m
using JointVelocity = JointQuantity<1>;    ///< rad/s or m/s
using JointEffort = JointQuantity<0>;      ///< N m or N
using JointInertia = JointQuantity<0>;     ///< kg m^2 or kg
using JointStiffness = JointQuantity<-1>;  ///< N m/rad or N/m
using JointDamping = JointQuantity<-1>;    ///< N m s/rad or N s/m

}  // namespace tenon::robot
