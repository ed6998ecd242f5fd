// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "tenon/compose/maps/map_pool.h"
#include "tenon/compose/prim_index.h"

/// Internal: one prim of the stage in place of another.
namespace tenon::compose {

/// Replaces a prim path at the head of paths of one layer stack, in nodes with their maps.
class Renaming {
 public:
  Renaming() = default;
  Renaming(const LayerStack& stack, Path from, Path to) : stack_(&stack), from_(from), to_(to) {}

  Path from() const { return from_; }
  Path to() const { return to_; }

  Path renamed(Path path) const;
  /// A path in the namespace of a stack.
  Path renamed(const LayerStack* stack, Path path) const {
    return stack == stack_ ? renamed(path) : path;
  }
  /// Renames these nodes of an index. New maps go into the pool, each once.
  void rename(std::span<Node> nodes, MapPool& pool);
  /// Whether the second nodes are the first ones renamed.
  bool leads_to(std::span<const Node> nodes, std::span<const Node> renamed_nodes) const;

 private:
  /// Which sides of a map are in the namespace of the stack.
  struct Sides {
    bool source = false;
    bool target = false;
    bool operator==(const Sides&) const = default;
  };
  struct Known {
    const MapFunction* map;
    Sides sides;
    const MapFunction* renamed;
  };

  Sides sides_to_parent(std::span<const Node> nodes, const Node& node) const;
  Sides sides_to_root(std::span<const Node> nodes, const Node& node) const;
  MapFunction renamed(const MapFunction& map, Sides sides) const;
  bool leads_to(const MapFunction& map, Sides sides, const MapFunction& other) const;
  const MapFunction* renamed(const MapFunction* map, Sides sides, MapPool& pool);

  const LayerStack* stack_ = nullptr;
  Path from_;
  Path to_;
  std::vector<Known> known_;
  std::size_t next_ = 0;  // into known_: the map that is likely to be asked for next
  /// Of paths that were renamed lately: prims come after the ones that they are below.
  mutable std::array<std::pair<Path, Path>, 32> recent_{};
};

}  // namespace tenon::compose
