// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A map is a small sorted list of prefix pairs. Sources are unique and so are targets; the list is
// searched from its deepest source on, so the first hit is the longest match.
#include "tenon/compose/map_function.h"

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

/// The pair with the longest source at the head of `path`, sources at least `min_depth` deep.
const Pair* best_source(const Pairs& pairs, Path path, std::uint32_t min_depth = 0) {
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

const Pair* best_target(const Pairs& pairs, Path path, std::uint32_t min_depth = 0) {
  const Pair* best = nullptr;
  std::uint32_t best_depth = min_depth;
  for (const Pair& pair : pairs) {
    if (pair.second.depth() >= best_depth && path.has_prefix(pair.second)) {
      best_depth = pair.second.depth();
      best = &pair;
    }
  }
  return best;
}

/// Some other pair than `used` fits the image `path` better on the way back.
bool leads_elsewhere(const Pairs& pairs, Path path, const Pair* used, bool inverse) {
  std::uint32_t depth = 0;
  if (used != nullptr) {
    depth = inverse ? used->first.depth() : used->second.depth();
  }
  const Pair* back = inverse ? best_source(pairs, path, depth) : best_target(pairs, path, depth);
  return back != nullptr && back != used;
}

bool block_is_redundant(const Pairs& pairs, const Pair& block) {
  const Pair* around = best_source(pairs, block.first.parent());
  if (around == nullptr || around->second.empty()) {
    return true;
  }
  const Path image = block.first.replace_prefix(around->first, around->second, false);
  return leads_elsewhere(pairs, image, around, false);
}

/// The pairs say the same without this one.
bool is_redundant(const Pairs& pairs, const Pair& pair) {
  if (pair.second.empty()) {
    return block_is_redundant(pairs, pair);
  }
  if (pair.first.is_absolute_root() || pair.first.name() != pair.second.name()) {
    return false;
  }
  const Pair* around = best_source(pairs, pair.first.parent());
  if (around == nullptr || around->second.empty() ||
      pair.first.replace_prefix(around->first, around->second, false) != pair.second) {
    return false;
  }
  return !leads_elsewhere(pairs, pair.second.parent(), around, false);
}

}  // namespace

const MapFunction& MapFunction::identity() {
  static const MapFunction map(Pairs(), true, {});
  return map;
}

MapFunction MapFunction::canonical(Pairs pairs, layer::LayerOffset offset) {
  std::sort(pairs.begin(), pairs.end(), pair_less);
  for (std::size_t i = 0; i < pairs.size();) {
    const Pair pair = pairs[i];
    if (is_redundant(pairs, pair)) {
      pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
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
  const Pair* best = best_source(pairs_, path);
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
  return leads_elsewhere(pairs_, image, best, false) ? Path() : image;
}

Path MapFunction::map_target_to_source(Path path) const {
  const Pair* best = best_target(pairs_, path);
  if (best == nullptr && !root_identity_) {
    return {};
  }
  const Path image = best == nullptr ? path : path.replace_prefix(best->second, best->first, false);
  return leads_elsewhere(pairs_, image, best, true) ? Path() : image;
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
  const std::size_t inner_count = pairs.size();
  for (const Pair& pair : pairs_) {
    const Path source = inner.map_target_to_source(pair.first);
    const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(inner_count);
    const bool known =
        std::any_of(pairs.begin(), end, [&](const Pair& other) { return other.first == source; });
    if (!source.empty() && !known) {
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
  Pairs pairs = pairs_;
  pairs.emplace_back(Path::absolute_root(), Path::absolute_root());
  return canonical(std::move(pairs), offset_);
}

MapFunction MapFunction::without_root_identity() const { return canonical(pairs_, offset_); }

}  // namespace tenon::compose
