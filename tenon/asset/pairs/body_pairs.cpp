// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The search finds the pairs that touch. To these come pairs that joints connect and those that
// filtered pairs of the asset name, or all, so that what never touches can be told of them, too.
// Whether filters keep a pair apart is asked of its colliders one by one, and why of those of the
// deepest contact. Both have a bound on their work, beyond which the deepest contact speaks for the
// pair and no reasons are given.
#include "tenon/asset/pairs/body_pairs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tenon/asset/pairs/pair_search.h"
#include "tenon/base/limits/pair_limits.h"
#include "tenon/base/limits/physics_limits.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/scene/filter_sets.h"

namespace tenon {
namespace {

using scene::Collider;
using scene::Index;
using scene::PhysicsScene;

constexpr std::array<std::string_view, 4> kClassNames{"always", "often", "sometimes", "never"};
constexpr std::array<std::string_view, 3> kFilteredNames{"no", "partly", "yes"};
constexpr std::string_view kFilteredPairRule = "S-81";

PairClass class_of(std::size_t touching, std::size_t of) {
  if (touching == 0) {
    return PairClass::Never;
  }
  return touching == of       ? PairClass::Always
         : 2 * touching >= of ? PairClass::Often
                              : PairClass::Sometimes;
}

/// Puts the pairs of a scene together.
class PairList {
 public:
  PairList(const PhysicsScene& scene, const physics::Provenance& provenance,
           const BodyPairsOptions& options)
      : scene_(scene), provenance_(provenance), options_(options) {
    for (Index i = 0; i < scene.colliders.size(); ++i) {
      const Collider& collider = scene.colliders[i];
      if (collider.enabled && !collider.settings.trigger &&
          (collider.body || options.environment)) {
        colliders_of_[side_of(scene, i)].push_back(i);
      }
    }
  }

  Result<BodyPairs> run(PairSearch search, Diagnostics& diagnostics) {
    tallies_ = std::move(search.tallies);
    result_.postures = search.postures;
    result_.skipped = search.skipped;
    result_.coordinates = search.coordinates;
    result_.shapes = std::move(search.shapes);
    result_.bodies = colliders_of_.size();
    count_pairs();
    result_.never = result_.pair_count - std::min(result_.pair_count, tallies_.size());
    add_joined();
    add_filtered(diagnostics);
    if (options_.all) {
      TENON_CHECK(add_all());
    }
    for (const auto& [sides, tally] : tallies_) {
      result_.pairs.push_back(pair_of(sides, tally));
    }
    std::sort(result_.pairs.begin(), result_.pairs.end(), [](const BodyPair& x, const BodyPair& y) {
      return x.a != y.a ? x.a < y.a : x.b < y.b;
    });
    return std::move(result_);
  }

 private:
  bool is_body(Side side) const { return side < scene_.bodies.size(); }
  Index scene_of(Side side) const {
    return is_body(side) ? scene_.bodies[side].scene
                         : scene_.colliders[side - scene_.bodies.size()].scene;
  }
  Path path_of(Side side) const {
    return is_body(side) ? scene_.bodies[side].path
                         : scene_.colliders[side - scene_.bodies.size()].path;
  }
  bool can_move(Side side) const { return is_body(side) && !scene_.bodies[side].kinematic; }

  bool can_be_pair(Side a, Side b) const {
    return a != b && (is_body(a) || is_body(b)) && scene_of(a) == scene_of(b) &&
           colliders_of_.contains(a) && colliders_of_.contains(b);
  }
  void add(Side a, Side b) {
    if (can_be_pair(a, b)) {
      const SidePair sides = std::minmax(a, b);
      PairTally tally;
      tally.collider_a = colliders_of_.at(sides.first).front();
      tally.collider_b = colliders_of_.at(sides.second).front();
      tallies_.try_emplace(sides, tally);
    }
  }

