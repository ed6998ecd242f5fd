// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes lie in one vector and name each other by index. Siblings are linked in order of strength
// when they are inserted, so a walk meets the strongest node first at any time. A specialize can
// have a copy below the root, where its strength belongs: the original stays, is the copy's origin,
// and leaves its children to the copy. Walks count their work, which bounds composition as a whole.
// The finished index holds the nodes in the order of the walk, without culled ones that nothing
// leads to.
#include "tenon/compose/node_graph.h"

#include <algorithm>
#include <limits>

#include "tenon/compose/strength_order.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kNodeUnits = 8;         // of work to make a node
constexpr std::size_t kNodesLookedAt = 4;     // for a unit, where nothing else is done with them
constexpr std::size_t kElementsForNode = 16;  // of paths

/// To make such a map, or only to find it: making one of many pairs has been counted.
std::size_t map_units(const MapFunction& map) {
  const std::size_t pairs = map.pairs().size();
  if (pairs == 0) {
    return 0;
  }
  return kKnownMapUnits + (pairs > kFewPairs ? 0 : map_making_units(pairs));
}

std::uint16_t clamped(std::size_t value) {
  return static_cast<std::uint16_t>(
      std::min<std::size_t>(value, std::numeric_limits<std::uint16_t>::max()));
}

/// `steps` elements less, variant selections below the last one dropped along.
Path climb(Path path, std::uint16_t steps) {
  for (; steps > 0 && !path.empty(); --steps) {
    while (path.is_variant_selection()) {
      path = path.parent();
    }
    path = path.parent();
  }
  return path;
}

}  // namespace

std::uint16_t namespace_depth_of(Path path) {
  std::size_t depth = path.depth();
  for (; path.has_variants(); path = path.parent()) {
    depth -= path.is_variant_selection() ? 1 : 0;
  }
  return clamped(depth);
}

void NodeGraph::reset(const Site& site) {
  nodes_.clear();
  nodes_.reserve(kNodesToCome);
  copies_known_ = false;
  ++revision_;
  Node root;
  root.layer_stack = site.layer_stack;
  root.path = site.path;
  root.map_to_parent = root.map_to_root = maps_->identity();
  nodes_.push_back(root);
}

void NodeGraph::set_arc(NodeId id, const Arc& arc) {
  Node& node = nodes_[id];
  node.arc = arc.kind;
  node.map_to_parent = arc.map_to_parent;
  node.map_to_root = maps_->compose(nodes_[arc.parent].map_to_root, arc.map_to_parent, *work_);
  count(kNodeUnits + map_units(*node.map_to_root));
  node.parent = arc.parent;
  node.origin = arc.origin;
  node.arcs_above = clamped(nodes_[arc.parent].arcs_above + 1u);
  node.namespace_depth = arc.namespace_depth;
  node.sibling_number = arc.sibling_number;
  ++revision_;
  if (copies_known_ && is_propagated_specialize(id)) {
    copies_.insert_or_assign(node.origin, id);
  }
}

NodeId NodeGraph::insert_child(const Site& site, const Arc& arc) {
  const auto id = static_cast<NodeId>(nodes_.size());
  Node node;
  node.layer_stack = site.layer_stack;
  node.path = site.path;
  nodes_.push_back(node);
  set_arc(id, arc);
  link(arc.parent, id);
  return id;
}

NodeId NodeGraph::insert_subgraph(const NodeGraph& other, const Arc& arc) {
  const auto base = static_cast<NodeId>(nodes_.size());
  nodes_.insert(nodes_.end(), other.nodes_.begin(), other.nodes_.end());
  const auto shift = [&](NodeId& id) { id += id == kNoNode ? 0 : base; };
  for (NodeId id = base; id < nodes_.size(); ++id) {
    Node& node = nodes_[id];
    shift(node.parent);
    shift(node.origin);
    shift(node.first_child);
    shift(node.last_child);
    shift(node.next_sibling);
    shift(node.previous_sibling);
  }
  set_arc(base, arc);
  for (NodeId id = base + 1; id < nodes_.size(); ++id) {
    nodes_[id].map_to_root =
        maps_->compose(nodes_[base].map_to_root, nodes_[id].map_to_root, *work_);
    nodes_[id].arcs_above = clamped(nodes_[id].arcs_above + nodes_[base].arcs_above);
    count(kNodeUnits + map_units(*nodes_[id].map_to_root));
  }
  link(arc.parent, base);
  return base;
}

