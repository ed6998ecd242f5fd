// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::check {

/// As many pairs as are told apart shape by shape; a heap of bodies in one place has millions.
inline constexpr std::size_t kAllOverlaps = 200000;

/// Pairs of convex colliders that may collide and overlap at the start by more than a tenth of the
/// smaller one, as indices of scene.colliders, the one with the lower path first; at most `most`.
std::vector<std::pair<scene::Index, scene::Index>> overlaps_at_start(
    const scene::PhysicsScene& scene, std::size_t most);

}  // namespace tenon::check
