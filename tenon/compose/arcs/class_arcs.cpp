// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Inherits and specializes: arcs to a class within the same layer stack. The map of such an arc
// says where the class is relative to what uses it, so that the same arc can be implied elsewhere.
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"
#include "tenon/compose/strength_order.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kSitesForUnit = 8;  // children compared by site

Arc arc_of(Indexer& indexer, const ClassArcRequest& request) {
  Arc arc;
  arc.kind = request.kind;
  arc.map_to_parent = indexer.services.maps->add(request.map);
  arc.parent = request.parent;
  arc.origin = request.origin;
  arc.namespace_depth = introduction_depth(indexer, request.parent);
  arc.sibling_number = request.number;
  return arc;
}

/// Where a specialize is authored or implied only a stand-in is kept; its opinions are weaker than
/// all others and come in by a copy below the root.
NodeId add_specialize_stand_in(Indexer& indexer, const ClassArcRequest& request, const Site& site) {
  ArcOptions options;
  options.contributes = false;
  options.expand = false;
  const NodeId stand_in = add_arc(indexer, arc_of(indexer, request), site, options);
  if (stand_in == kNoNode || !indexer.is_outermost() ||
      is_relocate_stand_in(indexer.graph, stand_in)) {
    return stand_in;
  }
  const NodeId copy = propagate_to_root(indexer, stand_in);
  if (copy != kNoNode && indexer.graph[copy].origin != stand_in) {
    add_implied_class_task(indexer, stand_in);
  }
  return copy;
}

/// A second specialize implied to the same site below the root replaces the first one when its
/// origin is stronger.
bool replaces(const Indexer& indexer, const ClassArcRequest& request, NodeId known) {
  const NodeGraph& graph = indexer.graph;
  return request.kind == ArcKind::Specialize && request.parent == 0 &&
         request.parent != request.origin &&
         compare_nodes(graph, request.origin, graph[known].origin) < 0;
}

}  // namespace

NodeId find_matching_child(const Indexer& indexer, NodeId parent, ArcKind parent_arc,
                           const Site& site, ArcKind kind, const MapFunction& map,
                           std::uint16_t depth_below_introduction) {
  const NodeGraph& graph = indexer.graph;
  std::size_t looked_at = 0;
  NodeId found = kNoNode;
  for (NodeId id = graph[parent].first_child; id != kNoNode && found == kNoNode;
       id = graph[id].next_sibling, ++looked_at) {
    // Below a relocate sites mean little: what is implied there keeps the source's path.
    const bool matches =
        parent_arc == ArcKind::Relocate
            ? graph[id].arc == kind && *graph[id].map_to_parent == map &&
                  graph.depth_below_introduction(graph[id].origin) == depth_below_introduction
            : graph.site(id) == site;
    found = matches ? id : kNoNode;
  }
  graph.count(looked_at / kSitesForUnit);
  return found;
}

NodeId add_class_arc(Indexer& indexer, const ClassArcRequest& request) {
  const NodeGraph& graph = indexer.graph;
  const Path parent_path = graph[request.parent].path;
  const ArcKind parent_arc = FrameCursor{&graph, request.parent, indexer.frame}.arc();
  const Site site{graph[request.parent].layer_stack, request.class_path};
  if (site.path.empty()) {
    return kNoNode;
  }
  const NodeId known =
      find_matching_child(indexer, request.parent, parent_arc, site, request.kind, request.map,
                          graph.depth_below_introduction(request.origin));
  if (known != kNoNode) {
    if (!replaces(indexer, request, known)) {
      return known;
    }
    make_subtree_inert(indexer.graph, known);
  }
  if (request.kind == ArcKind::Specialize && (request.parent != 0 || !indexer.is_outermost())) {
    return add_specialize_stand_in(indexer, request, site);
  }
  // An arc that leaves the path as it is has to be there to be implied further up, but without
  // opinions of its own: they would count twice.
  ArcOptions options;
  options.contributes = site.path != parent_path && !(site == request.ignored);
  options.skip_duplicates = options.contributes;
  options.include_ancestral = options.contributes && site.path.depth() != 1;
  return add_arc(indexer, arc_of(indexer, request), site, options);
}

void add_class_arcs(Indexer& indexer, NodeId node, ArcKind kind, Token field) {
  if (!indexer.graph[node].can_contribute()) {
    return;
  }
  const Site site = indexer.graph.site(node);
  std::uint16_t number = 0;
  for (const ClassArc& arc : composed_class_arcs(*site.layer_stack, site.path, field)) {
    if (!arc.path.is_prim() || arc.path.has_variants()) {
      indexer.report(
          error_class::kInvalidPrimPath, arc.layer, site.path,
          "the class path " + named(arc.path) + " is not an absolute prim path without variants",
          "name a prim by its absolute path", layer::item_part(field, arc.path));
    } else {
      ClassArcRequest request;
      request.kind = kind;
      request.parent = request.origin = node;
      request.class_path = arc.path;
      request.map = arc_map(indexer, arc.path, node, {}).with_root_identity();
      request.number = number;
      add_class_arc(indexer, request);
    }
    ++number;
  }
}

}  // namespace tenon::compose
