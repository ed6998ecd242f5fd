// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/asset/pairs/body_pairs.h"

/// Internal to tenon/asset/pairs.
namespace tenon {

/// What can touch: a body by its number, or a static collider by its own and the count of bodies.
using Side = scene::Index;
using SidePair = std::pair<Side, Side>;  // first < second

inline Side side_of(const scene::PhysicsScene& scene, scene::Index collider) {
  const std::optional<scene::Index>& body = scene.colliders[collider].body;
  return body ? *body : static_cast<Side>(scene.bodies.size()) + collider;
}

/// What was seen of one pair.
struct PairTally {
  scene::Index collider_a = 0;  ///< of the deepest contact, of the first side
  scene::Index collider_b = 0;
  std::optional<double> start_depth;  ///< [m]
  std::size_t touching = 0;           ///< drawn postures
  double depth = 0;                   ///< the greatest [m]
  std::optional<std::uint64_t> posture;
};

struct PairSearch {
  std::map<SidePair, PairTally> tallies;  ///< of pairs that touch
  std::size_t postures = 0;
  std::size_t skipped = 0;
  std::size_t coordinates = 0;
  std::vector<engines::NotMapped> shapes;
};

/// Errors: those of body_pairs.
Result<PairSearch> search_pairs(const scene::PhysicsScene& scene, const BodyPairsOptions& options,
                                Diagnostics& diagnostics);

}  // namespace tenon
