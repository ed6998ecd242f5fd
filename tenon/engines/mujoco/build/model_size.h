// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines::mujoco {

/// What a model has been given so far. MuJoCo counts in 32 bits and stops at no size, so that it is
/// stopped here.
struct ModelSize {
  std::size_t geoms = 0;
  std::size_t mesh_points = 0;
};

/// Whether bodies and joints are not too many. Errors: Limit.
Result<void> check_scene_size(const scene::PhysicsScene& scene);
/// Whether a model may have this; `last` is what was added last. Errors: Limit with that prim.
Result<void> check_model_size(const ModelSize& size, const Path& last);

}  // namespace tenon::engines::mujoco
