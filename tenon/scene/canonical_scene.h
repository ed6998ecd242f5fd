// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// One scene, one description: zeros lose their sign, and of q and -q, which are one rotation, the
/// one whose real part is not negative stays.
void make_canonical(PhysicsScene& scene);

}  // namespace tenon::scene
