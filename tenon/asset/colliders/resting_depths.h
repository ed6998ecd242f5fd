// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"

/// Internal to tenon/asset/colliders.
namespace tenon {

/// The deepest overlap of a collider.
struct RestingDepth {
  double depth = 0;  ///< [m], at least kTouchingDepth (body_pairs.h); 0: it overlaps nothing
  scene::Index with = 0;
};
/// Overlaps with colliders of other bodies, static ones among them, at the start, of pairs that may
/// collide (collider_count); on MuJoCo's shapes. Empty: MuJoCo is not there, or refuses the shapes.
std::vector<RestingDepth> resting_depths(const scene::PhysicsScene& scene);

}  // namespace tenon
