// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Adds one arc to the graph. A site that is not a root prim brings along what applies to it because
// of its ancestors: an index of its own is built for it and moved in as a subtree. Such inner
// indices leave variants to the outermost one, which sees the strongest selections.
#include <algorithm>

#include "tenon/base/limits/limits.h"
#include "tenon/compose/arcs/authored_arc.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

std::string_view verb(ArcKind kind) {
  switch (kind) {
    case ArcKind::Inherit:
      return "inherits";
    case ArcKind::Relocate:
      return "is relocated from";
    case ArcKind::Variant:
      return "uses variant";
    case ArcKind::Reference:
      return "references";
    case ArcKind::Payload:
      return "has payload";
    case ArcKind::Specialize:
      return "specializes";
    case ArcKind::Root:
      break;
  }
  return "is";
}

bool is_implied_class(ArcKind kind, NodeId parent, NodeId origin) {
  return is_class_based(kind) && parent != origin;
}

constexpr std::size_t kElementsForArc = 8;  // of a path that are gone up

/// Whether one site is at or below the other.
bool nested(const NodeGraph& graph, const Site& a, const Site& b) {
  graph.count(1);
  if (a.layer_stack != b.layer_stack) {
    return false;
  }
  const auto [low, high] = std::minmax({a.path.depth(), b.path.depth()});
  graph.count((high - low) / kElementsForArc);
  return a.path.has_prefix(b.path) || b.path.has_prefix(a.path);
}

/// The path that something at `path` in an inner graph will have in the outer one: the inner graph
/// may still be at an ancestor of the site that it is requested for.
Path in_outer_graph(const Frame& frame, const NodeGraph& inner, Path path) {
  const Path requested = frame.requested.path;
  const Path current = inner[0].path;
  return current == path ? requested : requested.replace_prefix(current, path, false);
}

/// An implied class below a relocate is only a stand-in and closes no cycle.
bool is_below_relocate(const Indexer& indexer, const Arc& arc) {
  if (!is_implied_class(arc.kind, arc.parent, arc.origin)) {
    return false;
  }
  FrameCursor at{&indexer.graph, arc.parent, indexer.frame};
  while (!at.at_end() && is_class_based(at.arc())) {
    at.to_parent();
  }
  return !at.at_end() && at.arc() == ArcKind::Relocate;
}

bool closes_cycle(const Indexer& indexer, const Arc& arc, Site site) {
  if (arc.kind == ArcKind::Variant || is_below_relocate(indexer, arc)) {
    return false;
  }
  for (FrameCursor at{&indexer.graph, arc.parent, indexer.frame}; !at.at_end();
       at.to_outer_frame()) {
    for (NodeId id = at.node; id != kNoNode; id = (*at.graph)[id].parent) {
      if (nested(*at.graph, at.graph->site(id), site)) {
        return true;
      }
    }
    if (at.frame != nullptr) {
      site.path = in_outer_graph(*at.frame, *at.graph, site.path);
    }
  }
  return false;
}

void report_cycle(Indexer& indexer, const Arc& arc, const Site& site) {
  constexpr std::size_t kArcs = 20;   // told at most
  constexpr std::size_t kText = 800;  // bytes, after which no more are reported
  Message chain = named_in(*site.layer_stack->root, site.path);
  std::string_view word = verb(arc.kind);
  std::size_t length = 0;
  for (FrameCursor at{&indexer.graph, arc.parent, indexer.frame}; !at.at_end(); at.to_parent()) {
    const Node& node = (*at.graph)[at.node];
    chain = named_in(*node.layer_stack->root, node.path) + " " + std::string(word) + " " + chain;
    word = verb(at.arc());
    if (++length > kArcs || chain.text().size() > kText) {
      chain = "... " + chain;
      break;
    }
  }
  const Node& parent = indexer.graph[arc.parent];
  AuthoredArc item = authored_arc(*parent.layer_stack, parent.path, arc.kind, site.path);
  indexer.report(error_class::kArcCycle,
                 item.layer == nullptr ? parent.layer_stack->root.get() : item.layer, parent.path,
                 "the arcs form a cycle; the last one is skipped: " + chain,
                 "remove one arc of the cycle", std::move(item.part));
}

bool is_duplicate(const Indexer& indexer, NodeId parent, Site site) {
  for (FrameCursor at{&indexer.graph, parent, indexer.frame}; !at.at_end(); at.to_outer_frame()) {
    if (at.graph->find_site(site) != kNoNode) {
      return true;
    }
    if (at.frame != nullptr) {
      site.path = in_outer_graph(*at.frame, *at.graph, site.path);
    }
  }
  return false;
}

std::size_t arcs_above(const Indexer& indexer, NodeId parent) {
  std::size_t count = 0;
  for (FrameCursor at{&indexer.graph, parent, indexer.frame}; !at.at_end(); at.to_outer_frame()) {
    count += (*at.graph)[at.node].arcs_above + 1u;
  }
  return count;
}

