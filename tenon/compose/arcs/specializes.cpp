// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Opinions that come over a specialize are weaker than all that do not. So a specialize that stands
// anywhere in the graph is copied below the root, among the other specializes, and all opinions and
// further arcs belong to the copy. Its origin remembers where it was authored or implied.
#include "tenon/compose/indexer.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {

void eval_specializes(Indexer& indexer, NodeId node) {
  add_class_arcs(indexer, node, ArcKind::Specialize, layer::fields::specializes);
}

bool is_relocate_stand_in(const NodeGraph& graph, NodeId id) {
  const Node& node = graph[id];
  return node.parent != kNoNode && node.parent != node.origin &&
         graph[node.parent].arc == ArcKind::Relocate && node.same_site(graph[node.parent]);
}

NodeId propagate_to_root(Indexer& indexer, NodeId node) {
  const NodeGraph& graph = indexer.graph;
  const Site site = graph.site(node);
  const MapFunction* map = graph[node].map_to_root;
  const NodeId known = find_matching_child(indexer, 0, graph[0].arc, site, ArcKind::Specialize,
                                           *map, graph.depth_below_introduction(node));
  if (known != kNoNode) {
    return known;
  }
  Arc arc;
  arc.kind = ArcKind::Specialize;
  arc.map_to_parent = map;
  arc.parent = 0;
  arc.origin = node;
  arc.namespace_depth = introduction_depth(indexer, 0);
  arc.sibling_number = graph[node].sibling_number;
  ArcOptions options;
  options.skip_duplicates = true;
  options.include_ancestral = site.path.depth() != 1;
  options.ancestry_of_origin = true;
  return add_arc(indexer, arc, site, options);
}

void eval_implied_specializes(Indexer& indexer, NodeId node) {
  NodeGraph& graph = indexer.graph;
  if (graph[node].parent == kNoNode) {
    return;
  }
  NodeIds open(node);
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    if (is_relocate_stand_in(graph, at)) {
      continue;
    }
    if (graph[at].arc == ArcKind::Specialize) {
      propagate_to_root(indexer, at);
    }
    const NodeIds children = graph.children(at);
    for (auto it = children.rbegin(); it != children.rend(); ++it) {
      open.push_back(*it);
    }
  }
}

}  // namespace tenon::compose
