// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A map is a small sorted list of prefix pairs. Sources are unique and so are targets; the list is
// searched from its deepest source on, so the first hit is the longest match. Lists of more than a
// few pairs, which only relocates make, have an index: making a map and looking into it stays
// linear.
#include "tenon/compose/maps/map_function.h"

#include <algorithm>

namespace tenon::compose {
namespace {

using Pair = MapFunction::Pair;
using Pairs = MapFunction::Pairs;

bool pair_less(const Pair& a, const Pair& b) {
  if (a.first.depth() != b.first.depth()) {
    return a.first.depth() < b.first.depth();
  }
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// Some other pair than `used` fits the image `path` better on the way back.
bool leads_elsewhere(const PairLookup& pairs, Path path, const Pair* used, bool inverse) {
  std::uint32_t depth = 0;
  if (used != nullptr) {
    depth = inverse ? used->first.depth() : used->second.depth();
  }
  const Pair* back = inverse ? pairs.best_source(path, depth) : pairs.best_target(path, depth);
  return back != nullptr && back != used;
}

bool block_is_redundant(const PairLookup& pairs, const Pair& block) {
  const Pair* around = pairs.best_source(block.first.parent());
  if (around == nullptr || around->second.empty()) {
    return true;
  }
  const Path image = block.first.replace_prefix(around->first, around->second, false);
  return leads_elsewhere(pairs, image, around, false);
}

/// The pairs say the same without this one.
bool is_redundant(const PairLookup& pairs, const Pair& pair) {
  if (pair.second.empty()) {
    return block_is_redundant(pairs, pair);
  }
  if (pair.first.is_absolute_root() || pair.first.name() != pair.second.name()) {
    return false;
  }
  const Pair* around = pairs.best_source(pair.first.parent());
  if (around == nullptr || around->second.empty() ||
      pair.first.replace_prefix(around->first, around->second, false) != pair.second) {
    return false;
  }
  return !leads_elsewhere(pairs, pair.second.parent(), around, false);
}

void drop_redundant_of_few(Pairs& pairs) {
  for (std::size_t i = 0; i < pairs.size();) {
    const Pair pair = pairs[i];
    if (is_redundant({pairs}, pair)) {
      pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

void drop_redundant_of_many(Pairs& pairs) {
  PairIndex index(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (is_redundant({pairs, &index}, pairs[i])) {
      index.drop(i);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!index.is_dropped(i)) {
      pairs[kept++] = pairs[i];
    }
  }
  pairs.resize(kept);
}

/// Whether the first `count` pairs have a source.
class KnownSources {
 public:
  KnownSources(const Pairs& pairs, std::size_t count) : pairs_(pairs), count_(count) {
    if (count > kFewPairs) {
      for (std::size_t i = 0; i < count; ++i) {
        sources_.push_back(pairs[i].first);
      }
      std::sort(sources_.begin(), sources_.end(), made_before);
    }
  }

  bool has(Path source) const {
    if (count_ > kFewPairs) {
      return std::binary_search(sources_.begin(), sources_.end(), source, made_before);
    }
    const auto end = pairs_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::any_of(pairs_.begin(), end,
                       [&](const Pair& other) { return other.first == source; });
  }

 private:
  static bool made_before(Path a, Path b) { return a.number() < b.number(); }

  const Pairs& pairs_;
  std::size_t count_;
  std::vector<Path> sources_;  // of many
};

}  // namespace

MapFunction::MapFunction(Pairs pairs, bool root_identity, layer::LayerOffset offset)
    : pairs_(std::move(pairs)), offset_(offset), root_identity_(root_identity) {
  if (pairs_.size() > kFewPairs) {
    index_ = std::make_shared<const PairIndex>(pairs_);
  }
}

bool MapFunction::operator==(const MapFunction& other) const {
  return pairs_ == other.pairs_ && offset_ == other.offset_ &&
         root_identity_ == other.root_identity_;
}

const MapFunction& MapFunction::identity() {
  static const MapFunction map(Pairs(), true, {});
  return map;
}

MapFunction MapFunction::canonical(Pairs pairs, layer::LayerOffset offset) {
  std::sort(pairs.begin(), pairs.end(), pair_less);
  if (pairs.size() > kFewPairs) {
    drop_redundant_of_many(pairs);
  } else {
    drop_redundant_of_few(pairs);
  }
  const Path root = Path::absolute_root();
  const bool root_identity = !pairs.empty() && pairs[0].first == root && pairs[0].second == root;
  if (root_identity) {
    pairs.erase(pairs.begin());
  }
  return MapFunction(std::move(pairs), root_identity, offset);
}

MapFunction MapFunction::make(Pairs pairs, layer::LayerOffset offset) {
  return canonical(std::move(pairs), offset);
}

Path MapFunction::map_source_to_target(Path path) const {
  if (pairs_.empty()) {
    return root_identity_ ? path : Path();
  }
  const PairLookup pairs{pairs_, index_.get()};
  const Pair* best = pairs.best_source(path);
  if (best == nullptr && !root_identity_) {
    return {};
  }
  Path image = path;
  if (best != nullptr) {
    if (best->second.empty()) {
      return {};
    }
    image = path.replace_prefix(best->first, best->second, false);
  }
  return leads_elsewhere(pairs, image, best, false) ? Path() : image;
}

Path MapFunction::map_target_to_source(Path path) const {
  if (pairs_.empty()) {
    return root_identity_ ? path : Path();
  }
  const PairLookup pairs{pairs_, index_.get()};
  const Pair* best = pairs.best_target(path);
  if (best == nullptr && !root_identity_) {
    return {};
  }
  const Path image = best == nullptr ? path : path.replace_prefix(best->second, best->first, false);
  return leads_elsewhere(pairs, image, best, true) ? Path() : image;
}

MapFunction MapFunction::compose(const MapFunction& inner) const {
  if (is_identity()) {
    return inner;
  }
  if (inner.is_identity()) {
    return *this;
  }
  Pairs pairs;
  pairs.reserve(inner.pairs_.size() + pairs_.size() + 1);
  const Path root = Path::absolute_root();
  if (root_identity_ && inner.root_identity_) {
    pairs.emplace_back(root, root);
  }
  for (const Pair& pair : inner.pairs_) {
    pairs.emplace_back(pair.first,
                       pair.second.empty() ? Path() : map_source_to_target(pair.second));
  }
  const KnownSources known(pairs, pairs.size());
  for (const Pair& pair : pairs_) {
    const Path source = inner.map_target_to_source(pair.first);
    if (!source.empty() && !known.has(source)) {
      pairs.emplace_back(source, pair.second);
    }
  }
  return canonical(std::move(pairs), offset_ * inner.offset_);
}

MapFunction MapFunction::compose_offset(const layer::LayerOffset& offset) const {
  MapFunction result = *this;
  result.offset_ = result.offset_ * offset;
  return result;
}

MapFunction MapFunction::inverse() const {
  Pairs pairs;
  pairs.reserve(pairs_.size());
  for (const Pair& pair : pairs_) {
    if (!pair.second.empty()) {
      pairs.emplace_back(pair.second, pair.first);
    }
  }
  std::sort(pairs.begin(), pairs.end(), pair_less);
  return MapFunction(std::move(pairs), root_identity_, offset_.inverse());
}

MapFunction MapFunction::with_root_identity() const {
  if (root_identity_) {
    return *this;
  }
  Pairs pairs;
  pairs.reserve(pairs_.size() + 1);
  pairs.emplace_back(Path::absolute_root(), Path::absolute_root());
  pairs.insert(pairs.end(), pairs_.begin(), pairs_.end());  // sorted: the root is above all
  return canonical(std::move(pairs), offset_);
}

MapFunction MapFunction::without_root_identity() const { return canonical(pairs_, offset_); }

}  // namespace tenon::compose
