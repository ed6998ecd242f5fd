// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Siblings compare by kind of arc, depth in namespace, origin, and place in their list. Origins are
// nodes that are linked in order of strength already, so of two the first in the walk is stronger:
// climb to children of a common parent, then run along the siblings from both at once, which takes
// no more steps than lie between them. A specialize may be below the root, far from where it was
// authored, and is followed along its origins back to the authored arc.
#include "tenon/compose/strength_order.h"

#include <algorithm>
#include <optional>

namespace tenon::compose {
namespace {

constexpr std::size_t kStepsForUnit = 4;  // from node to node, where nothing else is done

template <class T>
int ascending(T a, T b) {
  return a < b ? -1 : a > b ? 1 : 0;
}

template <class T>
int descending(T a, T b) {
  return ascending(b, a);
}

/// Of two children of one node, the first or the second one is met first: -1 or 1.
int sibling_order(const NodeGraph& graph, NodeId a, NodeId b) {
  std::size_t steps = 0;
  NodeId after_a = graph[a].next_sibling;
  NodeId after_b = graph[b].next_sibling;
  while (after_a != b && after_b != a && after_a != kNoNode && after_b != kNoNode) {
    after_a = graph[after_a].next_sibling;
    after_b = graph[after_b].next_sibling;
    ++steps;
  }
  graph.count(steps / kStepsForUnit);
  return after_a == b || after_b == kNoNode ? -1 : 1;
}

/// Two children of one node on the ways to two nodes; two nodes of one way are their own.
struct Branches {
  NodeId a;
  NodeId b;
};

Branches branches_to(const NodeGraph& graph, NodeId a, NodeId b) {
  const std::size_t a_depth = graph[a].arcs_above;
  const std::size_t b_depth = graph[b].arcs_above;
  std::size_t steps = a_depth > b_depth ? a_depth - b_depth : b_depth - a_depth;
  while (graph[a].arcs_above > b_depth) {
    a = graph[a].parent;
  }
  while (graph[b].arcs_above > a_depth) {
    b = graph[b].parent;
  }
  for (; a != b && graph[a].parent != graph[b].parent; ++steps) {
    a = graph[a].parent;
    b = graph[b].parent;
  }
  graph.count(steps / kStepsForUnit);
  return {a, b};
}

/// Which of two linked nodes a walk in order of strength meets first.
int tree_order(const NodeGraph& graph, NodeId a, NodeId b) {
  const Branches at = branches_to(graph, a, b);
  return at.a == at.b ? ascending(graph[a].arcs_above, graph[b].arcs_above)
                      : sibling_order(graph, at.a, at.b);
}

/// One is below the other, going from a copied specialize to where it was authored.
bool is_below(const NodeGraph& graph, NodeId id, NodeId above) {
  std::size_t steps = 0;
  while (id != kNoNode && id != above) {
    id = graph.is_propagated_specialize(id) ? graph[id].origin : graph[id].parent;
    ++steps;
  }
  graph.count(steps / kStepsForUnit);
  return id == above;
}

/// Depth at which the hierarchy of classes that `id` is in was introduced.
std::uint16_t hierarchy_depth(const NodeGraph& graph, NodeId id) {
  NodeId instance = graph.start_of_class_hierarchy(id).first;
  while (graph[instance].arc == ArcKind::Relocate) {
    instance = graph[instance].parent;
  }
  return graph[instance].namespace_depth;
}

/// An implied specialize is more local than the copy of an authored one; 0 when both are alike.
int implied_first(const NodeGraph& graph, const Node& a, const Node& b) {
  const bool a_implied = !a.same_site(graph[a.origin]);
  const bool b_implied = !b.same_site(graph[b.origin]);
  return descending(a_implied, b_implied);
}

/// Specializes with one authored arc at the start of their origins but different origins.
int compare_of_common_root(const NodeGraph& graph, const Node& a, const Node& b,
                           std::size_t a_steps, std::size_t b_steps) {
  const bool a_authored = a.origin == a.parent;
  const bool b_authored = b.origin == b.parent;
  const std::uint16_t a_depth = a_authored ? std::uint16_t{0} : hierarchy_depth(graph, a.origin);
  const std::uint16_t b_depth = b_authored ? std::uint16_t{0} : hierarchy_depth(graph, b.origin);
  if (a_depth != b_depth) {
    return ascending(a_depth, b_depth);
  }
  if (a_steps != b_steps) {
    return descending(a_steps, b_steps);
  }
  const LayerStack* root_stack = graph[0].layer_stack;
  if (a.layer_stack == root_stack && b.layer_stack == root_stack && !a_authored && !b_authored) {
    if (const int order = implied_first(graph, a, b)) {
      return order;
    }
  }
  return tree_order(graph, a.origin, b.origin);
}

int compare_specializes(const NodeGraph& graph, NodeId a_id, NodeId b_id) {
  const Node& a = graph[a_id];
  const Node& b = graph[b_id];
  const auto [a_root, a_steps] = graph.origin_root(a_id);
  const auto [b_root, b_steps] = graph.origin_root(b_id);
  if (!is_below(graph, a_root, b_root) && !is_below(graph, b_root, a_root) &&
      a.namespace_depth != b.namespace_depth) {
    return descending(a.namespace_depth, b.namespace_depth);
  }
  if (a.origin != b.origin) {
    return a_root != b_root ? tree_order(graph, a_root, b_root)
                            : compare_of_common_root(graph, a, b, a_steps, b_steps);
  }
  if (a.origin != a.parent) {
    if (const int order = implied_first(graph, a, b)) {
      return order;
    }
  }
  return ascending(a.sibling_number, b.sibling_number);
}

}  // namespace

int compare_siblings(const NodeGraph& graph, NodeId a_id, NodeId b_id) {
  const Node& a = graph[a_id];
  const Node& b = graph[b_id];
  graph.count(1);
  if (a_id == b_id) {
    return 0;
  }
  if (a.arc != b.arc) {
    return ascending(a.arc, b.arc);
  }
  if (a.arc == ArcKind::Specialize) {
    return compare_specializes(graph, a_id, b_id);
  }
  if (a.namespace_depth != b.namespace_depth) {
    return descending(a.namespace_depth, b.namespace_depth);
  }
  return a.origin != b.origin ? tree_order(graph, a.origin, b.origin)
                              : ascending(a.sibling_number, b.sibling_number);
}

int compare_nodes(const NodeGraph& graph, NodeId a, NodeId b) {
  const Branches at = branches_to(graph, a, b);
  return at.a == at.b ? ascending(graph[a].arcs_above, graph[b].arcs_above)
                      : compare_siblings(graph, at.a, at.b);
}

}  // namespace tenon::compose