/// Strengths of specializes do not always form an order: looking at the first sibling, then at the
/// last and then at those between decides as OpenUSD does.
void NodeGraph::link(NodeId parent, NodeId child) {
  const NodeId first = nodes_[parent].first_child;
  const NodeId last = nodes_[parent].last_child;
  NodeId next = first;
  if (first != kNoNode && compare_siblings(*this, child, first) >= 0) {
    if (compare_siblings(*this, child, last) >= 0) {
      next = kNoNode;
    } else {
      while (next != kNoNode && compare_siblings(*this, child, next) >= 0) {
        next = nodes_[next].next_sibling;
      }
    }
  }
  const NodeId previous = next == kNoNode ? last : nodes_[next].previous_sibling;
  nodes_[child].next_sibling = next;
  nodes_[child].previous_sibling = previous;
  (next == kNoNode ? nodes_[parent].last_child : nodes_[next].previous_sibling) = child;
  (previous == kNoNode ? nodes_[parent].first_child : nodes_[previous].next_sibling) = child;
}

NodeIds NodeGraph::children(NodeId id) const {
  NodeIds result;
  for (NodeId child = nodes_[id].first_child; child != kNoNode;
       child = nodes_[child].next_sibling) {
    result.push_back(child);
  }
  count(result.size());
  return result;
}

NodeIds NodeGraph::subtree(NodeId id) const {
  NodeIds result;
  for (NodeId at = id; at != kNoNode; at = next_in_subtree(at, id)) {
    result.push_back(at);
  }
  count(result.size());
  return result;
}

/// The next stronger ones first: down, then to the sibling, then to that of what it is below.
NodeId NodeGraph::next_in_subtree(NodeId at, NodeId root) const {
  if (nodes_[at].first_child != kNoNode) {
    return nodes_[at].first_child;
  }
  while (at != root && nodes_[at].next_sibling == kNoNode) {
    at = nodes_[at].parent;
  }
  return at == root ? kNoNode : nodes_[at].next_sibling;
}

std::uint16_t NodeGraph::depth_below_introduction(NodeId id) const {
  const Node& node = nodes_[id];
  if (node.parent == kNoNode) {
    return 0;
  }
  const std::uint16_t depth = namespace_depth_of(nodes_[node.parent].path);
  return depth > node.namespace_depth ? static_cast<std::uint16_t>(depth - node.namespace_depth)
                                      : std::uint16_t{0};
}

Path NodeGraph::path_at_introduction(NodeId id) const {
  return climb(nodes_[id].path, depth_below_introduction(id));
}

Path NodeGraph::introducing_path(NodeId id) const {
  const NodeId parent = nodes_[id].parent;
  return parent == kNoNode ? Path::absolute_root()
                           : climb(nodes_[parent].path, depth_below_introduction(id));
}

std::pair<NodeId, std::size_t> NodeGraph::origin_root(NodeId id) const {
  std::size_t steps = 0;
  while (nodes_[id].origin != nodes_[id].parent) {
    id = nodes_[id].origin;
    ++steps;
  }
  count(steps / kNodesLookedAt);
  return {id, steps};
}

bool NodeGraph::is_ancestor(NodeId ancestor, NodeId id) const {
  const std::size_t depth = nodes_[ancestor].arcs_above;
  if (nodes_[id].arcs_above < depth) {
    return false;
  }
  count((nodes_[id].arcs_above - depth) / kNodesLookedAt);
  while (nodes_[id].arcs_above > depth) {
    id = nodes_[id].parent;
  }
  return id == ancestor;
}

NodeId NodeGraph::find_site(const Site& site) const {
  count(nodes_.size() / kNodesLookedAt + 1);
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    const Node& node = nodes_[id];
    if (node.path == site.path && node.layer_stack == site.layer_stack && node.can_contribute()) {
      return id;
    }
  }
  return kNoNode;
}

void NodeGraph::descend(Path child_path) {
  const Path parent = child_path.parent();
  const Token name = child_path.name();
  count(nodes_.size() * (1 + child_path.depth() / kElementsForNode));
  for (Node& node : nodes_) {
    node.path = node.path == parent ? child_path : node.path.child(name);
    node.due_to_ancestor = &node != nodes_.data();
    node.due_to_direct_arc = false;
  }
}

void NodeGraph::restrict(NodeId id) {
  Node& node = nodes_[id];
  node.restriction_depth = node.can_contribute() ? std::uint16_t{0} : clamped(node.path.depth());
}

void NodeGraph::set_inert(NodeId id, bool inert) {
  if (nodes_[id].inert != inert) {
    nodes_[id].inert = inert;
    ++revision_;
    restrict(id);
  }
}

