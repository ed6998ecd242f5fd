// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sets of colliders that never touch: named by the filtered pairs API, joined by a joint, or links
// of an articulation without self collision (S-81, S-82, S-92, S-115). A set is read once, however
// many rules name it, and never written out as pairs of colliders.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/physics/joints/joint_frames.h"
#include "tenon/physics/read_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

using Colliders = std::vector<Index>;

/// The sets of a filter, each once.
class Sets {
 public:
  explicit Sets(PhysicsScene& scene) : scene_(scene) {}

  /// The set of these colliders; none of no colliders, and where it is one too many for one of them
  /// (kSetsOfCollider).
  std::optional<Index> of(Colliders list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    if (list.empty()) {
      return std::nullopt;
    }
    const auto known = numbers_.find(list);
    if (known != numbers_.end()) {
      return known->second;
    }
    std::vector<std::vector<Index>>& sets = scene_.filter.sets_of_collider;
    sets.resize(std::max(sets.size(), list.back() + std::size_t{1}));
    if (std::any_of(list.begin(), list.end(),
                    [&](Index i) { return sets[i].size() >= limits::kSetsOfCollider; })) {
      is_cut_ = true;
      return std::nullopt;
    }
    const auto number = static_cast<Index>(bodies_.size());
    for (const Index i : list) {
      sets[i].push_back(number);
    }
    bodies_.push_back(body_of(list));
    numbers_.emplace(std::move(list), number);
    return number;
  }

  /// Colliders of different bodies are among two sets; those of one never touch anyway, as static
  /// ones do not.
  bool can_touch(Index a, Index b) const {
    return !bodies_[a].is_one || !bodies_[b].is_one || bodies_[a].body != bodies_[b].body;
  }
  /// A set was skipped since the last call.
  bool was_cut() { return std::exchange(is_cut_, false); }

 private:
  struct Bodies {
    bool is_one = true;  // all are of it, or all are static
    std::optional<Index> body;
  };
  Bodies body_of(const Colliders& list) const {
    const std::optional<Index>& first = scene_.colliders[list.front()].body;
    return {std::all_of(list.begin(), list.end(),
                        [&](Index i) { return scene_.colliders[i].body == first; }),
            first};
  }

  PhysicsScene& scene_;
  std::map<Colliders, Index> numbers_;
  std::vector<Bodies> bodies_;
  bool is_cut_ = false;
};

class PairFilter {
 public:
  explicit PairFilter(ReadState& state)
      : state_(state), sets_(state.scene), pairs_(state.scene.filter.sets_off) {}

  void run() {
    for (std::uint32_t i = 0; i < state_.walk.prims.size(); ++i) {
      if (state_.walk.prims[i].roles.has(Api::FilteredPairs)) {
        add_filtered_pairs(i);
      }
    }
    for (Index i = 0; i < state_.scene.joints.size(); ++i) {
      const Joint& joint = state_.scene.joints[i];
      if (may_change(i)) {
        keep_apart(i);
      } else if (joint.enabled && !joint.collision_enabled) {
        add_joint(joint);
      }
    }
    for (const PhysicsPrim& found : state_.walk.prims) {
      if (found.roles.kind == PrimKind::GearJoint || found.roles.kind == PrimKind::RackJoint) {
        add_gear(found);
      }
    }
    for (const Articulation& articulation : state_.scene.articulations) {
      if (!articulation.self_collision) {
        add_links(articulation);
      }
    }
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    state_.scene.filter.permanent_sets_off = pairs_;
    state_.scene.update_joint_pairs();
  }

 private:
  /// The joint may break or be switched while the simulation runs.
  bool may_change(Index i) const {
    const Joint& joint = state_.scene.joints[i];
    const stage::Prim& prim = state_.prim_of_joint(i).prim;
    return can_break(joint) || (state_.values.stage_is_animated() &&
                                (prim.attribute(state_.tokens.joint_enabled).is_animated() ||
                                 prim.attribute(state_.tokens.collision_enabled).is_animated()));
  }

