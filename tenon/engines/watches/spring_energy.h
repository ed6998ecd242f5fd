// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace tenon::engines {

/// A drive towards a position, as a spring whose force is bounded.
struct DriveSpring {
  double target = 0;     ///< [m or rad]
  double stiffness = 0;  ///< [N/m or N m/rad]
  double most = 0;       ///< force [N or N m]; may be infinite

  /// What it holds at a position [J].
  double energy_at(double position) const {
    const double stretch = std::fabs(position - target);
    return stiffness * stretch <= most ? stiffness * stretch * stretch / 2
                                       : most * stretch - most * most / (2 * stiffness);
  }
  /// What a limit gives it by bringing a joint that begins outside back to its bounds [J].
  double given_by_limit(double position, double lower, double upper) const {
    const double bound = std::clamp(position, lower, std::max(lower, upper));
    return std::max(energy_at(bound) - energy_at(position), 0.0);
  }
};

}  // namespace tenon::engines
