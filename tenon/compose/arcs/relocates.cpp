// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A relocated prim gets a node for its source: the source's own site may not have opinions, but all
// that applies to the source because of its ancestors does. The source itself is no prim any more.
#include <algorithm>

#include "tenon/compose/arcs/authored_arc.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

void elide_subtree(NodeGraph& graph, NodeId node) {
  for (const NodeId id : graph.subtree(node)) {
    graph.set_culled(id);
    graph[id].restriction_depth = 1;  // not by its ancestors either
    graph.touch();
  }
}

/// Opinions within a relocate's source that another relocate moves elsewhere.
void elide_relocated_subtrees(NodeGraph& graph, NodeId relocate) {
  NodeIds open = graph.children(relocate);
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const Node& node = graph[id];
    if (node.arc == ArcKind::Relocate) {
      continue;
    }
    if (node.can_contribute() && node.layer_stack->relocation_target(node.path) != nullptr) {
      elide_subtree(graph, id);
      continue;
    }
    for (const NodeId child : graph.children(id)) {
      open.push_back(child);
    }
  }
}

void report_opinions_at_source(Indexer& indexer, const Site& source) {
  for (const StackedLayer& stacked : source.layer_stack->layers) {
    if (stacked.layer->has(source.path)) {
      indexer.report(error_class::kOpinionAtRelocationSource, stacked.layer.get(), source.path,
                     "opinions on " + named(source.path) + " are ignored: it is relocated",
                     "move the opinions to the target of the relocate");
    }
  }
}

void report_prohibited(Indexer& indexer, const Node& prohibited) {
  const Frame& frame = *indexer.frame;
  const Node& parent = (*frame.graph)[frame.parent];
  AuthoredArc item =
      authored_arc(*parent.layer_stack, parent.path, frame.arc->kind, frame.requested.path);
  indexer.report(error_class::kArcToProhibitedChild,
                 item.layer == nullptr ? parent.layer_stack->root.get() : item.layer, parent.path,
                 "the arc leads to " +
                     named_in(*frame.requested.layer_stack->root, frame.requested.path) +
                     ", which needs opinions of the relocated " + named(prohibited.path),
                 "point the arc at the target of the relocate", std::move(item.part));
}

/// The node that could contribute at the source of a relocate of its stack; kNoNode if none.
NodeId find_prohibited(const NodeGraph& graph) {
  if (std::none_of(graph.nodes().begin(), graph.nodes().end(),
                   [](const Node& node) { return node.layer_stack->has_relocates(); })) {
    return kNoNode;
  }
  NodeIds open(0);
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const Node& node = graph[id];
    if (node.culled) {
      continue;
    }
    if (!node.inert && node.layer_stack->relocation_target(node.path) != nullptr) {
      return id;
    }
    for (NodeId child = node.last_child; child != kNoNode; child = graph[child].previous_sibling) {
      open.push_back(child);
    }
  }
  return kNoNode;
}

}  // namespace

void eval_node_relocates(Indexer& indexer, NodeId node) {
  NodeGraph& graph = indexer.graph;
  if (!graph[node].can_contribute()) {
    return;
  }
  const Site site = graph.site(node);
  const Path* source_path = site.layer_stack->relocation_source(site.path);
  if (source_path == nullptr) {
    return;
  }
  const Site source{site.layer_stack, *source_path};
  for (const NodeId child : graph.children(node)) {
    if (graph[child].arc != ArcKind::Variant) {
      elide_subtree(graph, child);  // what the target had before is replaced
    }
  }
  Arc arc;
  arc.kind = ArcKind::Relocate;
  arc.map_to_parent = indexer.services.maps->identity();
  arc.parent = arc.origin = node;
  arc.namespace_depth = introduction_depth(indexer, node);
  ArcOptions options;
  options.contributes = false;
  options.include_ancestral = true;
  const NodeId relocate = add_arc(indexer, arc, source, options);
  if (relocate != kNoNode) {
    report_opinions_at_source(indexer, source);
    elide_relocated_subtrees(graph, relocate);
  }
}

void eval_implied_relocates(Indexer& indexer, NodeId node) {
  NodeGraph& graph = indexer.graph;
  const NodeId parent = graph[node].parent;
  if (graph[node].due_to_ancestor || parent == kNoNode || graph[parent].parent == kNoNode) {
    return;
  }
  const NodeId above = graph[parent].parent;
  const Path source = graph[parent].map_to_parent->map_source_to_target(graph[node].path);
  if (source.empty()) {
    return;
  }
  for (const NodeId child : graph.children(above)) {
    if (graph[child].path == source && graph[child].arc == ArcKind::Relocate) {
      return;
    }
  }
  Arc arc;
  arc.kind = ArcKind::Relocate;
  arc.map_to_parent = indexer.services.maps->identity();
  arc.parent = above;
  arc.origin = node;
  arc.namespace_depth = introduction_depth(indexer, above);
  ArcOptions options;
  options.contributes = false;
  add_arc(indexer, arc, {graph[above].layer_stack, source}, options);
}

bool elide_if_prohibited(Indexer& indexer) {
  NodeGraph& graph = indexer.graph;
  const NodeId prohibited = find_prohibited(graph);
  if (prohibited == kNoNode) {
    return false;
  }
  if (indexer.frame != nullptr) {
    report_prohibited(indexer, graph[prohibited]);
  }
  graph.set_inert(0, true);
  for (const NodeId child : graph.children(0)) {
    elide_subtree(graph, child);
  }
  return true;
}

}  // namespace tenon::compose
