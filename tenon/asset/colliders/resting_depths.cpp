// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/colliders/resting_depths.h"

#if TENON_WITH_MUJOCO
#include <utility>

#include "tenon/asset/pairs/body_pairs.h"
#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/overlap/penetrations.h"
#endif

namespace tenon {

#if TENON_WITH_MUJOCO
std::vector<RestingDepth> resting_depths(const scene::PhysicsScene& scene) {
  Diagnostics findings;
  auto search = engines::mujoco::Penetrations::make(
      scene, engines::mujoco::StaticColliders::Included, findings);
  if (!search) {
    return {};
  }
  std::vector<Pose> start;
  for (const scene::Body& body : scene.bodies) {
    start.push_back(body.pose);
  }
  const auto found = search->at(start);
  if (!found) {
    return {};
  }
  std::vector<RestingDepth> depths(scene.colliders.size());
  for (const engines::mujoco::Penetration& one : *found) {
    if (one.depth < kTouchingDepth || !scene.may_collide(one.a, one.b)) {
      continue;
    }
    for (const auto& [own, other] : {std::pair(one.a, one.b), std::pair(one.b, one.a)}) {
      if (one.depth > depths[own].depth) {
        depths[own] = {one.depth, other};
      }
    }
  }
  return depths;
}
#else
std::vector<RestingDepth> resting_depths(const scene::PhysicsScene& /*scene*/) { return {}; }
#endif

}  // namespace tenon