  /// Remembers the pairs of a joint apart from the others.
  void keep_apart(Index i) {
    const Joint& joint = state_.scene.joints[i];
    const std::size_t before = pairs_.size();
    const bool silent = !joint.enabled || joint.collision_enabled;
    Provenance* const provenance =
        std::exchange(state_.provenance, silent ? nullptr : state_.provenance);
    add_joint(joint);
    state_.provenance = provenance;
    JointPairs own{i, {pairs_.begin() + static_cast<std::ptrdiff_t>(before), pairs_.end()}};
    pairs_.resize(before);
    if (!own.sets.empty()) {
      state_.scene.filter.joint_pairs.push_back(std::move(own));
    }
  }

  /// Who says what is added next, for the provenance.
  void speaks(PairRule rule, Path prim, Token property = {}) {
    rule_ = rule;
    prim_ = prim;
    property_ = property;
  }

  void add(std::optional<Index> a, std::optional<Index> b) {
    if (sets_.was_cut() && std::exchange(told_cut_, prim_) != prim_) {
      state_.scene.not_read.push_back(
          {prim_, (property_.empty() ? state_.tokens.filtered_pairs : property_).str(),
           "a collider is in more than " + std::to_string(limits::kSetsOfCollider) +
               " sets that filters name (kSetsOfCollider); what is named beyond them is not kept "
               "apart"});
    }
    if (!a || !b || !sets_.can_touch(*a, *b)) {
      return;
    }
    const auto [first, second] = std::minmax(*a, *b);
    pairs_.emplace_back(first, second);
    if (state_.provenance != nullptr) {
      state_.provenance->pairs.push_back({first, second, rule_, prim_, property_});
    }
  }

  /// The set of the colliders that `find` gives for a key, which is asked once for each.
  template <class Key, class Find>
  std::optional<Index> once(std::unordered_map<Key, std::optional<Index>>& known, Key key,
                            Find find) {
    const auto [entry, is_new] = known.try_emplace(key);
    if (is_new) {
      entry->second = sets_.of(find());
    }
    return entry->second;
  }

  void append(Index body, Colliders& list) const {
    const Colliders& own = state_.colliders_of_body[body];
    list.insert(list.end(), own.begin(), own.end());
  }
  void append_links(Path root, Colliders& list) const {
    for (const Articulation& articulation : state_.scene.articulations) {
      if (articulation.path == root) {
        for (const Index link : articulation.links) {
          append(link, list);
        }
      }
    }
  }
  /// Colliders at or below a path, which lists sorted by path hold side by side.
  Colliders below(Path path) const {
    const std::vector<Collider>& colliders = state_.scene.colliders;
    auto at = std::lower_bound(colliders.begin(), colliders.end(), path,
                               [](const Collider& c, const Path& p) { return c.path < p; });
    Colliders list;
    for (; at != colliders.end() && at->path.has_prefix(path); ++at) {
      list.push_back(static_cast<Index>(at - colliders.begin()));
    }
    return list;
  }

  /// The colliders that a prim of a filtered pair means: a body's colliders, an articulation's
  /// links, one collider, or all below any other prim (S-81).
  std::optional<Index> meant_by(Path path) {
    return once(meant_, path, [&] { return colliders_meant_by(path); });
  }
  Colliders colliders_meant_by(Path path) const {
    Colliders list;
    if (const std::uint32_t found = state_.walk.index_of(path); found != kNone) {
      const PhysicsPrim& prim = state_.walk.prims[found];
      if (prim.is_body) {
        append(state_.body_of_prim[found], list);
        report_two_meanings(prim);
        return list;
      }
      if (prim.roles.has(Api::ArticulationRoot)) {
        append_links(path, list);
      }
      if (list.empty() && state_.collider_of_prim[found] != kNone) {
        list.push_back(state_.collider_of_prim[found]);
      }
    }
    return list.empty() ? below(path) : list;
  }

  void report_two_meanings(const PhysicsPrim& prim) const {
    if (prim.roles.has(Api::ArticulationRoot)) {
      state_.report(prim.prim, Severity::Info, "filter.body-or-articulation",
                    "a filtered pair names a body that is an articulation root too; the body is "
                    "meant, not all links",
                    "apply PhysicsArticulationRootAPI above the body if all links are meant",
                    api_part("PhysicsArticulationRootAPI"));
    }
  }

