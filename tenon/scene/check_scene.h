// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Whether a scene that a stranger made can be handed to engines: every index leads somewhere,
/// lists that go together have one length, times ascend, numbers that may not be infinite or no
/// number are neither. Errors: Corrupt, with the object and the field.
Result<void> check_scene(const PhysicsScene& scene);

}  // namespace tenon::scene
