// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colliders that no rule tells apart form a class: same scene, same groups, both moving or not. Up
// to 31 classes fit MuJoCo's contact bits. Pairs of sets become excluded body pairs where all
// colliders of two bodies are concerned. What remains (many classes, single colliders of a body,
// sets that mean very many pairs) is asked for per geom pair by the callback of contact_filter.cpp,
// which costs time in every step.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/scene/filter_sets.h"

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

ClassKey key_of(const scene::PhysicsScene& scene, std::size_t collider) {
  const scene::Collider& c = scene.colliders[collider];
  ClassKey key{scene.is_dynamic(c.body),
               c.body.has_value() ? scene.bodies[*c.body].scene : c.scene,
               {},
               true};
  if (collider < scene.filter.groups_of_collider.size()) {
    key.groups = scene.filter.groups_of_collider[collider];
  }
  key.exerts = !c.settings.trigger &&
               (!c.body.has_value() || scene.bodies[*c.body].settings.solves_contacts);
  return key;
}

bool classes_off(const scene::CollisionFilter& filter, const ClassKey& a, const ClassKey& b) {
  return (!a.moves && !b.moves) || !a.exerts || !b.exerts || a.scene != b.scene ||
         !filter.groups_allow(a.groups, b.groups);
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

std::map<BodyKey, std::size_t> active_colliders(const Build& build) {
  std::map<BodyKey, std::size_t> counts;
  for (Index i = 0; i < build.geoms.size(); ++i) {
    if (!build.geoms[i].empty()) {
      ++counts[body_key(build.scene, i)];
    }
  }
  return counts;
}

using Pairs = std::vector<std::pair<Index, Index>>;

/// Two bodies of MuJoCo, the lower one first.
using BodyPair = std::pair<BodyKey, BodyKey>;

/// So many pairs of bodies are excluded; where there are more, the callback is asked for all.
constexpr std::size_t kMostPairs = 100'000;
constexpr std::size_t kMostWork = 20 * kMostPairs;  // pairs looked at for them

struct Excludes {
  std::set<BodyPair> bodies;  // all of one are apart from all of the other
  Pairs left;                 // colliders of other bodies
};

/// Finds the bodies that pairs of sets exclude.
class ExcludePass {
 public:
  explicit ExcludePass(const Build& build) : build_(build), counts_(active_colliders(build)) {}

  /// None where there are too many.
  std::optional<Excludes> run() {
    for (const std::vector<Index>& members : scene::members_of_sets(build_.scene.filter)) {
      sets_.push_back(by_body(members));
    }
    for (const auto& [a, b] : build_.scene.filter.sets_off) {
      for (const auto& [body_a, of_a] : sets_[a]) {
        for (const auto& [body_b, of_b] : sets_[b]) {
          add(body_a, of_a, body_b, of_b);
          if (excludes_.bodies.size() > kMostPairs || ++work_ > kMostWork) {
            return std::nullopt;
          }
        }
      }
    }
    sort_the_rest();
    return std::move(excludes_);
  }

 private:
  using Set = std::map<BodyKey, std::vector<Index>>;

  Set by_body(const std::vector<Index>& members) const {
    Set set;
    for (const Index i : members) {
      if (!build_.geoms[i].empty()) {
        set[body_key(build_.scene, i)].push_back(i);
      }
    }
    return set;
  }
  void add(const BodyKey& a, const std::vector<Index>& of_a, const BodyKey& b,
           const std::vector<Index>& of_b) {
    if (a == b || (a.first && b.first)) {
      return;
    }
    const BodyPair bodies{std::min(a, b), std::max(a, b)};
    if (of_a.size() == counts_.at(a) && of_b.size() == counts_.at(b)) {
      excludes_.bodies.insert(bodies);
      return;
    }
    work_ += of_a.size() * of_b.size();
    if (work_ <= kMostWork) {
      for (const Index i : of_a) {
        for (const Index j : of_b) {
          rest_[bodies].emplace(std::min(i, j), std::max(i, j));
        }
      }
    }
  }
  /// Pairs of colliders may together be all of two bodies.
  void sort_the_rest() {
    for (const auto& [bodies, pairs] : rest_) {
      if (pairs.size() == counts_.at(bodies.first) * counts_.at(bodies.second)) {
        excludes_.bodies.insert(bodies);
      } else if (!excludes_.bodies.contains(bodies)) {
        excludes_.left.insert(excludes_.left.end(), pairs.begin(), pairs.end());
      }
    }
  }

  const Build& build_;
  std::map<BodyKey, std::size_t> counts_;
  std::vector<Set> sets_;
  std::map<BodyPair, std::set<std::pair<Index, Index>>> rest_;
  std::size_t work_ = 0;
  Excludes excludes_;
};

void add_exclude(Build& build, const BodyPair& bodies) {
  mjsExclude* exclude = mjs_addExclude(build.spec.get());
  const auto name = [&](const BodyKey& key) {
    return mjs_getString(mjs_getName(body_of(build, key)->element));
  };
  mjs_setString(exclude->bodyname1, name(bodies.first));
  mjs_setString(exclude->bodyname2, name(bodies.second));
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
std::set<BodyPair> apart_by_parent(const Build& build) {
  const std::vector<std::optional<Index>> moving = moving_bodies(build);
  std::map<Index, std::vector<BodyKey>> groups;
  for (const auto& [key, count] : active_colliders(build)) {
    if (!key.first && moving[key.second]) {
      groups[*moving[key.second]].push_back(key);
    }
  }
  std::set<BodyPair> result;
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
void leave_parents_to_mujoco(Build& build, std::set<BodyPair>& excluded) {
  const std::set<BodyPair> apart = apart_by_parent(build);
  if (std::includes(excluded.begin(), excluded.end(), apart.begin(), apart.end())) {
    build.spec->option.disableflags &= ~static_cast<int>(mjDSBL_FILTERPARENT);
    std::erase_if(excluded, [&](const BodyPair& pair) { return apart.contains(pair); });
  }
}

/// What sets keep apart: bodies are excluded, other pairs of colliders go to the callback.
void add_sets(Build& build, ContactFilter& filter) {
  std::optional<Excludes> excludes = ExcludePass(build).run();
  if (!excludes) {
    filter.needed = true;
    filter.sets_of_geom = build.scene.filter.sets_of_collider;  // until the ids are known
    filter.sets_of_geom.resize(build.scene.colliders.size());
    filter.sets_off = build.scene.filter.sets_off;
    return;
  }
  for (const auto& [a, b] : excludes->left) {
    filter.needed = true;
    filter.pairs_off.push_back((std::uint64_t{a} << 32u) | b);
  }
  if (build.purpose != Purpose::Run) {
    leave_parents_to_mujoco(build, excludes->bodies);
  }
  for (const BodyPair& bodies : excludes->bodies) {
    add_exclude(build, bodies);
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
  add_sets(build, filter);
  if (filter.needed && !is_run) {
    build.report(build.scene.scenes.front().path, "filteredPairs",
                 "some pairs of colliders are kept apart by tenon's runs alone: MuJoCo's models "
                 "have 31 classes of them and pairs of whole bodies");
  }
  return filter;
}

}  // namespace tenon::engines::mujoco
