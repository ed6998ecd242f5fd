// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All reasons are looked for, not the first one alone: two colliders touch only when each
// is removed. Pairs of sets say by themselves which prim keeps them apart (Provenance).
#include <algorithm>

#include "tenon/physics/physics_tokens.h"
#include "tenon/physics/provenance.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::physics {
namespace {

Index scene_of(const PhysicsScene& scene, const Collider& collider) {
  return collider.body ? scene.bodies[*collider.body].scene : collider.scene;
}

class Reasons {
 public:
  Reasons(const PhysicsScene& scene, Index a, Index b)
      : scene_(scene), a_(a), b_(b), first_(scene.colliders[a]), second_(scene.colliders[b]) {}

  std::vector<PairReason> run(const Provenance& provenance) {
    same_body();
    disabled(first_);
    disabled(second_);
    nothing_moves();
    other_scene();
    groups();
    pairs(provenance);
    return std::move(found_);
  }

 private:
  void add(const char* rule, std::string why, Path prim = {}, Token property = {}) {
    found_.push_back({rule, std::move(why), prim, property});
  }

  void same_body() {
    if (a_ == b_) {
      add("S-82", "a collider does not touch itself");
    } else if (first_.body && first_.body == second_.body) {
      add("S-23", "both belong to the body <" + scene_.bodies[*first_.body].path.str() + ">",
          scene_.bodies[*first_.body].path);
    }
  }

  void disabled(const Collider& collider) {
    if (!collider.enabled) {
      add("S-50", "the collider <" + collider.path.str() + "> is disabled", collider.path,
          physics_tokens().collision_enabled);
    }
  }

  void nothing_moves() {
    if (!scene_.is_dynamic(first_.body) && !scene_.is_dynamic(second_.body)) {
      add(first_.body || second_.body ? "S-27" : "S-49",
          "neither side can be moved: static and kinematic ones do not respond to each other");
    }
  }

  void other_scene() {
    const Index one = scene_of(scene_, first_);
    const Index other = scene_of(scene_, second_);
    if (one != other) {
      add("S-21",
          "they are simulated in different scenes, <" + scene_.scenes[one].path.str() + "> and <" +
              scene_.scenes[other].path.str() + ">",
          scene_.scenes[other].path);
    }
  }

  void groups() {
    const CollisionFilter& filter = scene_.filter;
    if (std::max(a_, b_) >= filter.groups_of_collider.size()) {
      return;
    }
    const std::vector<Index>& own = filter.groups_of_collider[a_];
    const std::vector<Index>& other = filter.groups_of_collider[b_];
    if (own.empty() != other.empty()) {
      for (const Index group : own.empty() ? other : own) {
        if (filter.ungrouped_off[group] != 0) {
          add("S-78",
              "the inverted group <" + filter.group_paths[group].str() +
                  "> touches only groups that it lists, and one side is in no group",
              filter.group_paths[group], physics_tokens().invert_groups);
        }
      }
    }
    for (const Index g : own) {
      for (const Index h : other) {
        if (filter.group_pair_off[g * filter.group_paths.size() + h] != 0) {
          group_pair(g, h);
        }
      }
    }
  }

  void group_pair(Index g, Index h) {
    const std::vector<Path>& paths = scene_.filter.group_paths;
    add("S-77",
        g == h
            ? "the group <" + paths[g].str() + "> filters itself"
            : "the groups <" + paths[g].str() + "> and <" + paths[h].str() + "> filter each other",
        paths[g], physics_tokens().filtered_groups);
  }

  void pairs(const Provenance& provenance) {
    if (first_.body == second_.body) {
      return;
    }
    const std::vector<Index>& own = scene::sets_of(scene_.filter, a_);
    const std::vector<Index>& other = scene::sets_of(scene_.filter, b_);
    const auto has = [](const std::vector<Index>& sets, Index set) {
      return std::binary_search(sets.begin(), sets.end(), set);
    };
    for (const PairProvenance& one : provenance.pairs) {
      if (!(has(own, one.a) && has(other, one.b)) && !(has(own, one.b) && has(other, one.a))) {
        continue;
      }
      const std::string name = "<" + one.prim.str() + ">";
      switch (one.rule) {
        case PairRule::FilteredPair:
          add("S-81", name + " names the other side in its filtered pairs", one.prim,
              physics_tokens().filtered_pairs);
          break;
        case PairRule::Joint:
          add("S-92", "the joint " + name + " connects them and keeps them from touching", one.prim,
              physics_tokens().collision_enabled);
          break;
        case PairRule::Articulation:
          add("S-115", "links of the articulation " + name + ", whose self collision is off",
              one.prim, one.property);
          break;
      }
    }
  }

  const PhysicsScene& scene_;
  Index a_;
  Index b_;
  const Collider& first_;
  const Collider& second_;
  std::vector<PairReason> found_;
};

}  // namespace

std::vector<PairReason> why_apart(const PhysicsScene& scene, const Provenance& provenance,
                                  Index collider_a, Index collider_b) {
  return Reasons(scene, collider_a, collider_b).run(provenance);
}

}  // namespace tenon::physics
