// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/path.h"

/// Internal: the pair of a map with the longest source or target at the head of a path. A few pairs
/// are looked through; many are found by a table, a step for each element of the path.
namespace tenon::compose {

using PathPair = std::pair<Path, Path>;
using PathPairs = std::vector<PathPair>;

/// Up to here, looking through all pairs is faster than a table.
inline constexpr std::size_t kFewPairs = 32;

/// Where the pairs of one list are, by source and by target; it belongs to the list as it was.
class PairIndex {
 public:
  explicit PairIndex(const PathPairs& pairs);

  const PathPair* best_source(const PathPairs& pairs, Path path, std::uint32_t min_depth) const;
  const PathPair* best_target(const PathPairs& pairs, Path path, std::uint32_t min_depth) const;
  /// The pair is not found any more.
  void drop(std::size_t pair) { dropped_[pair] = true; }
  bool is_dropped(std::size_t pair) const { return dropped_[pair]; }

 private:
  using Slots = std::vector<std::uint32_t>;  // number of a pair, from 1 on; 0: free

  std::size_t slot_of(Path path) const;
  void enter(Slots& slots, Path path, std::size_t pair) const;
  template <Path PathPair::* End>
  const PathPair* best(const Slots& slots, const PathPairs& pairs, Path path,
                       std::uint32_t min_depth) const;

  unsigned shift_ = 0;
  Slots by_source_;
  Slots by_target_;
  std::vector<bool> dropped_;
};

/// A list of pairs, and its index where it has one.
struct PairLookup {
  const PathPairs& pairs;
  const PairIndex* index = nullptr;

  /// The pair with the longest source at the head of `path`, sources at least `min_depth` deep; of
  /// equal ones the last. The pairs are in order of the depth of their sources.
  const PathPair* best_source(Path path, std::uint32_t min_depth = 0) const;
  const PathPair* best_target(Path path, std::uint32_t min_depth = 0) const;
};

}  // namespace tenon::compose
