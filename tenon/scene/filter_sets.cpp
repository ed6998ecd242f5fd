// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/filter_sets.h"

#include <algorithm>

namespace tenon::scene {

const std::vector<Index>& sets_of(const CollisionFilter& filter, Index collider) {
  static const std::vector<Index> none;
  return collider < filter.sets_of_collider.size() ? filter.sets_of_collider[collider] : none;
}

bool are_apart(const std::vector<Index>& sets_a, const std::vector<Index>& sets_b,
               const SetPairs& off) {
  return std::any_of(sets_a.begin(), sets_a.end(), [&](Index a) {
    return std::any_of(sets_b.begin(), sets_b.end(), [&](Index b) {
      return std::binary_search(off.begin(), off.end(), std::pair(std::min(a, b), std::max(a, b)));
    });
  });
}

std::vector<std::vector<Index>> members_of_sets(const CollisionFilter& filter) {
  std::vector<std::vector<Index>> members;
  const auto at = [&members](Index set) -> std::vector<Index>& {
    if (set >= members.size()) {
      members.resize(set + std::size_t{1});
    }
    return members[set];
  };
  const auto make_room = [&at](const SetPairs& pairs) {
    for (const auto& [a, b] : pairs) {
      at(std::max(a, b));
    }
  };
  make_room(filter.sets_off);
  make_room(filter.permanent_sets_off);
  for (const JointPairs& of : filter.joint_pairs) {
    make_room(of.sets);
  }
  for (Index i = 0; i < filter.sets_of_collider.size(); ++i) {
    for (const Index set : filter.sets_of_collider[i]) {
      at(set).push_back(i);
    }
  }
  return members;
}

void make_each_a_set(PhysicsScene& scene) {
  scene.filter.sets_of_collider.clear();
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    scene.filter.sets_of_collider.push_back({i});
  }
}

void keep_pairs_apart(PhysicsScene& scene, SetPairs pairs) {
  make_each_a_set(scene);
  std::sort(pairs.begin(), pairs.end());
  scene.filter.sets_off = pairs;
  scene.filter.permanent_sets_off = std::move(pairs);
}

}  // namespace tenon::scene
