// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/exporting/description_format.h"
#include "tenon/asset/exporting/joint_motors.h"
#include "tenon/base/diagnostics.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon {

struct ExportedCfg {
  std::string text;
  std::size_t joints = 0;
};

/// A Python file for Isaac Lab or mjlab (python_cfg.h). `file` is the asset or the MJCF model that
/// it opens, relative to it, `variant` that of the set "Physics", empty where the asset's own
/// selection counts. What it cannot say goes to `diagnostics` as "isaaclab.left-out" or
/// "mjlab.left-out", and is listed at the top of the file.
ExportedCfg export_cfg(const stage::Stage& stage, const scene::PhysicsScene& scene,
                       DescriptionFormat format, const std::string& file,
                       const std::string& variant, Diagnostics& diagnostics);

}  // namespace tenon