/// Inputs that would never end, or not soon enough.
bool is_over_limit(Indexer& indexer, NodeId parent) {
  if (indexer.services.work->exhausted()) {
    return true;  // which the cache reports
  }
  const bool nested_too_deep =
      indexer.frame != nullptr && indexer.frame->depth >= limits::kNestedIndices;
  std::size_t size = indexer.graph.size();
  for (const Frame* frame = indexer.frame; frame != nullptr; frame = frame->previous) {
    size += frame->graph->size();
  }
  if (!nested_too_deep && size < limits::kIndexNodes &&
      *indexer.services.node_count < indexer.services.options->max_nodes &&
      arcs_above(indexer, parent) < limits::kArcChainDepth) {
    return false;
  }
  const std::string rule = "compose." + std::string(error_class::kCapacityExceeded);
  for (const Diagnostic& found : indexer.errors) {
    if (found.rule == rule) {
      return true;
    }
  }
  const Node& node = indexer.graph[parent];
  indexer.report(error_class::kCapacityExceeded, node.layer_stack->root.get(), node.path,
                 "too many arcs apply to this prim; the rest is skipped",
                 "reduce the arcs that multiply with each other");
  return true;
}

NodeId add_single_node(Indexer& indexer, const Arc& arc, const Site& site, bool contributes) {
  NodeGraph& graph = indexer.graph;
  ++*indexer.services.node_count;
  const NodeId id = graph.insert_child(site, arc);
  if (!contributes) {
    graph.set_inert(id, true);
    graph[id].restriction_depth = 1;  // not by its ancestors either
  }
  graph.count(site.layer_stack->layers.size());
  graph[id].has_specs = site.layer_stack->has_spec(site.path);
  return id;
}

NodeId add_subgraph(Indexer& indexer, const Arc& arc, const Site& site, const ArcOptions& options) {
  Frame frame;
  frame.previous = indexer.frame;
  frame.requested = site;
  frame.graph = &indexer.graph;
  frame.parent = arc.parent;
  frame.arc = &arc;
  frame.skip_duplicates = options.skip_duplicates;
  frame.depth = indexer.frame == nullptr ? 1 : indexer.frame->depth + 1;

  NodeGraph inner_graph(*indexer.services.maps, *indexer.services.work);
  Indexer inner(indexer.services, &frame, inner_graph, indexer.errors);
  inner.root_prim = indexer.root_prim;
  build_graph(inner, site, options.contributes);
  indexer.has_payloads = indexer.has_payloads || inner.has_payloads;
  indexer.payload_loaded = indexer.payload_loaded || inner.payload_loaded;
  return indexer.graph.insert_subgraph(inner_graph, arc);
}

AuthoredArcs arcs_of(const Node& node, WorkMeter& work) {
  if (!node.has_opinions()) {
    return {};
  }
  work.count(node.layer_stack->layers.size());
  return authored_arcs(*node.layer_stack, node.path);
}

/// Some ancestor of the node's path that it may contribute to has variant sets.
bool has_ancestral_variants(const Node& node, WorkMeter& work) {
  for (Path path = node.path.parent(); !path.empty() && !path.is_absolute_root();
       path = path.parent()) {
    work.count(node.layer_stack->layers.size());
    if (can_contribute_at(node, path) && authored_arcs(*node.layer_stack, path).variants) {
      return true;
    }
  }
  return false;
}

void add_node_tasks(Indexer& indexer, NodeId id, bool skip_expressed, bool ancestral_variants,
                    bool check_prim_path) {
  const Node& node = indexer.graph[id];
  const AuthoredArcs arcs = arcs_of(node, *indexer.services.work);
  TaskQueue& tasks = indexer.tasks;
  const auto push_if = [&](bool condition, TaskKind kind) {
    if (condition) {
      tasks.push(kind, id);
    }
  };
  push_if(check_prim_path && (node.arc == ArcKind::Reference || node.arc == ArcKind::Payload),
          TaskKind::UnresolvedPrimPath);
  push_if(arcs.variants && indexer.is_outermost(), TaskKind::VariantSets);
  push_if(ancestral_variants && has_ancestral_variants(node, *indexer.services.work),
          TaskKind::AncestralVariantSets);
  if (!skip_expressed) {
    push_if(arcs.specializes, TaskKind::Specializes);
    push_if(arcs.inherits, TaskKind::Inherits);
    push_if(arcs.payloads, TaskKind::Payloads);
    push_if(arcs.references, TaskKind::References);
    push_if(node.can_contribute() && node.layer_stack->has_relocates(), TaskKind::NodeRelocates);
  }
  push_if(node.arc == ArcKind::Relocate, TaskKind::ImpliedRelocates);
}

