// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines {

/// Engines keep room and time for each pair of colliders whose boxes along the axes overlap, and a
/// thousand bodies in one place are half a million. Error: Limit (engine.start-pairs) where more
/// pairs that may meet overlap at the start than limits::kStartPairs and kStartPairsPerCollider
/// allow.
Result<void> check_start_pairs(const scene::PhysicsScene& scene);

}  // namespace tenon::engines
