// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/shapes/used_shape.h"

namespace tenon::engines::jolt {

/// The shapes that runs have, read back from Jolt, without what its edges are rounded by
/// (collider_count). Disabled colliders have theirs, too.
std::vector<UsedShape> used_shapes(const scene::PhysicsScene& scene);

}  // namespace tenon::engines::jolt
