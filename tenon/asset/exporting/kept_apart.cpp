// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/kept_apart.h"

#include <algorithm>

namespace tenon {

KeptApart kept_apart(const scene::PhysicsScene& scene, const physics::Provenance& provenance) {
  scene::SetPairs filtered;
  for (const physics::PairProvenance& pair : provenance.pairs) {
    if (pair.rule == physics::PairRule::FilteredPair) {
      filtered.emplace_back(pair.a, pair.b);
    }
  }
  const scene::ColliderPairs found = scene.pairs_apart(filtered);
  KeptApart result;
  result.is_cut = found.is_cut;
  for (const auto& [a, b] : found.pairs) {
    const auto body_a = scene.colliders[a].body;
    const auto body_b = scene.colliders[b].body;
    if (body_a && body_b && *body_a != *body_b) {
      result.pairs.emplace_back(std::minmax(*body_a, *body_b));
    }
  }
  std::sort(result.pairs.begin(), result.pairs.end());
  result.pairs.erase(std::unique(result.pairs.begin(), result.pairs.end()), result.pairs.end());
  return result;
}

}  // namespace tenon
