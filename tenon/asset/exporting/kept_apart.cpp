// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/kept_apart.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "tenon/base/limits/pair_limits.h"

namespace tenon {
namespace {

bool is_of_filter(const physics::PairReason& reason) {
  const std::string_view rule = reason.rule;
  return rule == "S-81" || rule == "S-77" || rule == "S-78";
}

}  // namespace

std::vector<std::pair<scene::Index, scene::Index>> kept_apart(
    const scene::PhysicsScene& scene, const physics::Provenance& provenance) {
  std::set<std::pair<scene::Index, scene::Index>> pairs;
  std::size_t looked_at = 0;
  for (scene::Index a = 0; a < scene.colliders.size(); ++a) {
    for (scene::Index b = a + 1; b < scene.colliders.size(); ++b) {
      const auto body_a = scene.colliders[a].body;
      const auto body_b = scene.colliders[b].body;
      if (!body_a || !body_b || *body_a == *body_b || scene.may_meet(a, b)) {
        continue;
      }
      if (++looked_at > limits::kListedPairs) {
        return {pairs.begin(), pairs.end()};
      }
      const std::pair<scene::Index, scene::Index> ends = std::minmax(*body_a, *body_b);
      if (pairs.contains(ends)) {
        continue;
      }
      const auto reasons = physics::why_apart(scene, provenance, a, b);
      if (std::any_of(reasons.begin(), reasons.end(), is_of_filter)) {
        pairs.insert(ends);
      }
    }
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace tenon