  void add_filtered_pairs(std::uint32_t prim_index) {
    const PhysicsPrim& found = state_.walk.prims[prim_index];
    const Token name = state_.tokens.filtered_pairs;
    const std::optional<Index> own = meant_by(found.path);
    speaks(PairRule::FilteredPair, found.path);
    for (const Path& target : state_.targets(found.prim, name)) {
      if (!state_.stage.prim(target)) {
        state_.values.report_target(
            found.prim, name, target, Severity::Warning, "filter.target-missing",
            "physics:filteredPairs names " + named(target, RelatedRole::Target) +
                ", which does not exist; it is ignored",
            "name an existing prim");
        continue;
      }
      const Path meant = state_.walk.near(found, target);
      if (meant == found.path) {
        // S-82
        state_.values.report_target(
            found.prim, name, target, Severity::Warning, "filter.self",
            "physics:filteredPairs names its own prim: contacts within it are off",
            "use the self collision switch of the articulation");
      }
      add(own, meant_by(meant));
    }
  }

  std::optional<Index> set_of_body(Index body) {
    return once(of_body_, body, [&] { return state_.colliders_of_body[body]; });
  }
  std::optional<Index> static_set(Path path) {
    return once(static_below_, path, [&] {
      Colliders list = below(path);
      std::erase_if(list, [&](Index i) { return state_.scene.colliders[i].body.has_value(); });
      return list;
    });
  }

  /// The colliders of the body that a side is attached to, or the static ones below the prim that
  /// it names; none for the world. Bodies nested below are bodies of their own.
  std::optional<Index> side(const std::optional<Index>& body, Path target, Path other) {
    if (body) {
      return set_of_body(*body);
    }
    if (target.empty() || other.has_prefix(target)) {
      return {};  // the world, or a prim above the other side that means it
    }
    return static_set(target);
  }

  // S-92
  void add_joint(const Joint& joint) {
    if (joint.target0.empty() || joint.target1.empty()) {
      return;
    }
    speaks(PairRule::Joint, joint.path);
    add(side(joint.body0, joint.target0, joint.target1),
        side(joint.body1, joint.target1, joint.target0));
  }

  /// A gear is a joint of its two bodies in this alone (gears.cpp).
  void add_gear(const PhysicsPrim& found) {
    if (!state_.values.flag(found.prim, state_.tokens.joint_enabled, true) ||
        state_.values.flag(found.prim, state_.tokens.collision_enabled, false)) {
      return;
    }
    Colliders sides[2];
    for (int side = 0; side < 2; ++side) {
      const Token name = side == 0 ? state_.tokens.body0 : state_.tokens.body1;
      for (const Path& target : state_.targets(found.prim, name)) {
        const std::uint32_t at = state_.walk.index_of(state_.walk.near(found, target));
        if (at != kNone && state_.walk.prims[at].is_body) {
          append(state_.body_of_prim[at], sides[side]);
        }
      }
    }
    speaks(PairRule::Joint, found.path);
    add(sets_.of(std::move(sides[0])), sets_.of(std::move(sides[1])));
  }

  void add_links(const Articulation& articulation) {
    Colliders all;
    for (const Index link : articulation.links) {
      append(link, all);
    }
    const PhysicsPrim& root = *state_.walk.find(articulation.path);
    speaks(PairRule::Articulation, articulation.path, self_collision_property(state_, root));
    const std::optional<Index> links = sets_.of(std::move(all));
    add(links, links);
  }

  ReadState& state_;
  Sets sets_;
  std::unordered_map<Path, std::optional<Index>> meant_;         // by a prim of a filtered pair
  std::unordered_map<Path, std::optional<Index>> static_below_;  // a prim that a joint names
  std::unordered_map<Index, std::optional<Index>> of_body_;
  SetPairs& pairs_;
  PairRule rule_ = PairRule::FilteredPair;
  Path prim_;
  Path told_cut_;  // that was last told to name too much
  Token property_;
};

}  // namespace

void read_filtered_pairs(ReadState& state) { PairFilter(state).run(); }

}  // namespace tenon::physics
