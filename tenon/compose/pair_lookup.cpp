// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/pair_lookup.h"

namespace tenon::compose {

PairIndex::PairIndex(const PathPairs& pairs) : dropped_(pairs.size()) {
  unsigned bits = 1;
  while ((std::size_t{1} << bits) < 2 * pairs.size()) {
    ++bits;
  }
  shift_ = 64 - bits;
  by_source_.resize(std::size_t{1} << bits);
  by_target_.resize(std::size_t{1} << bits);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    enter(by_source_, pairs[i].first, i);
    enter(by_target_, pairs[i].second, i);
  }
}

std::size_t PairIndex::slot_of(Path path) const {
  // Numbers of paths follow one another; a multiple of the golden ratio spreads them.
  return static_cast<std::size_t>((path.number() * std::uint64_t{0x9E3779B97F4A7C15}) >> shift_);
}

void PairIndex::enter(Slots& slots, Path path, std::size_t pair) const {
  if (path.empty()) {
    return;  // it is at the head of nothing
  }
  std::size_t slot = slot_of(path);
  while (slots[slot] != 0) {
    slot = (slot + 1) % slots.size();
  }
  slots[slot] = static_cast<std::uint32_t>(pair + 1);
}

template <Path PathPair::* End>
const PathPair* PairIndex::best(const Slots& slots, const PathPairs& pairs, Path path,
                                std::uint32_t min_depth) const {
  for (; !path.empty() && path.depth() >= min_depth; path = path.parent()) {
    const PathPair* found = nullptr;
    for (std::size_t slot = slot_of(path); slots[slot] != 0; slot = (slot + 1) % slots.size()) {
      const std::size_t at = slots[slot] - 1;
      if (pairs[at].*End == path && !dropped_[at] && (found == nullptr || found < &pairs[at])) {
        found = &pairs[at];
      }
    }
    if (found != nullptr) {
      return found;
    }
  }
  return nullptr;
}

const PathPair* PairIndex::best_source(const PathPairs& pairs, Path path,
                                       std::uint32_t min_depth) const {
  return best<&PathPair::first>(by_source_, pairs, path, min_depth);
}

const PathPair* PairIndex::best_target(const PathPairs& pairs, Path path,
                                       std::uint32_t min_depth) const {
  return best<&PathPair::second>(by_target_, pairs, path, min_depth);
}

const PathPair* PairLookup::best_source(Path path, std::uint32_t min_depth) const {
  if (index != nullptr) {
    return index->best_source(pairs, path, min_depth);
  }
  for (auto it = pairs.rbegin(); it != pairs.rend(); ++it) {
    if (it->first.depth() < min_depth) {
      return nullptr;
    }
    if (path.has_prefix(it->first)) {
      return &*it;
    }
  }
  return nullptr;
}

const PathPair* PairLookup::best_target(Path path, std::uint32_t min_depth) const {
  if (index != nullptr) {
    return index->best_target(pairs, path, min_depth);
  }
  const PathPair* best = nullptr;
  std::uint32_t best_depth = min_depth;
  for (const PathPair& pair : pairs) {
    if (pair.second.depth() >= best_depth && path.has_prefix(pair.second)) {
      best_depth = pair.second.depth();
      best = &pair;
    }
  }
  return best;
}

}  // namespace tenon::compose
