// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/robot/cameras_and_lights.h"

namespace tenon::robot {

/// Angle of view from the lower to the upper edge [degrees], 45 by default; orthographic: the
/// length between the two [m].
double field_of_view(const Camera& camera);

/// A lens in MuJoCo's words: its focal lengths in both directions, and where the axis hits the
/// film, from its middle to the right and down [m].
struct Lens {
  Vec2d focal;
  Vec2d principal;
};
/// The one that shows on a film of the size `sensor` [m] what the camera shows on its own, which
/// has a width.
Lens lens_of(const Camera& camera, const Vec2d& sensor);

}  // namespace tenon::robot