  void count_pairs() {
    std::map<Index, std::pair<std::size_t, std::size_t>> counts;  // bodies and statics of a scene
    for (const auto& [side, colliders] : colliders_of_) {
      auto& [bodies, statics] = counts[scene_of(side)];
      ++(is_body(side) ? bodies : statics);
    }
    for (const auto& [scene, count] : counts) {
      const auto [bodies, statics] = count;
      result_.pair_count += bodies * (bodies - 1) / 2 * (bodies > 0 ? 1 : 0) + bodies * statics;
    }
  }

  /// Pairs that a joint connects; of a joint to the world what is static below the prim it names.
  void add_joined() {
    for (const scene::Joint& joint : scene_.joints) {
      if (!joint.enabled || (!joint.body0 && !joint.body1)) {
        continue;
      }
      if (joint.body0 && joint.body1) {
        join(*joint.body0, *joint.body1);
      } else if (options_.environment) {
        const Path target = joint.body0 ? joint.target1 : joint.target0;
        join_statics(joint.body0 ? *joint.body0 : *joint.body1, target);
      }
    }
  }
  void join(Side a, Side b) {
    add(a, b);
    adjacent_.insert(std::minmax(a, b));
  }
  void join_statics(Side body, Path target) {
    if (target.empty()) {
      return;
    }
    auto at = std::lower_bound(scene_.colliders.begin(), scene_.colliders.end(), target,
                               [](const Collider& c, const Path& p) { return c.path < p; });
    for (; at != scene_.colliders.end() && at->path.has_prefix(target); ++at) {
      if (!at->body) {
        join(body, side_of(scene_, static_cast<Index>(at - scene_.colliders.begin())));
      }
    }
  }

  /// Pairs that the asset's filtered pairs mean.
  void add_filtered(Diagnostics& diagnostics) {
    std::size_t work = 0;
    const std::vector<std::vector<Index>> members = scene::members_of_sets(scene_.filter);
    for (const physics::PairProvenance& one : provenance_.pairs) {
      if (one.rule != physics::PairRule::FilteredPair) {
        continue;
      }
      work += members[one.a].size() * members[one.b].size();
      if (work > limits::kListedPairs) {
        diagnostics.add({Severity::Warning, "pairs.too-many",
                         "filtered pairs mean more than " + std::to_string(limits::kListedPairs) +
                             " pairs of colliders (kListedPairs); of those that never touch the "
                             "rest is not listed",
                         one.prim.str(), "", "filter bodies instead of what is above them"});
        return;
      }
      for (const Index i : members[one.a]) {
        for (const Index j : members[one.b]) {
          add(side_of(scene_, i), side_of(scene_, j));
        }
      }
    }
  }

  Result<void> add_all() {
    if (result_.pair_count > limits::kListedPairs) {
      return Error(ErrorCode::Limit, "there are " + std::to_string(result_.pair_count) +
                                         " pairs of bodies, and at most " +
                                         std::to_string(limits::kListedPairs) +
                                         " can be listed (kListedPairs)")
          .with_rule("pairs.too-many")
          .with_fix("list those that touch alone");
    }
    for (auto a = colliders_of_.begin(); a != colliders_of_.end(); ++a) {
      for (auto b = std::next(a); b != colliders_of_.end(); ++b) {
        add(a->first, b->first);
      }
    }
    return {};
  }

  PairFiltered filtered_of(const SidePair& sides, const PairTally& tally) {
    if (!can_move(sides.first) && !can_move(sides.second)) {
      return PairFiltered::Yes;
    }
    const std::vector<Index>& own = colliders_of_.at(sides.first);
    const std::vector<Index>& other = colliders_of_.at(sides.second);
    work_ += own.size() * other.size();
    if (work_ > limits::kDisabledPairWork) {
      return scene_.may_meet(tally.collider_a, tally.collider_b) ? PairFiltered::No
                                                                 : PairFiltered::Yes;
    }
    std::size_t apart = 0;
    for (const Index i : own) {
      for (const Index j : other) {
        apart += scene_.may_meet(i, j) ? 0 : 1;
      }
    }
    return apart == 0                           ? PairFiltered::No
           : apart == own.size() * other.size() ? PairFiltered::Yes
                                                : PairFiltered::Partly;
  }

