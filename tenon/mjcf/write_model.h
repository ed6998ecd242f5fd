// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/mjcf/text/write_text.h"
#include "tenon/robot/robot_model.h"
#include "tenon/scene/mujoco_actuators.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::mjcf {

/// The scene as text in MuJoCo's own format (engines/mujoco/write_mjcf.h) with its visuals:
/// `visuals` has a link for each body of the scene, in its frame, and one more for the world; only
/// visuals, cameras, lights, meshes and materials are looked at. They become geoms of group 2 that
/// touch nothing and weigh nothing; colliders are in group 3. Files of images have the names that
/// the text uses, `images` their bytes. Shapes and materials that MuJoCo does not support go to
/// `diagnostics` as "mjcf.left-out", all visuals where MuJoCo refuses them. Of `parts`, of the same
/// stage, actuators are added after other drives, and keyframes. Elements are named by `name_of`.
/// Errors: those of making a model.
Result<std::string> write_model(const scene::PhysicsScene& scene, const robot::RobotModel& visuals,
                                const std::map<std::string, std::string>& images,
                                const scene::MujocoParts& parts, const NameOf& name_of,
                                Diagnostics& diagnostics);

}  // namespace tenon::mjcf
