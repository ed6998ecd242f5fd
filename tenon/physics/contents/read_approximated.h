// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/base/function.h"
#include "tenon/physics/read_physics.h"

namespace tenon::physics {

/// How a Mesh that collides is to do so; nullopt: as the asset says.
using AskedApproximation = Function<std::optional<Approximation>(const stage::Prim& mesh)>;

/// What read_physics gives where meshes that collide had this physics:approximation, with
/// PhysicsMeshCollisionAPI applied. No file and no layer is changed.
PhysicsScene read_approximated(const stage::Stage& stage, const ReadOptions& options,
                               const AskedApproximation& asked, Diagnostics& diagnostics);

}  // namespace tenon::physics
