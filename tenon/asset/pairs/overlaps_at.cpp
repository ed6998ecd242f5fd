// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/overlaps_at.h"

#if TENON_WITH_MUJOCO
#include <string>

#include "tenon/asset/pairs/body_pairs.h"
#include "tenon/base/limits/pair_limits.h"
#include "tenon/engines/mujoco/overlap/penetrations.h"
#endif

namespace tenon {

#if TENON_WITH_MUJOCO

Result<std::vector<PostureOverlap>> overlaps_at(const scene::PhysicsScene& scene,
                                                const std::vector<std::vector<Pose>>& postures,
                                                Diagnostics& diagnostics) {
  using engines::mujoco::Penetration;
  using engines::mujoco::Penetrations;
  TENON_TRY(Penetrations search,
            Penetrations::make(scene, engines::mujoco::StaticColliders::Included, diagnostics));
  std::vector<PostureOverlap> overlaps;
  for (std::size_t posture = 0; posture < postures.size(); ++posture) {
    if (postures[posture].size() != scene.bodies.size()) {
      return Error(ErrorCode::Invalid, "posture " + std::to_string(posture) + " has " +
                                           std::to_string(postures[posture].size()) +
                                           " bodies, the scene " +
                                           std::to_string(scene.bodies.size()))
          .with_rule("pairs.bodies");
    }
    TENON_TRY(const std::vector<Penetration> found, search.at(postures[posture]));
    for (const Penetration& one : found) {
      if (one.depth >= kTouchingDepth && scene.may_collide(one.a, one.b)) {
        overlaps.push_back({posture, one.a, one.b, one.depth});
      }
    }
    if (overlaps.size() > limits::kListedPairs) {
      return Error(ErrorCode::Limit, "more than " + std::to_string(limits::kListedPairs) +
                                         " overlaps of colliders (kListedPairs)")
          .with_rule("pairs.too-many")
          .with_fix("ask for fewer postures");
    }
  }
  return overlaps;
}

#else

Result<std::vector<PostureOverlap>> overlaps_at(const scene::PhysicsScene& /*scene*/,
                                                const std::vector<std::vector<Pose>>& /*postures*/,
                                                Diagnostics& /*diagnostics*/) {
  return Error(ErrorCode::Missing, "this build has no MuJoCo, which looks for contacts")
      .with_rule("engine.missing")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
}

#endif

}  // namespace tenon
