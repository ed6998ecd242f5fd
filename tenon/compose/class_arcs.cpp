// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Inherits and specializes: arcs to a class within the same layer stack. The map of such an arc
// says where the class is relative to what uses it, so that the same arc can be implied elsewhere.
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

Path containing_variant(Path path) {
  while (!path.empty() && !path.is_variant_selection()) {
    path = path.parent();
  }
  return path;
}

/// The path that `path` of a node stands for in the map of a class arc: below a relocate that map
/// speaks of the prim at its target.
Path class_of(const Node& parent, ArcKind parent_arc, Path path, const MapFunction& map) {
  if (parent_arc == ArcKind::Relocate) {
    const Path target =
        relocates_map(*parent.layer_stack, Path::absolute_root()).map_source_to_target(path);
    const Path found = target.empty() ? target : map.map_target_to_source(target);
    if (!found.empty() && found != target) {
      return found;
    }
  }
  return map.map_target_to_source(path);
}

/// The class that a node uses under `map`; empty: there is none from here. Maps know nothing of
/// variants. What is authored in a variant uses the class as a whole, and its variants with it; an
/// arc implied into a variant stays within.
Path class_path(const Node& parent, ArcKind parent_arc, const ClassArcRequest& request) {
  const Path path = class_of(parent, parent_arc, parent.path.strip_variants(), request.map);
  if (path.empty() || !request.implied || !parent.path.has_variants()) {
    return path;
  }
  const Path variant = containing_variant(parent.path);
  return path.replace_prefix(variant.strip_variants(), variant, false);
}

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
  const NodeId stand_in = add_arc(indexer, arc_of(indexer, request), site, options);
  if (stand_in == kNoNode || !indexer.is_outermost() ||
      is_relocate_stand_in(indexer.graph, stand_in)) {
    return stand_in;
  }
  const NodeId copy = propagate_to_root(indexer, stand_in);
  if (copy != kNoNode && indexer.graph[copy].origin != stand_in) {
    indexer.tasks.push(TaskKind::ImpliedClasses, stand_in);
  }
  return copy;
}

}  // namespace

NodeId find_matching_child(const Indexer& indexer, NodeId parent, ArcKind parent_arc,
                           const Site& site, ArcKind kind, const MapFunction& map,
                           std::uint16_t depth_below_introduction) {
  const NodeGraph& graph = indexer.graph;
  for (NodeId id = graph[parent].first_child; id != kNoNode; id = graph[id].next_sibling) {
    // Below a relocate sites mean little: what is implied there keeps the source's path.
    const bool matches =
        parent_arc == ArcKind::Relocate
            ? graph[id].arc == kind && *graph[id].map_to_parent == map &&
                  graph.depth_below_introduction(graph[id].origin) == depth_below_introduction
            : graph.site(id) == site;
    if (matches) {
      return id;
    }
  }
  return kNoNode;
}

NodeId add_class_arc(Indexer& indexer, const ClassArcRequest& request) {
  const NodeGraph& graph = indexer.graph;
  const Path parent_path = graph[request.parent].path;
  const ArcKind parent_arc = FrameCursor{&graph, request.parent, indexer.frame}.arc();
  const Site site{graph[request.parent].layer_stack,
                  class_path(graph[request.parent], parent_arc, request)};
  if (site.path.empty()) {
    return kNoNode;
  }
  const NodeId known =
      find_matching_child(indexer, request.parent, parent_arc, site, request.kind, request.map,
                          graph.depth_below_introduction(request.origin));
  if (known != kNoNode) {
    return known;
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
      indexer.report(error_class::kInvalidPrimPath, arc.layer, site.path,
                     "the class path " + quoted(arc.path) +
                         " is no absolute prim path without variants",
                     "name a prim by its absolute path");
    } else {
      ClassArcRequest request;
      request.kind = kind;
      request.parent = request.origin = node;
      request.map = arc_map(indexer, arc.path, node, {}).with_root_identity();
      request.number = number;
      add_class_arc(indexer, request);
    }
    ++number;
  }
}

}  // namespace tenon::compose