void NodeGraph::set_culled(NodeId id) {
  if (!nodes_[id].culled) {
    nodes_[id].culled = true;
    ++revision_;
    if (nodes_[id].restriction_depth == 0) {  // else its ancestors may be restricted already
      restrict(id);
    }
  }
}

bool NodeGraph::is_propagated_specialize(NodeId id) const {
  const Node& node = nodes_[id];
  return node.arc == ArcKind::Specialize && node.parent == 0 && node.origin != 0 &&
         node.same_site(nodes_[node.origin]);
}

NodeId NodeGraph::propagated_specialize(NodeId id) const {
  if (nodes_[id].arc != ArcKind::Specialize) {
    return kNoNode;
  }
  if (!copies_known_) {
    find_copies();
  }
  const auto found = copies_.find(id);
  return found == copies_.end() ? kNoNode : found->second;
}

void NodeGraph::find_copies() const {
  copies_.clear();
  copies_known_ = true;
  std::size_t steps = 0;
  for (NodeId child = nodes_[0].first_child; child != kNoNode; child = nodes_[child].next_sibling) {
    if (is_propagated_specialize(child)) {
      copies_.insert_or_assign(nodes_[child].origin, child);
    }
    ++steps;
  }
  count(steps / kNodesLookedAt);
}

NodeId NodeGraph::owner_of_children(NodeId id) const {
  const NodeId copy = propagated_specialize(id);
  return copy == kNoNode ? id : copy;
}

bool NodeGraph::has_class_based_child(NodeId id) const {
  for (NodeId child = nodes_[owner_of_children(id)].first_child; child != kNoNode;
       child = nodes_[child].next_sibling) {
    if (is_class_based(nodes_[child].arc)) {
      return true;
    }
  }
  return false;
}

bool NodeGraph::has_specialize_in_subtree(NodeId id) const {
  const NodeIds nodes = subtree(id);
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](NodeId at) { return nodes_[at].arc == ArcKind::Specialize; });
}

std::pair<NodeId, NodeId> NodeGraph::start_of_class_hierarchy(NodeId id) const {
  const auto authored = [&](NodeId at) {
    return is_propagated_specialize(at) ? nodes_[at].origin : at;
  };
  NodeId instance = authored(id);
  NodeId the_class = kNoNode;
  const std::uint16_t depth = depth_below_introduction(instance);
  while (is_class_based(nodes_[instance].arc) && depth_below_introduction(instance) == depth) {
    the_class = instance;
    instance = authored(nodes_[instance].parent);
    count(1);
  }
  return {instance, the_class};
}

/// A culled node stays when one that stays is below it or originates from it.
ShortList<bool, 24> NodeGraph::erasable() const {
  ShortList<bool, 24> result;
  result.assign(nodes_.size(), true);
  NodeIds open;
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    if (!nodes_[id].culled) {
      open.push_back(id);
    }
  }
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (id != kNoNode && result[id]) {
      result[id] = false;
      open.push_back(nodes_[id].parent);
      open.push_back(nodes_[id].origin);
    }
  }
  return result;
}

void NodeGraph::finalize() {
  if (nodes_.size() == 1) {
    return;
  }
  count(2 * nodes_.size());
  const ShortList<bool, 24> erased = erasable();
  NodeIds order = subtree(0);
  order.erase_if([&](NodeId id) { return erased[id]; });
  count(kKeptUnits * order.size());
  copies_known_ = false;
  if (order.size() == nodes_.size() && std::is_sorted(order.begin(), order.end())) {
    return;  // they lie and are linked so already
  }
  NodeIds new_id;
  new_id.assign(nodes_.size(), kNoNode);
  for (NodeId i = 0; i < order.size(); ++i) {
    new_id[order[i]] = i;
  }
  const auto renamed = [&](NodeId id) { return id == kNoNode ? kNoNode : new_id[id]; };
  std::vector<Node> sorted;
  sorted.reserve(order.size());
  for (const NodeId id : order) {
    Node node = nodes_[id];
    node.parent = renamed(node.parent);
    node.origin = renamed(node.origin);
    node.first_child = node.last_child = node.next_sibling = node.previous_sibling = kNoNode;
    sorted.push_back(node);
  }
  for (NodeId id = 1; id < sorted.size(); ++id) {
    Node& parent = sorted[sorted[id].parent];
    if (parent.last_child == kNoNode) {
      parent.first_child = id;
    } else {
      sorted[parent.last_child].next_sibling = id;
      sorted[id].previous_sibling = parent.last_child;
    }
    parent.last_child = id;
  }
  nodes_ = std::move(sorted);
}

}  // namespace tenon::compose
