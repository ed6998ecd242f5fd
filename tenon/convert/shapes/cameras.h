// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// A UsdGeomCamera below a link's prim; what MuJoCo alone has a word for in attributes
/// "tenon:mujoco:" with MuJoCo's words behind that. Returns its path.
Path write_camera(RobotLayer& layer, const LinkPrims& links, Path link, NameScope& names,
                  const robot::Camera& camera);

/// A UsdLuxDistantLight or UsdLuxSphereLight, as bright for a renderer that counts in UsdLux's
/// units as robot::Light says; "tenon:mujoco:unitIntensity" is the intensity of a colour of 1.
void write_light(RobotLayer& layer, const LinkPrims& links, Path link, NameScope& names,
                 const robot::Light& light);

}  // namespace tenon::convert
