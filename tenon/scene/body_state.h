// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/transform.h"

namespace tenon::scene {

/// Where a body is and how it moves, as a simulation has it.
struct BodyState {
  Pose pose;               ///< X_WB [m]
  Vec3d linear_velocity;   ///< of the centre of mass, world axes [m/s]
  Vec3d angular_velocity;  ///< world axes [rad/s]
};

}  // namespace tenon::scene
