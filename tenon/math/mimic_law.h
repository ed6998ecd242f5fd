// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace tenon {

/// What a mimic joint says of its follower, in either description of a robot: the position of the
/// follower, offset + multiplier x + higher[0] x^2 + ..., where its leader is at x [rad or m].
template <class Mimic>
double mimic_position(const Mimic& mimic, double leader) {
  double position = mimic.offset + mimic.multiplier * leader;
  double power = leader;
  for (const double coefficient : mimic.higher) {
    power *= leader;
    position += coefficient * power;
  }
  return position;
}

/// The follower's speed by the leader's: the slope of `mimic_position` there.
template <class Mimic>
double mimic_slope(const Mimic& mimic, double leader) {
  double slope = mimic.multiplier;
  double power = 1;  // x^(n - 1) of the term of x^n
  double exponent = 1;
  for (const double coefficient : mimic.higher) {
    power *= leader;
    exponent += 1;
    slope += exponent * coefficient * power;
  }
  return slope;
}

/// Whether no power above the first counts.
template <class Mimic>
bool mimic_is_linear(const Mimic& mimic) {
  return mimic.higher == decltype(mimic.higher){};
}

}  // namespace tenon
