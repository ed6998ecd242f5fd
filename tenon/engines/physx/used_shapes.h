// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/shapes/used_shape.h"

namespace tenon::engines::physx {

/// The shapes that runs have, read back from PhysX after it cooked them (collider_count). Disabled
/// colliders have theirs, too. Errors: Missing without the library.
Result<std::vector<UsedShape>> used_shapes(const scene::PhysicsScene& scene);

}  // namespace tenon::engines::physx
