// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/twins/renaming.h"

#include <algorithm>
#include <tuple>

namespace tenon::compose {
namespace {

/// All of a node but its path and maps.
auto links_of(const Node& node) {
  return std::tie(node.layer_stack, node.parent, node.origin, node.first_child, node.last_child,
                  node.next_sibling, node.previous_sibling, node.namespace_depth,
                  node.sibling_number, node.restriction_depth, node.arcs_above, node.arc,
                  node.inert, node.culled, node.has_specs, node.due_to_ancestor,
                  node.due_to_direct_arc);
}

}  // namespace

Renaming::Sides Renaming::sides_to_parent(std::span<const Node> nodes, const Node& node) const {
  return {node.layer_stack == stack_,
          node.parent != kNoNode && nodes[node.parent].layer_stack == stack_};
}

Renaming::Sides Renaming::sides_to_root(std::span<const Node> nodes, const Node& node) const {
  return {node.layer_stack == stack_, nodes.front().layer_stack == stack_};
}

Path Renaming::renamed(Path path) const {
  const std::uint32_t top = from_.depth();
  if (path.depth() <= top) {
    return path == from_ ? to_ : path;
  }
  constexpr std::uint32_t kDeep = 100;  // few are, and each level is a call
  if (!path.is_prim() || path.depth() > top + kDeep) {
    return path.replace_prefix(from_, to_, false);
  }
  auto& [known, result] = recent_[path.number() % recent_.size()];
  if (known != path) {
    const Path above = path.parent();
    const Path above_renamed = renamed(above);
    result = above_renamed == above ? path : above_renamed.child(path.name());
    known = path;
  }
  return result;
}

MapFunction Renaming::renamed(const MapFunction& map, Sides sides) const {
  MapFunction::Pairs pairs = map.pairs();
  for (auto& [source, target] : pairs) {
    source = sides.source ? renamed(source) : source;
    target = sides.target ? renamed(target) : target;
  }
  if (map.has_root_identity()) {
    pairs.emplace_back(Path::absolute_root(), Path::absolute_root());
  }
  return MapFunction::make(std::move(pairs), map.offset());
}

const MapFunction* Renaming::renamed(const MapFunction* map, Sides sides, MapPool& pool) {
  if (map->pairs().empty()) {
    return map;
  }
  const auto is_it = [&](const Known& known) { return known.map == map && known.sides == sides; };
  // The nodes of one prim after another have the same maps in the same order.
  auto found = known_.begin() + static_cast<std::ptrdiff_t>(next_);
  if (found == known_.end() || !is_it(*found)) {
    found = std::find_if(known_.begin(), known_.end(), is_it);
  }
  if (found != known_.end()) {
    next_ = static_cast<std::size_t>(found - known_.begin()) + 1;
    return found->renamed;
  }
  MapFunction made = renamed(*map, sides);
  known_.push_back({map, sides, made == *map ? map : pool.add(std::move(made))});
  next_ = known_.size();
  return known_.back().renamed;
}

void Renaming::rename(std::span<Node> nodes, MapPool& pool) {
  for (Node& node : nodes) {
    node.path = renamed(node.layer_stack, node.path);
    node.map_to_parent = renamed(node.map_to_parent, sides_to_parent(nodes, node), pool);
    node.map_to_root = renamed(node.map_to_root, sides_to_root(nodes, node), pool);
  }
}

/// Pairs mostly keep their order, and no map has to be made.
bool Renaming::leads_to(const MapFunction& map, Sides sides, const MapFunction& other) const {
  const auto is_renamed = [&](const MapFunction::Pair& pair,
                              const MapFunction::Pair& renamed_pair) {
    return (sides.source ? renamed(pair.first) : pair.first) == renamed_pair.first &&
           (sides.target ? renamed(pair.second) : pair.second) == renamed_pair.second;
  };
  if (map.offset() != other.offset() || map.has_root_identity() != other.has_root_identity() ||
      map.pairs().size() != other.pairs().size()) {
    return false;
  }
  return std::equal(map.pairs().begin(), map.pairs().end(), other.pairs().begin(), is_renamed) ||
         renamed(map, sides) == other;
}

bool Renaming::leads_to(std::span<const Node> nodes, std::span<const Node> renamed_nodes) const {
  return std::equal(
      nodes.begin(), nodes.end(), renamed_nodes.begin(), renamed_nodes.end(),
      [&](const Node& node, const Node& other) {
        return links_of(node) == links_of(other) &&
               renamed(node.layer_stack, node.path) == other.path &&
               leads_to(*node.map_to_parent, sides_to_parent(nodes, node), *other.map_to_parent) &&
               leads_to(*node.map_to_root, sides_to_root(nodes, node), *other.map_to_root);
      });
}

}  // namespace tenon::compose