  void explain(BodyPair& pair) {
    work_ += provenance_.pairs.size();
    if (pair.filtered == PairFiltered::No || work_ > limits::kDisabledPairWork) {
      return;
    }
    pair.filters = physics::why_apart(scene_, provenance_, pair.collider_a, pair.collider_b);
    for (const physics::PairReason& reason : pair.filters) {
      work_ += reason.why.size();
    }
    const bool by_pairs_alone =
        !pair.filters.empty() &&
        std::all_of(pair.filters.begin(), pair.filters.end(),
                    [](const physics::PairReason& why) { return why.rule == kFilteredPairRule; });
    const bool rarely = pair.often == PairClass::Sometimes || pair.often == PairClass::Never;
    pair.over_filtered = pair.filtered == PairFiltered::Yes && by_pairs_alone && rarely &&
                         !pair.start_depth.has_value();
  }

  BodyPair pair_of(const SidePair& sides, const PairTally& tally) {
    BodyPair pair;
    pair.a = path_of(sides.first);
    pair.b = path_of(sides.second);
    pair.collider_a = tally.collider_a;
    pair.collider_b = tally.collider_b;
    if (pair.b < pair.a) {
      std::swap(pair.a, pair.b);
      std::swap(pair.collider_a, pair.collider_b);
    }
    pair.adjacent = adjacent_.contains(sides);
    pair.start_depth = tally.start_depth;
    pair.touching = tally.touching;
    pair.depth = tally.depth;
    pair.posture = tally.posture;
    if (result_.counted() > 0) {
      pair.often = class_of(tally.touching, result_.counted());
    }
    pair.filtered = filtered_of(sides, tally);
    explain(pair);
    return pair;
  }

  const PhysicsScene& scene_;
  const physics::Provenance& provenance_;
  const BodyPairsOptions& options_;
  std::map<Side, std::vector<Index>> colliders_of_;
  std::map<SidePair, PairTally> tallies_;
  std::set<SidePair> adjacent_;
  std::size_t work_ = 0;
  BodyPairs result_;
};

}  // namespace

std::string_view pair_class_name(PairClass which) {
  return kClassNames[static_cast<std::size_t>(which)];
}

std::string_view pair_filtered_name(PairFiltered which) {
  return kFilteredNames[static_cast<std::size_t>(which)];
}

Result<BodyPairs> body_pairs(const PhysicsScene& scene, const physics::Provenance& provenance,
                             const BodyPairsOptions& options, Diagnostics& diagnostics) {
  if (options.samples > limits::kPairPostures) {
    return Error(ErrorCode::Limit,
                 std::to_string(options.samples) + " postures are more than the " +
                     std::to_string(limits::kPairPostures) + " that can be drawn (kPairPostures)")
        .with_rule("pairs.too-many")
        .with_fix("draw fewer");
  }
  TENON_TRY(PairSearch search, search_pairs(scene, options, diagnostics));
  return PairList(scene, provenance, options).run(std::move(search), diagnostics);
}

std::vector<JointCoordinates> posture_joints(
    const PhysicsScene& scene, std::uint64_t seed,
    const std::vector<std::optional<std::uint64_t>>& postures) {
  const dynamics::Multibody multibody(scene);
  const dynamics::DrawnPostures drawn(multibody);
  std::vector<JointCoordinates> result;
  for (const std::optional<std::uint64_t>& posture : postures) {
    result.push_back(posture ? drawn.draw(seed, *posture).joints : drawn.start().joints);
  }
  return result;
}

}  // namespace tenon
