// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "tenon/scene/physics_scene.h"

/// Sets of colliders that never touch: `sets_of_collider` and `sets_off` of a CollisionFilter. A
/// thousand bodies that each name one prim above them are a thousand pairs of sets, and a million
/// pairs of colliders.
namespace tenon::scene {

/// The sets that a collider is in.
const std::vector<Index>& sets_of(const CollisionFilter& filter, Index collider);

/// A set of one list and a set of the other are apart.
bool are_apart(const std::vector<Index>& sets_a, const std::vector<Index>& sets_b,
               const SetPairs& off);

/// For each set that the filter names the colliders in it, ascending.
std::vector<std::vector<Index>> members_of_sets(const CollisionFilter& filter);

/// Makes every collider a set of its own, so that a pair of sets is a pair of colliders.
void make_each_a_set(PhysicsScene& scene);
/// The same, and `pairs`, first < second, are apart for good.
void keep_pairs_apart(PhysicsScene& scene, SetPairs pairs);

}  // namespace tenon::scene
