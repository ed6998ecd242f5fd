// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/message.h"
#include "tenon/base/path.h"
#include "tenon/compose/arcs/arc.h"

/// Internal: composition counts what it does, so that a scene whose arcs multiply ends at a stated
/// count and says which arc multiplied. A unit is about a visit of a node (docs/limits.md).
namespace tenon::compose {

struct LayerStack;

/// Arcs of one kind authored at one site.
struct ArcPlace {
  const LayerStack* layer_stack = nullptr;
  Path path;
  ArcKind kind = ArcKind::Root;
  bool operator==(const ArcPlace&) const = default;
};

struct ArcPlaceHash {
  std::size_t operator()(const ArcPlace& place) const {
    return (std::hash<const void*>{}(place.layer_stack) * 31 + std::hash<Path>{}(place.path)) * 31 +
           static_cast<std::size_t>(place.kind);
  }
};

/// Work of following these arcs, without that of other arcs which they led to.
struct ArcCost {
  ArcPlace place;
  std::size_t units = 0;
};

/// For a finding: it is kept as long as the index.
inline constexpr std::size_t kFindingUnits = 400;

class WorkMeter {
 public:
  static constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

  void count(std::size_t units) { done_ += units; }
  std::size_t done() const { return done_; }
  /// Notes that so much of it was for objects that are made once, for their first user.
  void note_once(std::size_t units) { once_ += units; }
  std::size_t once() const { return once_; }
  bool exhausted() const { return done_ >= most_; }
  /// Whether this much more would be too much; if so, nothing more may be done.
  bool refuses(std::size_t units) {
    const bool too_much = exhausted() || units >= most_ - done_;
    done_ = too_much ? std::max(done_, most_) : done_;
    return too_much;
  }
  std::size_t most() const { return most_; }
  void set_max(std::size_t most) { most_ = most; }
  /// Goes on from another count.
  void restart(std::size_t done) { done_ = done; }

  bool has_costs() const { return !costs_.empty(); }
  /// What tasks have cost since it was taken or cleared last.
  const std::vector<ArcCost>& costs() const { return costs_; }
  void clear_costs() { costs_.clear(); }
  std::vector<ArcCost> take_costs() { return std::exchange(costs_, {}); }
  void add_cost(const ArcCost& cost) {
    costs_.push_back(cost);
    if (costs_.size() >= most_costs_) {
      fold_costs();
    }
  }

 private:
  friend class TaskTally;

  void fold_costs();

  std::size_t done_ = 0;
  std::size_t once_ = 0;
  std::size_t most_ = kUnlimited;
  std::size_t inner_ = 0;  ///< of tasks within the one that runs
  std::vector<ArcCost> costs_;
  std::size_t most_costs_ = 1u << 16;
};

/// Counts what is done during its life as the cost of a place.
class TaskTally {
 public:
  TaskTally(WorkMeter& work, const ArcPlace& place)
      : work_(work), place_(place), start_(work.done_), outer_(std::exchange(work.inner_, 0)) {}
  TaskTally(const TaskTally&) = delete;
  TaskTally& operator=(const TaskTally&) = delete;
  ~TaskTally() {
    const std::size_t all = work_.done_ - start_;
    work_.add_cost({place_, all - work_.inner_});
    work_.inner_ = outer_ + all;
  }

 private:
  WorkMeter& work_;
  ArcPlace place_;
  std::size_t start_;
  std::size_t outer_;
};

/// Costs of a whole stage.
class ArcCosts {
 public:
  void add(const std::vector<ArcCost>& costs) {
    for (const ArcCost& cost : costs) {
      units_[cost.place] += cost.units;
    }
  }
  /// "the references of @layer@</prim> took 12 of 34 units"; empty when nothing is known.
  Message most_costly(std::size_t all_units) const;

 private:
  std::unordered_map<ArcPlace, std::size_t, ArcPlaceHash> units_;
};

}  // namespace tenon::compose
