// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// An ellipsoid that collides, as a mesh of few points: engines know no ellipsoids, and take a
/// sphere that is scaled unevenly for a ball or refuse it. "tenon:ellipsoid" has the semi-axes [m],
/// which are along the mesh's own axes.
Path write_ellipsoid(RobotLayer& layer, Path link, Token name, const Vec3d& half_extents,
                     const Pose& pose);

}  // namespace tenon::convert
