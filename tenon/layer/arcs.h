// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/dictionary.h"

/// Composition arcs as authored in a layer.
namespace tenon::layer {

/// Maps a time of the target layer to the referencing one: outer = inner * scale + offset.
struct LayerOffset {
  double offset = 0;
  double scale = 1;

  bool operator==(const LayerOffset&) const = default;
  bool is_identity() const { return offset == 0 && scale == 1; }
  double apply(double inner) const { return inner * scale + offset; }
  /// This after `inner`: (this o inner)(t) = this(inner(t)).
  LayerOffset operator*(const LayerOffset& inner) const {
    return {apply(inner.offset), scale * inner.scale};
  }
  LayerOffset inverse() const { return {-offset / scale, 1 / scale}; }
  std::size_t hash() const {
    return std::hash<double>{}(offset) ^ (std::hash<double>{}(scale) << 1);
  }
};

/// `@asset@</prim> (offset; scale)`. An empty asset path refers to the same layer stack, an empty
/// prim path to the default prim.
struct Reference {
  std::string asset_path;
  Path prim_path;
  LayerOffset offset;
  Dictionary custom_data;

  bool operator==(const Reference&) const = default;
  std::size_t hash() const {
    return std::hash<std::string>{}(asset_path) ^ std::hash<Path>{}(prim_path) ^ offset.hash();
  }
};

struct Payload {
  std::string asset_path;
  Path prim_path;
  LayerOffset offset;

  bool operator==(const Payload&) const = default;
  std::size_t hash() const {
    return std::hash<std::string>{}(asset_path) ^ std::hash<Path>{}(prim_path) ^ offset.hash();
  }
};

/// Source and target path pairs in authored order. An empty target deletes the source.
struct Relocates {
  std::vector<std::pair<Path, Path>> pairs;
  bool operator==(const Relocates&) const = default;
};

}  // namespace tenon::layer
