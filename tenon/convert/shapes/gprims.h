// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes a shape of no mesh below `link`: a prim of its kind, whose size is in its own attributes
/// as far as these can say it, else in its scale. Returns its path.
Path write_gprim(RobotLayer& layer, Path link, Token name, const robot::Geometry& geometry,
                 const Pose& pose);

}  // namespace tenon::convert
