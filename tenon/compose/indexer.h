// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/child_names.h"
#include "tenon/compose/node_graph.h"
#include "tenon/compose/work/task_queue.h"

/// Internal: the state of building one prim index, and the steps that act on it.
namespace tenon::compose {

class Twins;

/// What building an index asks its surroundings for.
struct IndexServices {
  MapPool* maps = nullptr;
  const ComposeOptions* options = nullptr;
  const LayerStack* root_stack = nullptr;
  /// The finished index of a prim in the root layer stack.
  std::function<const PrimIndex&(Path)> index;
  /// Opens what an asset path means for a layer.
  std::function<Result<layer::LayerPtr>(const std::string&, const layer::Layer&)> open;
  /// The stack of a referenced layer, its expression variables overridden by those of `from`.
  std::function<const LayerStack*(const layer::LayerPtr&, const LayerStack* from)> stack;
  /// Takes note of a layer that cannot be opened.
  std::function<void(MissingArc)> missing;
  std::size_t* node_count = nullptr;  ///< nodes of all indices built so far
  WorkMeter* work = nullptr;          ///< of all indices built so far
  Twins* twins = nullptr;             ///< where prims may share what they bring in
};

/// Gives the index these opinions.
void set_opinions(const IndexServices& services, std::span<const Opinion> found, PrimIndex& index);

/// Links an index that is being built to the graph that it will become a part of.
struct Frame {
  const Frame* previous = nullptr;
  Site requested;                    ///< the site that the inner index is for
  const NodeGraph* graph = nullptr;  ///< the outer graph
  NodeId parent = kNoNode;           ///< the outer node that gets the inner root as a child
  const Arc* arc = nullptr;          ///< over this arc
  bool skip_duplicates = false;
  std::size_t depth = 1;
};

struct Indexer {
  Indexer(const IndexServices& its_services, const Frame* outer, NodeGraph& its_graph,
          Diagnostics& its_errors)
      : services(its_services),
        frame(outer),
        graph(its_graph),
        errors(its_errors),
        tasks(its_graph) {}

  const IndexServices& services;
  const Frame* frame;  ///< nullptr for the index of a stage prim
  NodeGraph& graph;
  Diagnostics& errors;
  TaskQueue tasks;
  Path root_prim;  ///< the stage prim that all this is for
  bool has_payloads = false;
  bool payload_loaded = false;

  /// What the selection of a variant set at a path, seen from a node, was when it was looked for.
  struct Selection {
    std::size_t revision = 0;  ///< of the graph
    std::string variant;       ///< empty: none
  };
  std::map<std::tuple<NodeId, Path, std::string>, Selection> selections;

  /// Variants wait until the whole index is there; so do specializes below its root.
  bool is_outermost() const { return frame == nullptr; }

  void report(std::string_view error_class, const layer::Layer* layer, Path spec,
              const Message& message, std::string fix, StatementPart part = {});
};

/// A node together with the frame it is in; steps across frames.
struct FrameCursor {
  const NodeGraph* graph;
  NodeId node;
  const Frame* frame;

