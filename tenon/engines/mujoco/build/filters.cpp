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

/// `statics_apart`: what stands still is of other classes than what moves.
Classes classify(const scene::PhysicsScene& scene, bool statics_apart) {
  Classes classes;
  std::map<ClassKey, int> numbers;
  for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
    ClassKey key = key_of(scene, i);
    key.moves = key.moves || !statics_apart;
    const auto [entry, is_new] =
        numbers.try_emplace(std::move(key), static_cast<int>(classes.keys.size()));
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

/// MuJoCo itself excludes pairs of static geoms. To MuJoCo only a kinematic body, or one that
/// follows a track, moves.
bool all_but_statics_move(const scene::PhysicsScene& scene) {
  return std::none_of(scene.bodies.begin(), scene.bodies.end(),
                      [](const scene::Body& body) { return body.kinematic; }) &&
         std::none_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                      [](const scene::PoseTrack& track) { return track.collider.has_value(); });
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

using Excludes = std::map<std::pair<BodyKey, BodyKey>, mjsExclude*>;

// Excludes whole body pairs, into `excludes`; returns the collider pairs that are left.
std::vector<std::pair<Index, Index>> exclude_bodies(Build& build, Excludes& excludes) {
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
    excludes.emplace(bodies, exclude);
  }
  return left;
}

/// What a body moves with: itself where it has freedom, else what holds it; none for the world.
std::vector<std::optional<Index>> moving_bodies(const Build& build) {
  std::vector<std::optional<Index>> result(build.scene.bodies.size());
  for (const Index body : build.plan.forest.order) {  // parents first
    const scene::ForestBody& link = build.plan.forest.bodies[body];
    const BodyBase base = build.plan.bases[body];
    const bool is_free = base == BodyBase::Free || base == BodyBase::Driven ||
                         (base == BodyBase::Jointed && build.dofs[*link.joint].count() > 0);
    if (is_free) {
      result[body] = body;
    } else if (base == BodyBase::Jointed && link.parent) {
      result[body] = result[*link.parent];
    }
  }
  return result;
}

/// Pairs of bodies with shapes that MuJoCo keeps apart by itself, as one hangs on the other.
std::set<std::pair<BodyKey, BodyKey>> apart_by_parent(const Build& build) {
  const std::vector<std::optional<Index>> moving = moving_bodies(build);
  std::map<Index, std::vector<BodyKey>> groups;
  for (const auto& [key, count] : active_colliders(build)) {
    if (!key.first && moving[key.second]) {
      groups[*moving[key.second]].push_back(key);
    }
  }
  std::set<std::pair<BodyKey, BodyKey>> result;
  for (const auto& [body, keys] : groups) {
    const std::optional<Index>& parent = build.plan.forest.bodies[body].parent;
    const auto above = parent && moving[*parent] ? groups.find(*moving[*parent]) : groups.end();
    for (std::size_t i = 0; above != groups.end() && i < keys.size(); ++i) {
      for (const BodyKey& other : above->second) {
        result.insert(std::minmax(keys[i], other));
      }
    }
  }
  return result;
}

/// In text: where all pairs that MuJoCo would keep apart by itself are apart, it does.
void leave_parents_to_mujoco(Build& build, const Excludes& excludes) {
  const auto apart = apart_by_parent(build);
  const auto is_excluded = [&](const auto& pair) { return excludes.contains(pair); };
  if (!std::all_of(apart.begin(), apart.end(), is_excluded)) {
    return;
  }
  build.spec->option.disableflags &= ~static_cast<int>(mjDSBL_FILTERPARENT);
  for (const auto& pair : apart) {
    mjs_delete(build.spec.get(), excludes.at(pair)->element);
  }
}

}  // namespace

ContactFilter add_filters(Build& build) {
  // Which joints are near is said by the scene's pairs (S-92), not by MuJoCo's tree.
  build.spec->option.disableflags |= mjDSBL_FILTERPARENT;
  const bool is_run = build.purpose == Purpose::Run;
  const Classes classes = classify(build.scene, is_run || !all_but_statics_move(build.scene));
  ContactFilter filter;
  filter.class_off = classes.off;
  filter.class_count = classes.keys.size();
  filter.geom_class = classes.of_collider;  // per collider until the ids are known
  if (classes.keys.size() <= kBits) {
    set_bits(build, classes);
  } else {
    filter.needed = true;
  }
  Excludes excludes;
  for (const auto& [a, b] : exclude_bodies(build, excludes)) {
    filter.needed = true;
    filter.pairs_off.push_back((std::uint64_t{a} << 32u) | b);
  }
  if (!is_run) {
    leave_parents_to_mujoco(build, excludes);
  }
  if (filter.needed && !is_run) {
    build.report(build.scene.scenes.front().path, "filteredPairs",
                 "some pairs of colliders are kept apart by tenon's runs alone: MuJoCo's models "
                 "have 31 classes of them and pairs of whole bodies");
  }
  return filter;
}

}  // namespace tenon::engines::mujoco
