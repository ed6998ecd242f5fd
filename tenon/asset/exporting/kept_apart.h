// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/physics/provenance.h"
#include "tenon/scene/physics_scene.h"

namespace tenon {

struct KeptApart {
  std::vector<std::pair<scene::Index, scene::Index>> pairs;  ///< ascending, the lower index first
  bool is_cut = false;  ///< there are more: limits::kDisabledPairs or kDisabledPairWork
};

/// Pairs of bodies that filtered pairs or collision groups of the asset keep apart, joints and the
/// self-collision of articulations aside. Bodies without enabled colliders are in none.
KeptApart kept_apart(const scene::PhysicsScene& scene, const physics::Provenance& provenance);

}  // namespace tenon
