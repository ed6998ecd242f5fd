// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/physx/build/build.h"

namespace tenon::engines::physx {

struct Geometry {
  px::PxGeometryHolder shape;
  Pose pose;  ///< in the collider
};

/// What a collider is made of in PhysX; nothing, and said, where PhysX refuses the shape.
/// `moves`: the actor is a body that forces move, of which PhysX takes no triangles.
std::vector<Geometry> geometry_of(Build& build, const scene::Collider& collider, bool moves);

}  // namespace tenon::engines::physx
