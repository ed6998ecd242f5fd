// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Nodes that a namespace ancestor brought in and that say nothing about this prim are dropped, so
// that indices stay small further down. Nodes of arcs at this prim stay in any case.
#include <algorithm>

#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

/// Whether a class that is used through this node exists in the composed scene, where its users can
/// be asked for, though it says nothing here.
bool is_local_inherit_of_subroot_class(const NodeGraph& graph, NodeId id) {
  const Node& node = graph[id];
  if (node.arc != ArcKind::Inherit || node.layer_stack != graph[0].layer_stack) {
    return false;
  }
  const NodeId authored = node.origin == node.parent ? id : graph.origin_root(id).first;
  return graph.path_at_introduction(authored).depth() != 1;
}

bool can_be_culled(const NodeGraph& graph, NodeId id) {
  const Node& node = graph[id];
  if (node.culled) {
    return true;
  }
  if (node.arc == ArcKind::Root || graph.depth_below_introduction(id) == 0 ||
      is_local_inherit_of_subroot_class(graph, id)) {
    return false;
  }
  for (NodeId child = node.first_child; child != kNoNode; child = graph[child].next_sibling) {
    if (!graph[child].culled) {
      return false;
    }
  }
  return !node.has_opinions();
}

}  // namespace

void cull_without_opinions(NodeGraph& graph) {
  const NodeIds nodes = graph.subtree(0);
  for (auto it = nodes.rbegin(); it != nodes.rend(); ++it) {
    if (can_be_culled(graph, *it)) {
      graph.set_culled(*it);
    }
  }
}

}  // namespace tenon::compose
