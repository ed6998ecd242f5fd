// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/shapes/used_shape.h"
#include "tenon/scene/physics_scene.h"

namespace tenon {

/// What the engine of that name collides with in the place of each collider (collider_count).
/// Errors: Missing (engine.missing); those of building MuJoCo's model.
Result<std::vector<engines::UsedShape>> used_shapes(const std::string& engine,
                                                    const scene::PhysicsScene& scene);

}  // namespace tenon
