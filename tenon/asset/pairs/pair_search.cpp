// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each thread takes a stretch of the postures, with a search of its own over one model. Each
// posture is drawn by its number alone, and what the threads saw is put together in the order of
// the stretches, so that it does not depend on how many there are: of equal depths the first
// posture counts. Colliders become sides, bodies or static colliders, posture by posture.
#include "tenon/asset/pairs/pair_search.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>

#include "tenon/base/limits/pair_limits.h"

#if TENON_WITH_MUJOCO
#include "tenon/base/parallel.h"
#include "tenon/dynamics/drawn_postures.h"
#include "tenon/engines/mujoco/overlap/penetrations.h"
#endif

namespace tenon {

#if TENON_WITH_MUJOCO
namespace {

using engines::mujoco::Penetration;
using engines::mujoco::Penetrations;
using engines::mujoco::StaticColliders;
using Tallies = std::map<SidePair, PairTally>;

constexpr std::size_t kPosturesPerThread = 32;  // fewer are not worth one

Error too_many_pairs() {
  return Error(ErrorCode::Limit, "more than " + std::to_string(limits::kListedPairs) +
                                     " pairs of bodies touch (kListedPairs)")
      .with_rule("pairs.too-many")
      .with_fix("look at a part of the asset");
}

/// One contact of two sides.
struct Contact {
  SidePair sides;
  scene::Index collider_a = 0;
  scene::Index collider_b = 0;
  double depth = 0;
};

/// The deepest contact of each two sides, in their order.
std::vector<Contact> by_side(const scene::PhysicsScene& scene,
                             const std::vector<Penetration>& found) {
  std::vector<Contact> contacts;
  for (const Penetration& one : found) {
    if (one.depth < kTouchingDepth) {
      continue;
    }
    Contact contact{{side_of(scene, one.a), side_of(scene, one.b)}, one.a, one.b, one.depth};
    if (contact.sides.second < contact.sides.first) {
      std::swap(contact.sides.first, contact.sides.second);
      std::swap(contact.collider_a, contact.collider_b);
    }
    contacts.push_back(contact);
  }
  std::stable_sort(contacts.begin(), contacts.end(), [](const Contact& x, const Contact& y) {
    return x.sides != y.sides ? x.sides < y.sides : x.depth > y.depth;
  });
  const auto end =
      std::unique(contacts.begin(), contacts.end(),
                  [](const Contact& x, const Contact& y) { return x.sides == y.sides; });
  contacts.erase(end, contacts.end());
  return contacts;
}

void deepen(const PairTally& by, PairTally& tally) {
  if (by.depth > tally.depth) {
    tally.depth = by.depth;
    tally.collider_a = by.collider_a;
    tally.collider_b = by.collider_b;
    tally.posture = by.posture;
  }
}

PairTally tally_of(const Contact& contact, const std::optional<std::uint64_t>& posture) {
  PairTally tally;
  tally.collider_a = contact.collider_a;
  tally.collider_b = contact.collider_b;
  tally.depth = contact.depth;
  tally.posture = posture;
  return tally;
}

/// The postures from `begin` up to `end`, on one thread.
struct Stretch {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::optional<Penetrations> search;
  Tallies tallies;
  std::size_t skipped = 0;
  std::optional<Error> failure;
};

Result<void> look_at(const scene::PhysicsScene& scene, const dynamics::Posture& posture,
                     std::uint64_t number, Stretch& stretch) {
  TENON_TRY(const std::vector<Penetration> found, stretch.search->at(posture.bodies));
  for (const Contact& contact : by_side(scene, found)) {
    PairTally& tally = stretch.tallies[contact.sides];
    ++tally.touching;
    deepen(tally_of(contact, number), tally);
  }
  if (stretch.tallies.size() > limits::kListedPairs) {
    return too_many_pairs();
  }
  return {};
}

/// The drawn postures of a scene.
class Draw {
 public:
  Draw(const dynamics::Multibody& multibody, const BodyPairsOptions& options)
      : multibody_(multibody), options_(options), drawn_(multibody) {}

  const dynamics::DrawnPostures& postures() const { return drawn_; }

