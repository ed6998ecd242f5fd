// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_physics.h"

namespace tenon::physics {

/// What read_physics gives, for those who count objects and weigh bodies: a Mesh that collides and
/// stands still has a shape of kind Mesh without points. The arrays of such a mesh may be most of
/// the asset and are not read, so what is wrong with their contents is not found.
PhysicsScene read_outline(const stage::Stage& stage, const ReadOptions& options,
                          Diagnostics& diagnostics);

}  // namespace tenon::physics
