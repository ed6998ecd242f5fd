// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/build_index.h"

#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kIndexUnits = 120;  // of work for an index, which is kept
constexpr std::size_t kOpinionUnits = 4;  // for each of its opinions
constexpr std::size_t kNamesForUnit = 4;  // names listed by its opinions

/// Specs of every contributing node, strongest first.
void collect_opinions(PrimIndex& index) {
  for (std::uint32_t id = 0; id < index.nodes.size(); ++id) {
    const Node& node = index.nodes[id];
    if (!node.can_contribute() || !node.has_specs) {
      continue;
    }
    for (const StackedLayer& stacked : node.layer_stack->layers) {
      if (const layer::Spec* spec = stacked.layer->find(node.path)) {
        index.opinions.push_back({stacked.layer.get(), spec, node.path, id,
                                  node.map_to_root->offset() * stacked.offset});
      }
    }
  }
}

/// What is kept of an index, and what the names of its opinions take to combine.
void count_work(const IndexServices& services, const PrimIndex& index) {
  std::size_t names = 0;
  for (const Opinion& opinion : index.opinions) {
    names += layer::Layer::children(*opinion.spec, layer::fields::primChildren).size() +
             layer::Layer::children(*opinion.spec, layer::fields::properties).size();
  }
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * index.opinions.size() +
                       names / kNamesForUnit);
}

void collect_selections(PrimIndex& index) {
  for (const Node& node : index.nodes) {
    if (node.path.is_variant_selection()) {
      index.make_extras().variant_selections.emplace(node.path.name().str(),
                                                     node.path.variant().str());
    }
  }
}

/// Most prims: all opinions are in the root layer stack and no arc starts here. False when one
/// does. When there has been too much work, arcs count no more: what remains is as large as the
/// layers of the root stack.
bool build_local_child(const IndexServices& services, const PrimIndex& parent, PrimIndex& index) {
  const bool no_more_arcs = services.work->exhausted();
  if (!no_more_arcs && (parent.nodes.size() != 1 || services.root_stack->has_relocates())) {
    return false;
  }
  services.work->count(kIndexUnits + index.path.depth() + kOpinionUnits * parent.opinions.size());
  AuthoredArcs arcs;
  for (const Opinion& above : parent.opinions) {
    const layer::Spec* const spec = above.node == 0 ? above.layer->find(index.path) : nullptr;
    if (spec != nullptr) {
      arcs.add(*spec);
      index.opinions.push_back({above.layer, spec, index.path, 0, above.offset});
    }
  }
  if (arcs.any() && !no_more_arcs) {
    index.opinions.clear();
    return false;
  }
  index.nodes.push_back(parent.nodes.front());
  index.nodes.front().first_child = index.nodes.front().last_child = kNoNode;
  index.nodes.front().path = index.path;
  index.nodes.front().has_specs = !index.opinions.empty();
  if (index.opinions.size() == 1 && !index.opinions.front().spec->has(layer::fields::primOrder)) {
    const layer::Spec& spec = *index.opinions.front().spec;
    index.child_names = NameList(spec, layer::fields::primChildren);
    index.property_names = NameList(spec, layer::fields::properties);
  } else if (!index.opinions.empty()) {
    compose_child_names(index);
    compose_property_names(index);
  }
  return true;
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
  index.nodes.assign(graph.nodes());
  *services.node_count += index.nodes.size();
  collect_opinions(index);
  collect_selections(index);
  count_work(services, index);
  compose_child_names(index);
  compose_property_names(index);
}

}  // namespace

void build_root_index(const IndexServices& services, PrimIndex& index) {
  NodeGraph graph(*services.maps, *services.work);
  graph.reset(Site{services.root_stack, index.path});
  graph[0].has_specs = true;
  index.nodes.assign(graph.nodes());
  collect_opinions(index);
  compose_child_names(index);
  compose_property_names(index);
}

void build_child_index(const IndexServices& services, const PrimIndex& parent, PrimIndex& index) {
  if (!build_local_child(services, parent, index)) {
    build_with_arcs(services, index);
  }
}

}  // namespace tenon::compose