  /// `is_own`: on the thread that waits for the others, and may report.
  void run(bool is_own, Stretch& stretch) {
    for (std::uint64_t i = stretch.begin; i < stretch.end && !failed_; ++i) {
      if (options_.is_over && options_.is_over()) {
        stretch.failure = Error(ErrorCode::Invalid, "the search for pairs was ended before its end")
                              .with_rule("pairs.ended");
        failed_ = true;
        return;
      }
      const dynamics::Posture posture = drawn_.draw(options_.seed, i);
      if (!drawn_.is_possible(posture)) {
        ++stretch.skipped;
      } else if (auto looked = look_at(multibody_.scene(), posture, i, stretch); !looked) {
        stretch.failure = looked.error();
        failed_ = true;
      }
      const std::size_t done = ++done_;
      if (is_own && options_.progress) {
        options_.progress(done, options_.samples);
      }
    }
  }

 private:
  const dynamics::Multibody& multibody_;
  const BodyPairsOptions& options_;
  dynamics::DrawnPostures drawn_;
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> failed_{false};
};

Result<std::vector<Stretch>> stretches_of(const BodyPairsOptions& options, Penetrations search) {
  const std::size_t most = options.threads == 0 ? usable_processors() : options.threads;
  const std::size_t count = std::clamp<std::size_t>(
      options.threads == 0 ? options.samples / kPosturesPerThread : options.samples, 1, most);
  std::vector<Stretch> stretches(count);
  for (std::size_t t = 0; t < count; ++t) {
    stretches[t].begin = options.samples * t / count;
    stretches[t].end = options.samples * (t + 1) / count;
    if (t > 0) {
      TENON_TRY(stretches[t].search, search.another());
    }
  }
  stretches[0].search = std::move(search);
  return stretches;
}

Result<void> add_drawn(Draw& draw, const BodyPairsOptions& options, Penetrations search,
                       PairSearch& result) {
  TENON_TRY(std::vector<Stretch> stretches, stretches_of(options, std::move(search)));
  run_each(stretches.size(),
           [&](std::size_t t) { draw.run(t + 1 == stretches.size(), stretches[t]); });
  for (const Stretch& stretch : stretches) {
    if (stretch.failure) {
      return *stretch.failure;
    }
    result.skipped += stretch.skipped;
    for (const auto& [sides, tally] : stretch.tallies) {
      PairTally& whole = result.tallies[sides];
      whole.touching += tally.touching;
      deepen(tally, whole);
    }
  }
  return result.tallies.size() > limits::kListedPairs ? Result<void>(too_many_pairs())
                                                      : Result<void>();
}

}  // namespace

Result<PairSearch> search_pairs(const scene::PhysicsScene& scene, const BodyPairsOptions& options,
                                Diagnostics& diagnostics) {
  TENON_TRY(Penetrations search,
            Penetrations::make(
                scene, options.environment ? StaticColliders::Included : StaticColliders::Left,
                diagnostics));
  const dynamics::Multibody multibody(scene);
  Draw draw(multibody, options);
  PairSearch result;
  result.shapes = search.not_mapped();
  result.coordinates = draw.postures().coordinate_count();
  TENON_TRY(const std::vector<Penetration> at_start, search.at(draw.postures().start().bodies));
  const bool is_rigid = result.coordinates == 0;
  result.postures = is_rigid ? std::min<std::size_t>(options.samples, 1) : options.samples;
  for (const Contact& contact : by_side(scene, at_start)) {
    PairTally tally = tally_of(contact, std::nullopt);
    tally.start_depth = contact.depth;
    tally.touching = is_rigid ? result.postures : 0;
    result.tallies.emplace(contact.sides, tally);
  }
  if (!is_rigid && options.samples > 0) {
    TENON_CHECK(add_drawn(draw, options, std::move(search), result));
  }
  return result;
}

#else

Result<PairSearch> search_pairs(const scene::PhysicsScene& /*scene*/,
                                const BodyPairsOptions& /*options*/, Diagnostics& /*diagnostics*/) {
  return Error(ErrorCode::Missing, "this build has no MuJoCo, which looks for contacts")
      .with_rule("engine.missing")
      .with_fix("build with -DTENON_WITH_MUJOCO=ON");
}

#endif

}  // namespace tenon
