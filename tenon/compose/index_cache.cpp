// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/index_cache.h"

#include <algorithm>
#include <deque>
#include <tuple>
#include <unordered_map>

#include "tenon/compose/indexer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

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

void collect_selections(PrimIndex& index) {
  for (const Node& node : index.nodes) {
    if (node.path.is_variant_selection()) {
      index.variant_selections.emplace(node.path.name().str(), node.path.variant().str());
    }
  }
}

struct StackKey {
  const layer::Layer* root = nullptr;
  const LayerStack* variables = nullptr;
  bool operator==(const StackKey&) const = default;
};

struct StackKeyHash {
  std::size_t operator()(const StackKey& key) const {
    return std::hash<const void*>{}(key.root) * 31 + std::hash<const void*>{}(key.variables);
  }
};

}  // namespace

struct IndexCache::State {
  LayerOpener opener;
  ComposeOptions options;
  MapPool maps;
  std::size_t node_count = 0;
  LayerStackPtr root_stack;
  std::unordered_map<StackKey, LayerStackPtr, StackKeyHash> stacks;
  std::vector<LayerStackPtr> stacks_in_order;
  std::unordered_map<const layer::Layer*,
                     std::unordered_map<std::string, Result<layer::LayerPtr>>>
      opened;
  std::deque<PrimIndex> indices;
  std::unordered_map<Path, const PrimIndex*> by_path;
  Diagnostics errors;
  std::vector<MissingArc> missing;
  std::set<std::tuple<std::string, Path, std::string, std::string>> known_missing;
  IndexServices services;

  void add_missing(MissingArc arc) {
    if (known_missing.emplace(arc.layer, arc.prim, arc.arc, arc.path).second) {
      missing.push_back(std::move(arc));
    }
  }

  Result<layer::LayerPtr> open(const std::string& asset_path, const layer::Layer& anchor) {
    auto& of_layer = opened[&anchor];
    const auto found = of_layer.find(asset_path);
    if (found != of_layer.end()) {
      return found->second;
    }
    Result<layer::LayerPtr> result = opener(asset_path, anchor);
    of_layer.emplace(asset_path, result);
    return result;
  }

  LayerStackPtr build_stack(const layer::LayerPtr& root, const layer::LayerPtr& session,
                            const LayerStack* variables) {
    LayerStackInputs inputs;
    inputs.root = root;
    inputs.session = session;
    const LayerOpener open_once = [this](const std::string& path, const layer::Layer& anchor) {
      return open(path, anchor);
    };
    inputs.opener = &open_once;
    inputs.muted = &options.muted;
    inputs.override_source = variables;
    LayerStackPtr stack = build_layer_stack(inputs);
    errors.append(stack->errors);
    for (const MissingArc& arc : stack->missing) {
      add_missing(arc);
    }
    stacks_in_order.push_back(stack);
    return stack;
  }

  const LayerStack* referenced_stack(const layer::LayerPtr& root, const LayerStack* from) {
    const StackKey key{root.get(), from->expression_source};
    LayerStackPtr& stack = stacks[key];
    if (stack == nullptr) {
      stack = build_stack(root, nullptr, from->expression_source);
    }
    return stack.get();
  }

  PrimIndex& add_index(Path path) {
    indices.emplace_back();
    indices.back().path = path;
    by_path.emplace(path, &indices.back());
    return indices.back();
  }

  const PrimIndex& compute_root();
  const PrimIndex& compute_child(const PrimIndex& parent, Path path);
  bool compute_local_child(const PrimIndex& parent, PrimIndex& index);
  void compute_with_arcs(PrimIndex& index);
};

/// The pseudo-root has no arcs.
const PrimIndex& IndexCache::State::compute_root() {
  PrimIndex& index = add_index(Path::absolute_root());
  NodeGraph graph(maps);
  graph.reset(Site{root_stack.get(), index.path});
  graph[0].has_specs = true;
  index.nodes = std::move(graph.nodes());
  collect_opinions(index);
  compose_child_names(index);
  compose_property_names(index);
  return index;
}

