// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

namespace tenon {

/// Two colliders that may touch and overlap in one of several postures.
struct PostureOverlap {
  std::size_t posture = 0;  ///< which of the postures
  scene::Index a = 0;       ///< into PhysicsScene::colliders, a < b
  scene::Index b = 0;
  double depth = 0;  ///< [m], at least kTouchingDepth (body_pairs.h)
};

/// Where colliders overlap that no filter, joint or articulation keeps apart
/// (PhysicsScene::may_collide), static ones too: what a run would push apart. On MuJoCo's shapes
/// (engines/mujoco/overlap/penetrations.h). Each posture is X_WB of all bodies, in their order.
/// Sorted by posture, then by colliders. Errors: Missing (engine.missing) without MuJoCo, Invalid
/// for a posture of another number of bodies, Limit (pairs.too-many) for more than kListedPairs
/// overlaps, and those of Penetrations.
Result<std::vector<PostureOverlap>> overlaps_at(const scene::PhysicsScene& scene,
                                                const std::vector<std::vector<Pose>>& postures,
                                                Diagnostics& diagnostics);

}  // namespace tenon
