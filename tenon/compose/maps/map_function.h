// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "tenon/base/path.h"
#include "tenon/compose/pair_lookup.h"
#include "tenon/layer/arcs.h"

namespace tenon::compose {

/// Maps paths (and times) across arcs: a set of prefix pairs source -> target. The longest match
/// wins, and only when it is also the longest match backwards, so that every image leads back. A
/// path outside every pair has no image. A pair with an empty target blocks its source.
/// Core Spec 1.0.1 section on namespace mapping.
class MapFunction {
 public:
  using Pair = PathPair;
  using Pairs = PathPairs;

  /// Maps nothing.
  MapFunction() = default;
  static const MapFunction& identity();
  /// Redundant pairs are dropped; the pair "/" -> "/" becomes the root identity.
  static MapFunction make(Pairs pairs, layer::LayerOffset offset = {});

  bool is_null() const { return pairs_.empty() && !root_identity_; }
  bool is_identity() const { return is_identity_of_paths() && offset_.is_identity(); }
  bool is_identity_of_paths() const { return pairs_.empty() && root_identity_; }
  /// Paths outside every pair map to themselves.
  bool has_root_identity() const { return root_identity_; }
  /// All pairs but the root identity, shallow sources first.
  const Pairs& pairs() const { return pairs_; }
  const layer::LayerOffset& offset() const { return offset_; }

  /// Image of a path, empty when it has none. Targets inside brackets are left alone.
  Path map_source_to_target(Path path) const;
  Path map_target_to_source(Path path) const;

  /// First `inner`, then this.
  MapFunction compose(const MapFunction& inner) const;
  MapFunction compose_offset(const layer::LayerOffset& offset) const;
  MapFunction inverse() const;
  /// With "/" -> "/" added, so that paths outside the arc's scope map to themselves.
  MapFunction with_root_identity() const;
  /// Without it.
  MapFunction without_root_identity() const;

  bool operator==(const MapFunction& other) const;

 private:
  MapFunction(Pairs pairs, bool root_identity, layer::LayerOffset offset);
  static MapFunction canonical(Pairs pairs, layer::LayerOffset offset);

  Pairs pairs_;                             // by depth of the source, then by source
  std::shared_ptr<const PairIndex> index_;  // of pairs_; null where they are few
  layer::LayerOffset offset_;
  bool root_identity_ = false;
};

}  // namespace tenon::compose