/// Most prims: all opinions are in the root layer stack and no arc starts here. False when one
/// does.
bool IndexCache::State::compute_local_child(const PrimIndex& parent, PrimIndex& index) {
  if (parent.nodes.size() != 1 || root_stack->has_relocates()) {
    return false;
  }
  AuthoredArcs arcs;
  index.opinions.reserve(parent.opinions.size());
  for (const Opinion& above : parent.opinions) {
    if (const layer::Spec* spec = above.layer->find(index.path)) {
      arcs.add(*spec);
      index.opinions.push_back({above.layer, spec, index.path, 0, above.offset});
    }
  }
  if (arcs.any()) {
    index.opinions.clear();
    return false;
  }
  index.nodes.push_back(parent.nodes.front());
  index.nodes.front().path = index.path;
  index.nodes.front().has_specs = !index.opinions.empty();
  if (index.opinions.size() == 1 &&
      !index.opinions.front().spec->has(layer::fields::primOrder)) {
    const layer::Spec& spec = *index.opinions.front().spec;
    index.child_names = layer::Layer::children(spec, layer::fields::primChildren);
    index.property_names = layer::Layer::children(spec, layer::fields::properties);
  } else if (!index.opinions.empty()) {
    compose_child_names(index);
    compose_property_names(index);
  }
  return true;
}

void IndexCache::State::compute_with_arcs(PrimIndex& index) {
  NodeGraph graph(maps);
  Indexer indexer(services, nullptr, graph, index.errors);
  indexer.root_prim = index.path;
  build_graph(indexer, {root_stack.get(), index.path}, true);
  cull_without_opinions(graph);
  index.instanceable = is_instanceable(graph);
  index.has_payloads = indexer.has_payloads;
  index.payload_loaded = indexer.payload_loaded;
  graph.finalize();
  if (index.instanceable) {
    index.instance_key = instance_key(graph, index.has_payloads);
  }
  index.nodes = std::move(graph.nodes());
  node_count += index.nodes.size();
  collect_opinions(index);
  collect_selections(index);
  compose_child_names(index);
  compose_property_names(index);
}

const PrimIndex& IndexCache::State::compute_child(const PrimIndex& parent, Path path) {
  // The index is entered only when done: what it is built from never asks for it.
  PrimIndex& index = add_index(path);
  if (!compute_local_child(parent, index)) {
    compute_with_arcs(index);
  }
  return index;
}

IndexCache::IndexCache(layer::LayerPtr root, layer::LayerPtr session, LayerOpener opener,
                       ComposeOptions options)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.opener = std::move(opener);
  state.options = std::move(options);
  state.root_stack = state.build_stack(root, session, nullptr);
  if (session == nullptr && state.options.shares_root_stack) {
    state.stacks.emplace(StackKey{root.get(), state.root_stack.get()}, state.root_stack);
  }
  state.services.maps = &state.maps;
  state.services.options = &state.options;
  state.services.root_stack = state.root_stack.get();
  state.services.node_count = &state.node_count;
  state.services.index = [this](Path path) -> const PrimIndex& { return index(path); };
  state.services.open = [&state](const std::string& path, const layer::Layer& anchor) {
    return state.open(path, anchor);
  };
  state.services.missing = [&state](MissingArc arc) { state.add_missing(std::move(arc)); };
  state.services.stack = [&state](const layer::LayerPtr& layer, const LayerStack* from) {
    return state.referenced_stack(layer, from);
  };
}

IndexCache::~IndexCache() = default;

const LayerStackPtr& IndexCache::layer_stack() const { return state_->root_stack; }

const PrimIndex& IndexCache::index(Path prim_path) {
  std::vector<Path> missing;
  const PrimIndex* found = nullptr;
  for (Path path = prim_path; found == nullptr; path = path.parent()) {
    const auto it = state_->by_path.find(path);
    if (it != state_->by_path.end()) {
      found = it->second;
    } else if (path.is_absolute_root()) {
      found = &state_->compute_root();
    } else {
      missing.push_back(path);
    }
  }
  for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
    found = &state_->compute_child(*found, *it);
  }
  return *found;
}

const PrimIndex& IndexCache::child_index(const PrimIndex& parent, Token name) {
  const Path path = parent.path.child(name);
  const auto it = state_->by_path.find(path);
  return it != state_->by_path.end() ? *it->second : state_->compute_child(parent, path);
}

const Diagnostics& IndexCache::errors() const { return state_->errors; }

const std::vector<MissingArc>& IndexCache::missing_arcs() const { return state_->missing; }

std::vector<layer::LayerPtr> IndexCache::used_layers() const {
  std::vector<layer::LayerPtr> layers;
  for (const LayerStackPtr& stack : state_->stacks_in_order) {
    for (const StackedLayer& stacked : stack->layers) {
      layers.push_back(stacked.layer);
    }
  }
  const auto by_identifier = [](const layer::LayerPtr& a, const layer::LayerPtr& b) {
    return a->identifier() < b->identifier();
  };
  std::sort(layers.begin(), layers.end(), by_identifier);
  layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
  return layers;
}

}  // namespace tenon::compose
