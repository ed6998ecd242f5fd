// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/robot/robot_model.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::describe {

/// The visuals of `stage` by the bodies of `scene`, which is read from it: a link for each body in
/// the order of the scene, in the body's frame, and one more for the world. Only visuals, sites
/// (both named by their paths), meshes and materials are filled in; paths of images are as they
/// resolve, empty where they do not. What a RobotModel cannot express goes to `diagnostics` as
/// "mjcf.left-out" with the prim.
robot::RobotModel describe_visuals(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                   Diagnostics& diagnostics);

}  // namespace tenon::describe
