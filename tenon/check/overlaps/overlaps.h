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

/// Indices of scene.colliders, the one with the lower path first.
using ColliderPair = std::pair<scene::Index, scene::Index>;

/// Pairs of convex colliders that may collide and overlap at the start by more than a tenth of the
/// smaller one; at most `most`.
std::vector<ColliderPair> overlaps_at_start(const scene::PhysicsScene& scene, std::size_t most);

/// Convex colliders of bodies that move, each with a plane that stands still, may collide with it
/// and holds more than a tenth of it at the start; at most `most`.
std::vector<ColliderPair> below_planes_at_start(const scene::PhysicsScene& scene, std::size_t most);

/// Between colliders that touch: what rounding leaves, as a part of their sizes.
inline constexpr double kRoundedGap = 0.01;

/// Pairs of convex colliders that may collide and have at most `gap` of their sizes between them at
/// the start, or overlap; at most `most`.
std::vector<ColliderPair> contacts_at_start(const scene::PhysicsScene& scene, std::size_t most,
                                            double gap = kRoundedGap);

/// Of such a pair: moved along `down` the upper one goes into the lower one, moved back it comes
/// off.
bool rests_on(const scene::PhysicsScene& scene, scene::Index upper, scene::Index lower,
              const Vec3d& down);

}  // namespace tenon::check
