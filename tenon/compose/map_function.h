// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/arcs.h"

namespace tenon::compose {

/// Maps paths (and times) across arcs: a set of prefix pairs source -> target, longest match wins;
/// a path outside every pair has no image. Core Spec 1.0.1 section on namespace mapping.
class MapFunction {
 public:
  using Pairs = std::vector<std::pair<Path, Path>>;

  /// Maps nothing.
  MapFunction() = default;
  static MapFunction identity();
  static MapFunction make(Pairs pairs, layer::LayerOffset offset = {});

  bool is_null() const { return pairs_.empty(); }
  bool is_identity() const;
  const Pairs& pairs() const { return pairs_; }
  const layer::LayerOffset& offset() const { return offset_; }

  /// Image of a path, empty when it has none. Target paths inside brackets are mapped too.
  Path map_source_to_target(Path path) const;
  Path map_target_to_source(Path path) const;

  /// First `inner`, then this.
  MapFunction compose(const MapFunction& inner) const;
  MapFunction compose_offset(const layer::LayerOffset& offset) const;
  MapFunction inverse() const;
  /// With "/" -> "/" added, so that paths outside the arc's scope map to themselves.
  MapFunction with_root_identity() const;

  bool operator==(const MapFunction&) const = default;

 private:
  Pairs pairs_;  // sorted by source, no redundant pairs
  layer::LayerOffset offset_;
};

}  // namespace tenon::compose
