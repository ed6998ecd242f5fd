// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/physics/provenance.h"
#include "tenon/scene/physics_scene.h"

namespace tenon {

/// Pairs of bodies that filtered pairs or collision groups of the asset keep apart, joints and the
/// self-collision of articulations aside: ascending, the lower index first. Bodies without
/// colliders are in none. It looks at limits::kListedPairs pairs of colliders at most.
std::vector<std::pair<scene::Index, scene::Index>> kept_apart(
    const scene::PhysicsScene& scene, const physics::Provenance& provenance);

}  // namespace tenon
