// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/containers/short_list.h"
#include "tenon/compose/maps/map_pool.h"
#include "tenon/compose/prim_index.h"
#include "tenon/compose/site.h"
#include "tenon/compose/work/work_meter.h"

/// The graph of sites that a prim index grows in: a tree of arcs whose siblings are kept in order
/// of strength, with an `origin` link from implied arcs to the arcs that imply them.
namespace tenon::compose {

using NodeId = std::uint32_t;
/// Few prims have more nodes than lie within.
using NodeIds = ShortList<NodeId, 24>;
/// Room for what a prim's own arcs bring in.
inline constexpr std::size_t kNodesToCome = 4;

/// Of work for a node of a finished index.
inline constexpr std::size_t kKeptUnits = 16;

/// An arc about to be added below `parent`.
struct Arc {
  ArcKind kind = ArcKind::Root;
  const MapFunction* map_to_parent = nullptr;
  NodeId parent = kNoNode;
  NodeId origin = kNoNode;
  std::uint16_t namespace_depth = 0;
  std::uint16_t sibling_number = 0;
};

inline bool is_class_based(ArcKind kind) {
  return kind == ArcKind::Inherit || kind == ArcKind::Specialize;
}

/// Elements of a path that are no variant selections.
std::uint16_t namespace_depth_of(Path path);

class NodeGraph {
 public:
  NodeGraph(MapPool& maps, WorkMeter& work) : maps_(&maps), work_(&work) {}

  /// Starts over with a root node.
  void reset(const Site& site);
  /// Starts over with the nodes of the parent prim's index.
  void reset(const Nodes& nodes) {
    nodes_.reserve(nodes.size() + kNodesToCome);
    nodes_.assign(nodes.begin(), nodes.end());
    copies_known_ = false;
    ++revision_;
    count(nodes_.size());
  }

  /// Takes note of work on nodes.
  void count(std::size_t units) const { work_->count(units); }

  std::size_t size() const { return nodes_.size(); }
  /// Another number after each change of the nodes, or of what they may contribute.
  std::size_t revision() const { return revision_; }
  void touch() { ++revision_; }
  Node& operator[](NodeId id) { return nodes_[id]; }
  const Node& operator[](NodeId id) const { return nodes_[id]; }
  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  Site site(NodeId id) const { return {nodes_[id].layer_stack, nodes_[id].path}; }

  NodeId insert_child(const Site& site, const Arc& arc);
  /// Moves the nodes of `other` in, its root below arc.parent; returns what its root became.
  NodeId insert_subgraph(const NodeGraph& other, const Arc& arc);

  /// Children at this moment, strongest first.
  NodeIds children(NodeId id) const;
  /// A node and everything below it, strongest first.
  NodeIds subtree(NodeId id) const;

  std::uint16_t depth_below_introduction(NodeId id) const;
  /// The node's path where its arc was introduced.
  Path path_at_introduction(NodeId id) const;
  /// The path of its parent there.
  Path introducing_path(NodeId id) const;
  /// The authored arc at the start of a chain of implied ones, and the number of steps to it.
  std::pair<NodeId, std::size_t> origin_root(NodeId id) const;
  bool is_ancestor(NodeId ancestor, NodeId id) const;
  /// A contributing node at `site`, or kNoNode.
  NodeId find_site(const Site& site) const;

  /// Appends a child name to the path of every node, whose arcs are an ancestor's from now on.
  void descend(Path child_path);
  void set_inert(NodeId id, bool inert);
  void set_culled(NodeId id);

  /// A specialize node copied below the root, where its strength belongs: its origin is the node at
  /// the same site at which the arc was authored or implied.
  bool is_propagated_specialize(NodeId id) const;
  /// The copy below the root of a specialize node; kNoNode when there is none.
  NodeId propagated_specialize(NodeId id) const;
  /// Children of a class-based node are below its copy when it has one.
  NodeId owner_of_children(NodeId id) const;
  bool has_class_based_child(NodeId id) const;
  bool has_specialize_in_subtree(NodeId id) const;
  /// {what inherits, the class it inherits directly} of the hierarchy of classes that `id` is in.
  std::pair<NodeId, NodeId> start_of_class_hierarchy(NodeId id) const;

  /// Puts nodes in order of strength and drops culled ones that nothing leads to.
  void finalize();

 private:
  void link(NodeId parent, NodeId child);
  void set_arc(NodeId id, const Arc& arc);
  void restrict(NodeId id);
  ShortList<bool, 24> erasable() const;
  void find_copies() const;
  NodeId next_in_subtree(NodeId at, NodeId root) const;

  std::vector<Node> nodes_;
  MapPool* maps_;
  WorkMeter* work_;
  std::size_t revision_ = 0;
  mutable std::unordered_map<NodeId, NodeId> copies_;  // below the root, by origin
  mutable bool copies_known_ = false;
};

}  // namespace tenon::compose
