// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/filter_sets.h"

#include <algorithm>
#include <limits>

namespace tenon::scene {
namespace {

constexpr Index kNobody = std::numeric_limits<Index>::max();

}  // namespace

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

SetWalk::SetWalk(const CollisionFilter& filter)
    : filter_(filter),
      members_(members_of_sets(filter)),
      partners_(members_.size()),
      found_for_(filter.sets_of_collider.size(), kNobody) {
  for (const auto& [a, b] : filter.sets_off) {
    partners_[a].push_back(b);
    if (a != b) {
      partners_[b].push_back(a);
    }
  }
}

const std::vector<Index>& SetWalk::above(Index collider) {
  found_.clear();
  for (const Index set : sets_of(filter_, collider)) {
    for (const Index partner : partners_[set]) {
      const std::vector<Index>& members = members_[partner];
      auto at = std::upper_bound(members.begin(), members.end(), collider);
      work_ += 1 + static_cast<std::size_t>(members.end() - at);
      for (; at != members.end(); ++at) {
        if (found_for_[*at] != collider) {
          found_for_[*at] = collider;
          found_.push_back(*at);
        }
      }
    }
  }
  std::sort(found_.begin(), found_.end());
  return found_;
}

}  // namespace tenon::scene
