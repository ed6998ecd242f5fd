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
  const Opinions opinions = index.opinions();
  if (opinions.size() == 1 && !opinions.front().spec->has(layer::fields::primOrder)) {
    const layer::Spec& spec = *opinions.front().spec;
    index.child_names = NameList(spec, layer::fields::primChildren);
    index.set_property_names(NameList(spec, layer::fields::properties));
  } else if (!opinions.empty()) {
    compose_child_names(index);
    compose_property_names(index);
  }
}

bool goes_deeper_alone(const Node& node) {
  return node.arc != ArcKind::Relocate && !node.layer_stack->has_relocates();
}

/// Takes the nodes one name deeper and gathers what the layers say there. False where an arc
/// starts.
bool descend(NodeGraph& graph, const Path child, OpinionDraft& found) {
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
        found.push_back(Opinion::of(id, node, stacked, number));
        arcs.add(stacked.layer->numbered_spec(number));
      }
    }
  }
  return !arcs.any();
}

/// Drops nodes that say nothing here. The others keep their order, and so do the opinions, which
/// are told where their nodes are now.
void drop_silent_nodes(NodeGraph& graph, OpinionDraft& opinions) {
  const auto has_opinions = [](const Node& node) { return node.has_opinions(); };
  if (std::all_of(graph.nodes().begin() + 1, graph.nodes().end(), has_opinions)) {
    graph.count(kKeptUnits * graph.size());
    return;
  }
  cull_without_opinions(graph);
  graph.finalize();
  NodeId before = kNoNode;
  NodeId now = kNoNode;
  for (Opinion& opinion : opinions) {
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
  if (!no_more_arcs && (parent.nodes().size() != 1 || services.root_stack->has_relocates())) {
    return false;
  }
  const Opinions above = parent.opinions();
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * above.size());
  AuthoredArcs arcs;
  OpinionDraft found;
  for (const Opinion& opinion : above) {
    const std::uint32_t number = opinion.node == 0 ? opinion.layer->number_of(index.path) : 0;
    if (number != 0) {
      const layer::Spec& spec = opinion.layer->numbered_spec(number);
      arcs.add(spec);
      found.push_back({opinion.layer, &spec, index.path, 0, number, opinion.offset});
    }
  }
  if (arcs.any() && !no_more_arcs) {
    return false;
  }
  set_opinions(services, found, index);
  const bool has_specs = !found.empty();
  const Node* like = parent.kept_nodes.like();
  if (like == nullptr || like->has_specs != has_specs) {
    Node node = parent.nodes().front();
    node.first_child = node.last_child = kNoNode;
    node.has_specs = has_specs;
    like = services.maps->like(node);
  }
  index.kept_nodes.be_like(*like);
  compose_names(index);
  return true;
}

bool build_child_below_arcs(const IndexServices& services, const PrimIndex& parent,
                            PrimIndex& index) {
  const Nodes nodes = parent.nodes();
  if (parent.instanceable || !std::ranges::all_of(nodes, goes_deeper_alone)) {
    return false;
  }
  NodeGraph graph(*services.maps, *services.work);
  graph.reset(nodes);
  OpinionDraft found;
  if (!descend(graph, index.path, found)) {
    return false;
  }
  drop_silent_nodes(graph, found);
  index.kept_nodes.assign(graph.nodes());
  set_opinions(services, found, index);
  *services.node_count += index.nodes().size();
  count_index(services, index);
  compose_names(index);
  return true;
}

void count_index(const IndexServices& services, const PrimIndex& index) {
  std::size_t names = 0;
  const Opinions opinions = index.opinions();
  for (const Opinion& opinion : opinions) {
    names += layer::Layer::children(*opinion.spec, layer::fields::primChildren).size() +
             layer::Layer::children(*opinion.spec, layer::fields::properties).size();
  }
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * opinions.size() +
                       names / kNamesForUnit);
}

}  // namespace tenon::compose
