// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colliders that no rule tells apart form a class: same scene, same groups, both moving or not. Up
// to 31 classes fit MuJoCo's contact bits. Explicit pairs become excluded body pairs where all
// colliders of two bodies are concerned. What remains (many classes, single colliders of a body) is
// asked for per geom pair by the callback of contact_filter.cpp, which costs time in every step.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "tenon/engines/mujoco/build/build.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

constexpr std::size_t kBits = 31;

struct ClassKey {
  bool moves = false;
  Index scene = 0;
  std::vector<Index> groups;
  bool exerts = true;  // no trigger, and its body solves contacts
  auto operator<=>(const ClassKey&) const = default;
};

bool moves(const scene::PhysicsScene& scene, const scene::Collider& collider) {
  return collider.body.has_value() && !scene.bodies[*collider.body].kinematic;
}

ClassKey key_of(const scene::PhysicsScene& scene, std::size_t collider) {
  const scene::Collider& c = scene.colliders[collider];
  ClassKey key{
      moves(scene, c), c.body.has_value() ? scene.bodies[*c.body].scene : c.scene, {}, true};
  if (collider < scene.filter.groups_of_collider.size()) {
    key.groups = scene.filter.groups_of_collider[collider];
  }
  key.exerts = !c.settings.trigger &&
               (!c.body.has_value() || scene.bodies[*c.body].settings.solves_contacts);
  return key;
}

bool groups_off(const scene::CollisionFilter& filter, const std::vector<Index>& a,
                const std::vector<Index>& b) {
  const std::size_t count = filter.group_paths.size();
  if (a.empty() != b.empty()) {
    const std::vector<Index>& grouped = a.empty() ? b : a;
    return std::any_of(grouped.begin(), grouped.end(),
                       [&](Index group) { return filter.ungrouped_off[group] != 0; });
  }
  for (const Index g : a) {
    for (const Index h : b) {
      if (filter.group_pair_off[g * count + h] != 0) {
        return true;
      }
    }
  }
  return false;
}

bool classes_off(const scene::CollisionFilter& filter, const ClassKey& a, const ClassKey& b) {
  return (!a.moves && !b.moves) || !a.exerts || !b.exerts || a.scene != b.scene ||
         groups_off(filter, a.groups, b.groups);
}

struct Classes {
  std::vector<ClassKey> keys;
  std::vector<int> of_collider;
  std::vector<char> off;
};

Classes classify(const scene::PhysicsScene& scene) {
  Classes classes;
  std::map<ClassKey, int> numbers;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    const auto [entry, is_new] =
        numbers.try_emplace(key_of(scene, i), static_cast<int>(classes.keys.size()));
    if (is_new) {
      classes.keys.push_back(entry->first);
    }
    classes.of_collider.push_back(entry->second);
  }
  for (const ClassKey& a : classes.keys) {
    for (const ClassKey& b : classes.keys) {
      classes.off.push_back(classes_off(scene.filter, a, b) ? 1 : 0);
    }
  }
  return classes;
}

void set_bits(Build& build, const Classes& classes) {
  const std::size_t count = classes.keys.size();
  for (std::size_t i = 0; i < build.geoms.size(); ++i) {
    const auto own = static_cast<std::size_t>(classes.of_collider[i]);
    int affinity = 0;
    for (std::size_t other = 0; other < count; ++other) {
      if (classes.off[own * count + other] == 0) {
        affinity |= 1 << other;
      }
    }
    for (mjsGeom* geom : build.geoms[i]) {
      geom->contype = 1 << own;
      geom->conaffinity = affinity;
    }
  }
}

// Colliders of one MuJoCo body: those of a body, or one static collider.
using BodyKey = std::pair<bool, Index>;  // {is static, body or collider}

BodyKey body_key(const scene::PhysicsScene& scene, Index collider) {
  const std::optional<Index>& body = scene.colliders[collider].body;
  return body.has_value() ? BodyKey{false, *body} : BodyKey{true, collider};
}

mjsBody* body_of(Build& build, const BodyKey& key) {
  return key.first ? build.static_bodies[key.second] : build.bodies[key.second];
}

using ColliderPairs = std::set<std::pair<Index, Index>>;

// Pairs of all rules that name bodies or colliders one by one.
ColliderPairs explicit_pairs(const scene::PhysicsScene& scene) {
  ColliderPairs pairs(scene.filter.pairs_off.begin(), scene.filter.pairs_off.end());
  std::vector<std::vector<Index>> colliders(scene.bodies.size());
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    if (scene.colliders[i].body.has_value()) {
      colliders[*scene.colliders[i].body].push_back(i);
    }
  }
  for (const scene::Articulation& articulation : scene.articulations) {
    if (articulation.self_collision) {
      continue;
    }
    std::vector<Index> all;
    for (const Index link : articulation.links) {
      all.insert(all.end(), colliders[link].begin(), colliders[link].end());
    }
    for (const Index a : all) {
      for (const Index b : all) {
        if (a < b && scene.colliders[a].body != scene.colliders[b].body) {
          pairs.emplace(a, b);
        }
      }
    }
  }
  return pairs;
}

std::map<BodyKey, std::size_t> active_colliders(const Build& build) {
  std::map<BodyKey, std::size_t> counts;
  for (Index i = 0; i < build.geoms.size(); ++i) {
    if (!build.geoms[i].empty()) {
      ++counts[body_key(build.scene, i)];
    }
  }
  return counts;
}

// Excludes whole body pairs; returns the collider pairs that are left.
std::vector<std::pair<Index, Index>> exclude_bodies(Build& build) {
  std::map<std::pair<BodyKey, BodyKey>, std::vector<std::pair<Index, Index>>> by_bodies;
  for (const auto& [a, b] : explicit_pairs(build.scene)) {
    if (build.geoms[a].empty() || build.geoms[b].empty()) {
      continue;
    }
    const BodyKey first = body_key(build.scene, a);
    const BodyKey second = body_key(build.scene, b);
    if (first != second && !(first.first && second.first)) {
      by_bodies[std::minmax(first, second)].emplace_back(a, b);
    }
  }
  const std::map<BodyKey, std::size_t> counts = active_colliders(build);
  std::vector<std::pair<Index, Index>> left;
  for (const auto& [bodies, pairs] : by_bodies) {
    if (pairs.size() < counts.at(bodies.first) * counts.at(bodies.second)) {
      left.insert(left.end(), pairs.begin(), pairs.end());
      continue;
    }
    mjsExclude* exclude = mjs_addExclude(build.spec.get());
    mjs_setString(exclude->bodyname1,
                  mjs_getString(mjs_getName(body_of(build, bodies.first)->element)));
    mjs_setString(exclude->bodyname2,
                  mjs_getString(mjs_getName(body_of(build, bodies.second)->element)));
  }
  return left;
}

}  // namespace

ContactFilter add_filters(Build& build) {
  // Which joints are near is said by the scene's pairs (S-92), not by MuJoCo's tree.
  build.spec->option.disableflags |= mjDSBL_FILTERPARENT;
  const Classes classes = classify(build.scene);
  ContactFilter filter;
  filter.class_off = classes.off;
  filter.class_count = classes.keys.size();
  filter.geom_class = classes.of_collider;  // per collider until the ids are known
  if (classes.keys.size() <= kBits) {
    set_bits(build, classes);
  } else {
    filter.needed = true;
  }
  for (const auto& [a, b] : exclude_bodies(build)) {
    filter.needed = true;
    filter.pairs_off.push_back((std::uint64_t{a} << 32u) | b);
  }
  return filter;
}

}  // namespace tenon::engines::mujoco