/// Only the outermost graph passes on what its arcs bring in, so within an inner one an instance
/// shares less.
void set_ancestry(Indexer& indexer, NodeId id, const ArcOptions& options) {
  NodeGraph& graph = indexer.graph;
  Node& node = graph[id];
  const Node& origin = graph[node.origin];
  node.due_to_ancestor = options.ancestry_of_origin && origin.due_to_ancestor;
  node.due_to_direct_arc = !options.ancestry_of_origin || origin.due_to_direct_arc;
  if (options.include_ancestral && indexer.is_outermost() && node.due_to_direct_arc) {
    for (const NodeId below : graph.subtree(id)) {
      graph[below].due_to_direct_arc = true;
    }
  }
}

}  // namespace

void make_subtree_inert(NodeGraph& graph, NodeId node) {
  for (const NodeId id : graph.subtree(node)) {
    graph.set_inert(id, true);
  }
}

void add_implied_class_task(Indexer& indexer, NodeId id) {
  const NodeGraph& graph = indexer.graph;
  if (is_class_based(graph[id].arc)) {
    indexer.tasks.push(TaskKind::ImpliedClasses, start_of_implied_classes(graph, id));
  } else if (graph.has_class_based_child(id)) {
    indexer.tasks.push(TaskKind::ImpliedClasses, id);
  }
}

ArcKind FrameCursor::arc() const {
  const ArcKind kind = (*graph)[node].arc;
  return kind == ArcKind::Root && frame != nullptr ? frame->arc->kind : kind;
}

void FrameCursor::to_parent() {
  if ((*graph)[node].arc != ArcKind::Root) {
    node = (*graph)[node].parent;
  } else {
    to_outer_frame();
  }
}

void FrameCursor::to_outer_frame() {
  if (frame == nullptr) {
    node = kNoNode;
    return;
  }
  graph = frame->graph;
  node = frame->parent;
  frame = frame->previous;
}

bool can_contribute_at(const Node& node, Path ancestral_path) {
  return node.restriction_depth == 0 || node.restriction_depth > ancestral_path.depth();
}

std::uint16_t introduction_depth(const Indexer& indexer, NodeId parent) {
  return namespace_depth_of(indexer.graph[parent].path);
}

MapFunction arc_map(const Indexer& indexer, Path source, NodeId target, layer::LayerOffset offset) {
  const Node& node = indexer.graph[target];
  const Path target_path = node.path.strip_variants();
  MapFunction map = MapFunction::make({{source, target_path}}, offset);
  if (!node.layer_stack->has_relocates()) {
    return map;
  }
  const MapFunction relocates = relocates_map(*node.layer_stack, target_path);
  indexer.graph.count(node.layer_stack->relocates.size() / 4 +
                      map_making_units(relocates.pairs().size()));
  return relocates.compose(map);
}

const MapFunction* shared_arc_map(const Indexer& indexer, const ArcEnds& ends, NodeId target) {
  const auto make = [&] {
    const MapFunction map = arc_map(indexer, ends.source, target, ends.offset);
    return ends.root_identity ? map.with_root_identity() : map;
  };
  MapPool& maps = *indexer.services.maps;
  const Node& node = indexer.graph[target];
  if (node.layer_stack->relocates.size() <= kFewPairs) {
    return maps.add(make());
  }
  return maps.find_or_make({node.layer_stack, nullptr, ends.source, node.path.strip_variants(),
                            ends.offset, ends.root_identity},
                           make);
}

void add_root_tasks(Indexer& indexer) {
  for (const NodeId id : indexer.graph.subtree(0)) {
    add_node_tasks(indexer, id, false, false, false);
  }
}

void add_tasks(Indexer& indexer, NodeId node, bool skip_expressed, bool ancestral_variants) {
  add_implied_class_task(indexer, node);
  if (skip_expressed && indexer.is_outermost() && indexer.graph.has_specialize_in_subtree(node)) {
    indexer.tasks.push(TaskKind::ImpliedSpecializes, node);
  }
  for (const NodeId id : indexer.graph.subtree(node)) {
    add_node_tasks(indexer, id, skip_expressed, ancestral_variants, indexer.is_outermost());
  }
}

NodeId add_arc(Indexer& indexer, const Arc& arc, const Site& site, const ArcOptions& given) {
  ArcOptions options = given;
  options.skip_duplicates |= indexer.frame != nullptr && indexer.frame->skip_duplicates;
  if (closes_cycle(indexer, arc, site)) {
    report_cycle(indexer, arc, site);
    return kNoNode;
  }
  if ((options.skip_duplicates && is_duplicate(indexer, arc.parent, site)) ||
      is_over_limit(indexer, arc.parent)) {
    return kNoNode;
  }
  const NodeId id = options.include_ancestral
                        ? add_subgraph(indexer, arc, site, options)
                        : add_single_node(indexer, arc, site, options.contributes);
  set_ancestry(indexer, id, options);
  if (options.expand) {
    add_tasks(indexer, id, options.include_ancestral,
              indexer.is_outermost() && options.include_ancestral);
  }
  if (site.path.is_absolute_root()) {
    make_subtree_inert(indexer.graph, id);  // represents a missing default prim
  }
  return id;
}

}  // namespace tenon::compose
