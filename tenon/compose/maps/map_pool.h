// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <unordered_map>
#include <utility>

#include "tenon/compose/maps/map_function.h"
#include "tenon/compose/prim_index.h"
#include "tenon/compose/work/work_meter.h"

/// Internal: owns map functions of nodes, and shared nodes and opinions. Maps of many pairs, which
/// relocates make, are made once for all prims that they apply to: the first user pays for them.
namespace tenon::compose {

/// Units of work to look for a map that is there.
inline constexpr std::size_t kKnownMapUnits = 6;

/// What a map of many pairs is made of.
struct MapRecipe {
  const void* from = nullptr;  ///< a layer stack, or the outer one of two maps
  const void* with = nullptr;  ///< the inner one
  Path source;
  Path target;
  layer::LayerOffset offset;
  bool root_identity = false;
  bool operator==(const MapRecipe&) const = default;
};

struct MapRecipeHash {
  std::size_t operator()(const MapRecipe& recipe) const {
    std::size_t hash = std::hash<const void*>{}(recipe.from);
    hash = hash * 31 + std::hash<const void*>{}(recipe.with);
    hash = hash * 31 + std::hash<Path>{}(recipe.source);
    hash = hash * 31 + std::hash<Path>{}(recipe.target);
    return hash * 31 + std::hash<double>{}(recipe.offset.offset);
  }
};

class MapPool {
 public:
  const MapFunction* identity() const { return &MapFunction::identity(); }
  const MapFunction* add(MapFunction map);
  /// A node that equals this one except for its path, and lives as long as the pool.
  const Node* like(const Node& node);
  /// An opinion that equals this one except for its spec and place, and lives as long as the pool.
  const Opinion* like(const Opinion& opinion);
  /// First `inner`, then `outer`; identities cost nothing.
  const MapFunction* compose(const MapFunction* outer, const MapFunction* inner, WorkMeter& work);
  /// The map of many pairs that `make` makes, made where it is not known. `make` counts its work.
  const MapFunction* find_or_make(const MapRecipe& recipe,
                                  const std::function<MapFunction()>& make);

  /// From now on maps of many pairs are those of `known`, which may belong to another thread as
  /// long as nothing is added to it. `lacking` is called for one that is not there; what is made
  /// with the identity that comes instead must not be used.
  void take_from(const MapPool& known, std::function<void()> lacking) {
    known_ = &known;
    lacking_ = std::move(lacking);
  }

 private:
  std::deque<MapFunction> maps_;
  std::deque<Node> nodes_;        // without paths
  std::deque<Opinion> opinions_;  // without specs and places
  std::unordered_map<MapRecipe, const MapFunction*, MapRecipeHash> made_;
  const MapPool* known_ = nullptr;
  std::function<void()> lacking_;
};

/// Units of work to make a map of so many pairs: of a few, each is compared with all others.
constexpr std::size_t map_making_units(std::size_t pairs) {
  constexpr std::size_t kPairsForUnit = 32;  // compared with one another
  constexpr std::size_t kUnitsOfIndex = 96;  // for a pair that is sorted, entered and looked up
  return pairs + (pairs > kFewPairs ? kUnitsOfIndex * pairs : pairs * pairs / kPairsForUnit);
}

}  // namespace tenon::compose
