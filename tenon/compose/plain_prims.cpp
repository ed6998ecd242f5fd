// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A child at which no arc starts has the nodes of its parent, each one name deeper. One look into
// each layer gives its opinions and tells whether an arc starts. Relocates and instances give other
// nodes, so their children are left to the pass list. plain_prims_test.cpp composes the same prims
// both ways.
#include "tenon/compose/plain_prims.h"

#include <algorithm>

#include "tenon/compose/twins/site_trace.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kIndexUnits = 120;  // of work for an index, which is kept
constexpr std::size_t kOpinionUnits = 4;  // for each of its opinions
constexpr std::size_t kNamesForUnit = 4;  // names listed by its opinions

void compose_names(PrimIndex& index) {
  if (index.opinions.size() == 1 && !index.opinions.front().spec->has(layer::fields::primOrder)) {
    const layer::Spec& spec = *index.opinions.front().spec;
    index.child_names = NameList(spec, layer::fields::primChildren);
    index.set_property_names(NameList(spec, layer::fields::properties));
  } else if (!index.opinions.empty()) {
    compose_child_names(index);
    compose_property_names(index);
  }
}

bool goes_deeper_alone(const Node& node) {
  return node.arc != ArcKind::Relocate && !node.layer_stack->has_relocates();
}

/// Takes the nodes one name deeper and gathers what the layers say there. False where an arc
/// starts.
bool descend(NodeGraph& graph, const Path child, PrimIndex& index) {
  AuthoredArcs arcs;
  graph.descend(child);
  for (NodeId id = 0; id < graph.size(); ++id) {
    Node& node = graph[id];
    if (!node.has_specs) {
      continue;
    }
    node.has_specs = false;
    graph.count(node.layer_stack->layers.size());
    SiteTrace::note(*node.layer_stack, node.path);
    for (const StackedLayer& stacked : node.layer_stack->layers) {
      const std::uint32_t number = stacked.layer->number_of(node.path);
      node.has_specs = node.has_specs || number != 0;
      if (number != 0 && node.can_contribute()) {
        index.add_opinion(id, node, stacked, number);
        arcs.add(stacked.layer->numbered_spec(number));
      }
    }
  }
  return !arcs.any();
}

/// Drops nodes that say nothing here. The others keep their order, and so do the opinions, which
/// are told where their nodes are now.
void drop_silent_nodes(NodeGraph& graph, PrimIndex& index) {
  const auto has_opinions = [](const Node& node) { return node.has_opinions(); };
  if (std::all_of(graph.nodes().begin() + 1, graph.nodes().end(), has_opinions)) {
    graph.count(kKeptUnits * graph.size());
    return;
  }
  cull_without_opinions(graph);
  graph.finalize();
  NodeId before = kNoNode;
  NodeId now = kNoNode;
  for (Opinion& opinion : index.opinions) {
    if (opinion.node != before) {
      before = opinion.node;
      do {
        ++now;  // from kNoNode to the first
      } while (!graph[now].has_opinions());
    }
    opinion.node = now;
  }
}

}  // namespace

bool build_local_child(const IndexServices& services, const PrimIndex& parent, PrimIndex& index) {
  const bool no_more_arcs = services.work->exhausted();
  if (!no_more_arcs && (parent.nodes.size() != 1 || services.root_stack->has_relocates())) {
    return false;
  }
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * parent.opinions.size());
  AuthoredArcs arcs;
  for (const Opinion& above : parent.opinions) {
    const std::uint32_t number = above.node == 0 ? above.layer->number_of(index.path) : 0;
    if (number != 0) {
      const layer::Spec& spec = above.layer->numbered_spec(number);
      arcs.add(spec);
      index.opinions.push_back({above.layer, &spec, index.path, 0, number, above.offset});
    }
  }
  if (arcs.any() && !no_more_arcs) {
    index.opinions.clear();
    return false;
  }
  const bool has_specs = !index.opinions.empty();
  const Node* like = parent.nodes.like();
  if (like == nullptr || like->has_specs != has_specs) {
    Node node = parent.nodes.front();
    node.first_child = node.last_child = kNoNode;
    node.has_specs = has_specs;
    like = services.maps->like(node);
  }
  index.nodes.be_like(*like, index.path);
  compose_names(index);
  return true;
}

bool build_child_below_arcs(const IndexServices& services, const PrimIndex& parent,
                            PrimIndex& index) {
  if (parent.instanceable ||
      !std::all_of(parent.nodes.begin(), parent.nodes.end(), goes_deeper_alone)) {
    return false;
  }
  NodeGraph graph(*services.maps, *services.work);
  graph.reset(parent.nodes);
  if (!descend(graph, index.path, index)) {
    index.opinions.clear();
    return false;
  }
  drop_silent_nodes(graph, index);
  index.nodes.assign(graph.nodes());
  *services.node_count += index.nodes.size();
  count_index(services, index);
  compose_names(index);
  return true;
}

void count_index(const IndexServices& services, const PrimIndex& index) {
  std::size_t names = 0;
  for (const Opinion& opinion : index.opinions) {
    names += layer::Layer::children(*opinion.spec, layer::fields::primChildren).size() +
             layer::Layer::children(*opinion.spec, layer::fields::properties).size();
  }
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * index.opinions.size() +
                       names / kNamesForUnit);
}

}  // namespace tenon::compose