  bool at_end() const { return node == kNoNode; }
  /// The arc above the node, in the outer graph when the node is the root of an inner one.
  ArcKind arc() const;
  void to_parent();
  void to_outer_frame();
};

struct ArcOptions {
  bool contributes = true;          ///< the new node itself may have opinions
  bool include_ancestral = false;   ///< also what applies to the site because of its ancestors
  bool skip_duplicates = false;     ///< no second node for a site
  bool expand = true;               ///< what the new node can lead to is followed
  bool ancestry_of_origin = false;  ///< due to an ancestor or not as the arc's origin is
};

/// Builds the graph of `site`: everything but culling. Tasks run level by level from the top of the
/// path, except for a stage prim, which starts from its parent's finished index.
void build_graph(Indexer& indexer, const Site& site, bool root_contributes);

/// add_arc.cpp: adds a node and what follows from it; kNoNode when it must not be.
NodeId add_arc(Indexer& indexer, const Arc& arc, const Site& site, const ArcOptions& options);
/// The depth at which an arc at `parent` is introduced.
std::uint16_t introduction_depth(const Indexer& indexer, NodeId parent);
/// The map of an arc from `source` to the node `target`, relocates of the target's stack included.
MapFunction arc_map(const Indexer& indexer, Path source, NodeId target, layer::LayerOffset offset);
/// The same in the pool, where one of many relocates is made once.
struct ArcEnds {
  Path source;
  layer::LayerOffset offset;
  bool root_identity = false;  ///< paths outside the source map to themselves
};
const MapFunction* shared_arc_map(const Indexer& indexer, const ArcEnds& ends, NodeId target);
/// Marks everything that `node` and its subtree can lead to.
void add_tasks(Indexer& indexer, NodeId node, bool skip_expressed, bool ancestral_variants);
void add_root_tasks(Indexer& indexer);
/// What is already there below `node` stays, but without opinions.
void make_subtree_inert(NodeGraph& graph, NodeId node);
/// Marks only that classes below `node` are to be implied further up.
void add_implied_class_task(Indexer& indexer, NodeId node);
/// Contributes to a site above its own: not restricted there.
bool can_contribute_at(const Node& node, Path ancestral_path);

// One file per kind of arc.
void eval_references(Indexer& indexer, NodeId node);
void eval_payloads(Indexer& indexer, NodeId node);
/// asset_arcs.cpp: adds an arc per item, `kind` is Reference or Payload.
void add_asset_arcs(Indexer& indexer, NodeId node, ArcKind kind, const std::vector<AssetArc>& arcs);
/// Tells asset paths apart by the identifiers of the layers that they mean.
AssetIdentity asset_identity(const Indexer& indexer);
/// A reference or payload must lead to some opinion.
void eval_unresolved_prim_path(Indexer& indexer, NodeId node);
void eval_inherits(Indexer& indexer, NodeId node);
void eval_specializes(Indexer& indexer, NodeId node);
void eval_implied_specializes(Indexer& indexer, NodeId node);
/// specializes.cpp: copies a specialize node below the root.
NodeId propagate_to_root(Indexer& indexer, NodeId node);
/// A stand-in below a relocate, only there to carry implied arcs.
bool is_relocate_stand_in(const NodeGraph& graph, NodeId node);
/// class_arcs.cpp
struct ClassArcRequest {
  ArcKind kind = ArcKind::Inherit;
  NodeId parent = kNoNode;
  NodeId origin = kNoNode;
  Path class_path;  ///< in the layer stack of the parent; empty: there is no such class
  MapFunction map;
  std::uint16_t number = 0;
  Site ignored;  ///< a node at this site is added without opinions
};
void add_class_arcs(Indexer& indexer, NodeId node, ArcKind kind, Token field);
NodeId add_class_arc(Indexer& indexer, const ClassArcRequest& request);
NodeId find_matching_child(const Indexer& indexer, NodeId parent, ArcKind parent_arc,
                           const Site& site, ArcKind kind, const MapFunction& map,
                           std::uint16_t depth_below_introduction);
void eval_implied_classes(Indexer& indexer, NodeId node);
/// Where the hierarchy of classes of a class-based node starts to be implied from.
NodeId start_of_implied_classes(const NodeGraph& graph, NodeId node);
void eval_variant_sets(Indexer& indexer, NodeId node);
void eval_ancestral_variant_sets(Indexer& indexer, NodeId node);
void eval_authored_variant(Indexer& indexer, const Task& task, bool ancestral);
void eval_fallback_variant(Indexer& indexer, const Task& task, bool ancestral);
void eval_node_relocates(Indexer& indexer, NodeId node);
void eval_implied_relocates(Indexer& indexer, NodeId node);
/// The index is of a prim that was relocated away: nothing may contribute to it.
bool elide_if_prohibited(Indexer& indexer);

// Instancing and culling.
/// Instances have the node in common.
bool is_shareable(const Node& node);
bool is_instanceable(const NodeGraph& graph);
/// Below an instance only what the instance shares may contribute.
void disable_unshared_nodes(NodeGraph& graph);
std::string instance_key(const NodeGraph& graph, bool has_payloads);
void cull_without_opinions(NodeGraph& graph);

}  // namespace tenon::compose
