// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/build_index.h"

#include "tenon/compose/plain_prims.h"
#include "tenon/compose/twins/twins.h"

namespace tenon::compose {
namespace {

/// Specs of every contributing node, strongest first.
void collect_opinions(const IndexServices& services, PrimIndex& index) {
  OpinionDraft found;
  for (std::uint32_t id = 0; id < index.nodes().size(); ++id) {
    const Node& node = index.nodes()[id];
    if (!node.has_opinions()) {
      continue;
    }
    for (const StackedLayer& stacked : node.layer_stack->layers) {
      if (const std::uint32_t number = stacked.layer->number_of(node.path)) {
        found.push_back(Opinion::of(id, node, stacked, number));
      }
    }
  }
  set_opinions(services, found, index);
}

void collect_selections(PrimIndex& index) {
  for (const Node& node : index.nodes()) {
    if (node.path.is_variant_selection()) {
      index.make_extras().variant_selections.emplace(node.path.name().str(),
                                                     node.path.variant().str());
    }
  }
}

void build_with_arcs(const IndexServices& services, PrimIndex& index) {
  NodeGraph graph(*services.maps, *services.work);
  Diagnostics errors;
  Indexer indexer(services, nullptr, graph, errors);
  indexer.root_prim = index.path;
  build_graph(indexer, {services.root_stack, index.path}, true);
  cull_without_opinions(graph);
  index.instanceable = is_instanceable(graph);
  index.has_payloads = indexer.has_payloads;
  index.payload_loaded = indexer.payload_loaded;
  graph.finalize();
  if (index.instanceable) {
    index.make_extras().instance_key = instance_key(graph, index.has_payloads);
  }
  if (!errors.empty()) {
    index.make_extras().errors = std::move(errors);
  }
  index.kept_nodes.assign(graph.nodes());
  *services.node_count += index.nodes().size();
  collect_opinions(services, index);
  collect_selections(index);
  count_index(services, index);
  compose_child_names(index);
  compose_property_names(index);
}

void build_non_local_child(const IndexServices& services, const PrimIndex& parent,
                           PrimIndex& index) {
  if (!build_child_below_arcs(services, parent, index)) {
    build_with_arcs(services, index);
  }
}

}  // namespace

void set_opinions(const IndexServices& services, std::span<const Opinion> found, PrimIndex& index) {
  index.set_opinions(found, found.size() == 1 ? services.maps->like(found.front()) : nullptr);
}

void build_root_index(const IndexServices& services, PrimIndex& index) {
  NodeGraph graph(*services.maps, *services.work);
  graph.reset(Site{services.root_stack, index.path});
  graph[0].has_specs = true;
  index.kept_nodes.assign(graph.nodes());
  collect_opinions(services, index);
  compose_child_names(index);
  compose_property_names(index);
}

void build_child_index(const IndexServices& services, const PrimIndex& parent, PrimIndex& index) {
  if (build_local_child(services, parent, index)) {
    return;
  }
  if (services.twins == nullptr) {
    build_non_local_child(services, parent, index);
  } else if (!services.twins->take_over(services, parent, index)) {
    services.twins->compose(services, parent, index, build_non_local_child);
  }
}

}  // namespace tenon::compose
