// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/result.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Whether an untrusted scene can be handed to engines: every index is valid, lists that go
/// together have equal lengths, times ascend, numbers are finite where they must be. Errors:
/// Corrupt, with the object and the field.
Result<void> check_scene(const PhysicsScene& scene);

}  // namespace tenon::scene
