// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/robot/robot_model.h"

namespace tenon::mjcf {

/// Reads a model in MuJoCo's own format by MuJoCo's own parser and compiler: includes, default
/// classes, angles, orientations of every kind and inertias from geoms are resolved by it. The
/// model's root is a link without mass that represents the world.
///
/// Coordinates count from where the model stands (MuJoCo's `ref` becomes 0). A body with several
/// joints becomes a chain of links, those between with a millionth of its mass. Materials have
/// their images where these are files laid out by texture coordinates; wrapped cubes, patterns that
/// MuJoCo paints and images on shapes without such coordinates are their mean colour. These,
/// sensors and what else a RobotModel cannot hold go to `diagnostics` by name, with lines where
/// MuJoCo keeps them. Errors: NotFound, Parse and Invalid with MuJoCo's words.
Result<robot::RobotModel> read_mjcf(const std::string& path, Diagnostics& diagnostics);

}  // namespace tenon::mjcf
