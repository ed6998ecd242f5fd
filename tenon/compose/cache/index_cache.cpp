// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Indices are made on demand, each after its parent's, and stay where they are so that
// references to them hold. Two threads may build indices ahead. These count only when they are
// asked for, in the order of asking, and once a bound of nodes or work may be reached with one, it
// and all after it are built again. So the same arcs are skipped as without building ahead. Layer
// stacks are shared by root layer and source of expression variables; each asset path is opened
// once for each anchor layer.
#include "tenon/compose/cache/index_cache.h"

#include <algorithm>
#include <deque>
#include <tuple>
#include <unordered_map>

#include "tenon/base/containers/stable_list.h"
#include "tenon/base/paths/path_numbers.h"
#include "tenon/compose/build_index.h"
#include "tenon/compose/cache/build_ahead.h"
#include "tenon/compose/composition_error.h"
#include "tenon/compose/twins/twins.h"

namespace tenon::compose {

struct IndexCache::State {
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

  LayerOpener opener;
  ComposeOptions options;
  MapPool maps;
  std::size_t node_count = 0;
  WorkMeter work;
  ArcCosts arc_costs;
  bool work_reported = false;
  std::set<const layer::Layer*> measured;  // layers whose specs allow for work
  std::size_t specs = 0;                   // of these
  LayerStackPtr root_stack;
  std::unordered_map<StackKey, LayerStackPtr, StackKeyHash> stacks;
  std::vector<LayerStackPtr> stacks_in_order;
  std::unordered_map<const layer::Layer*, std::unordered_map<std::string, Result<layer::LayerPtr>>>
      opened;
  StableList<IndexAhead> indices;
  PathNumbers by_path;             // of indices
  std::deque<IndexBatch> batches;  // what indices that were built ahead point into
  bool at_limit = false;           // what was built ahead is of no use any more
  bool ahead_full = false;         // the work that building ahead may take is done
  Diagnostics errors;
  std::vector<MissingArc> missing;
  std::set<std::tuple<std::string, Path, std::string, std::string>> known_missing;
  Twins twins;
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
    if (result && *result != nullptr) {
      allow_for(**result);
    }
    return result;
  }

  void allow_for(const layer::Layer& layer) {
    if (measured.insert(&layer).second) {
      specs += layer.spec_count();
      const std::size_t most = WorkMeter::kUnlimited / 2;
      const std::size_t per_spec = std::max<std::size_t>(options.max_work_per_spec, 1);
      const std::size_t more = std::min(specs, most / per_spec) * options.max_work_per_spec;
      work.set_max(std::min(options.max_work, most) + more);
    }
  }

  LayerStackPtr build_stack(layer::LayerPtr root, layer::LayerPtr session,
                            const LayerStack* variables) {
    LayerStackInputs inputs;
    inputs.root = std::move(root);
    inputs.session = std::move(session);
    const LayerOpener open_once = [this](const std::string& path, const layer::Layer& anchor) {
      return open(path, anchor);
    };
    inputs.opener = &open_once;
    inputs.muted = &options.muted;
    inputs.override_source = variables;
    inputs.work = &work;
    const std::size_t work_before = work.done();
    LayerStackPtr stack = build_layer_stack(inputs);
    work.note_once(work.done() - work_before);
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

  auto path_of() const {
    return [this](std::uint32_t number) { return indices[number - 1].index.path; };
  }
  /// nullptr where none is known.
  const IndexAhead* find(Path path) const {
    const std::uint32_t number = by_path.find(path, path_of());
    return number == 0 ? nullptr : &indices[number - 1];
  }

  PrimIndex& add_index(Path path) {
    IndexAhead& added = indices.emplace_back();
    added.index.path = path;
    by_path.put(path, static_cast<std::uint32_t>(indices.size()), path_of());
    return added.index;
  }

  const PrimIndex& compute_root() {
    PrimIndex& index = add_index(Path::absolute_root());
    build_root_index(services, index);
    return index;
  }

  const PrimIndex& compute_child(const PrimIndex& parent, Path path) {
    // The index is entered before it is built: what it is built from never asks for it.
    PrimIndex& index = add_index(path);
    build_child_index(services, parent, index);
    if (work.has_costs()) {
      arc_costs.add(work.costs());
      work.clear_costs();
    }
    if (work.exhausted() && !work_reported) {
      work_reported = true;
      report_work(index);
    }
    return index;
  }

  void add_costs_ahead(const IndexAhead* ahead) {
    for (const IndexBatch& batch : batches) {
      const auto found = batch.costs.empty() ? batch.costs.end() : batch.costs.find(ahead);
      if (found != batch.costs.end()) {
        return arc_costs.add(found->second);
      }
    }
  }

  void report_work(PrimIndex& index) const {
    const Message costly = arc_costs.most_costly(work.done());
    Diagnostic found = composition_error(
        error_class::kWorkExceeded, Severity::Error,
        {root_stack->root.get(), index.path, index.path},
        "composition takes more than " + std::to_string(work.most()) +
            " units of work (kComposeWork); arcs from here on are skipped" +
            (costly.text().empty() ? "" : "; " + costly),
        "reduce the arcs that multiply with each other, make instances of what they bring in, or "
        "allow more with --max-work");
    index.make_extras().errors.add(std::move(found));
  }

  const PrimIndex* find_index(Path path) const {
    const IndexAhead* const found = find(path);
    return found == nullptr ? nullptr : &found->index;
  }

  const Result<layer::LayerPtr>* find_layer(const std::string& asset_path,
                                            const layer::Layer& anchor) const {
    const auto of_layer = opened.find(&anchor);
    if (of_layer == opened.end()) {
      return nullptr;
    }
    const auto found = of_layer->second.find(asset_path);
    return found == of_layer->second.end() ? nullptr : &found->second;
  }

  const LayerStack* find_stack(const layer::LayerPtr& root, const LayerStack* from) const {
    const auto found = stacks.find({root.get(), from->expression_source});
    return found == stacks.end() ? nullptr : found->second.get();
  }

  /// Keeps what was built ahead until it is asked for. True when nothing was skipped.
  bool take(std::vector<IndexBatch> built) {
    bool complete = true;
    std::size_t count = indices.size();
    for (const IndexBatch& batch : built) {
      complete = complete && batch.complete;
      ahead_full = ahead_full || batch.full;
      count += batch.indices.size();
    }
    by_path.reserve(count, path_of());
    for (IndexBatch& batch : built) {
      for (std::size_t at = indices.take_rows(std::move(batch.indices)); at < indices.size();
           ++at) {
        const auto number = static_cast<std::uint32_t>(at + 1);
        by_path.find_or_put(indices[at].index.path, number, path_of());
      }
      batches.push_back(std::move(batch));
    }
    return complete;
  }

  /// The index of a child of a prim that was asked for before. One that was built ahead counts from
  /// now on.
  const PrimIndex& ask_child(const PrimIndex& parent, Path path) {
    const std::uint32_t number = by_path.find(path, path_of());
    if (number == 0) {
      return compute_child(parent, path);
    }
    IndexAhead& known = indices[number - 1];
    if (known.waits) {
      at_limit = at_limit || node_count + known.node_count >= options.max_nodes ||
                 known.work >= work.most() - std::min(work.done(), work.most());
      if (at_limit) {
        return compute_child(parent, path);
      }
      node_count += known.node_count;
      work.count(known.work);
      add_costs_ahead(&known);
      known.waits = false;
    }
    return known.index;
  }
};

IndexCache::IndexCache(layer::LayerPtr root, layer::LayerPtr session, LayerOpener opener,
                       ComposeOptions options)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.opener = std::move(opener);
  state.options = std::move(options);
  state.allow_for(*root);
  if (session != nullptr) {
    state.allow_for(*session);
  }
  const layer::Layer* root_layer = root.get();
  const bool shares_root_stack = session == nullptr && state.options.shares_root_stack;
  state.root_stack = state.build_stack(std::move(root), std::move(session), nullptr);
  if (shares_root_stack) {
    state.stacks.emplace(State::StackKey{root_layer, state.root_stack.get()}, state.root_stack);
  }
  state.services.maps = &state.maps;
  state.services.options = &state.options;
  state.services.root_stack = state.root_stack.get();
  state.services.node_count = &state.node_count;
  state.services.work = &state.work;
  state.services.twins = state.options.shares_twins ? &state.twins : nullptr;
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
    const IndexAhead* const known = state_->find(path);
    if (known != nullptr && !known->waits) {
      found = &known->index;
    } else if (path.is_absolute_root()) {
      found = &state_->compute_root();
    } else {
      missing.push_back(path);
    }
  }
  for (auto it = missing.rbegin(); it != missing.rend(); ++it) {
    found = &state_->ask_child(*found, *it);
  }
  return *found;
}

const PrimIndex& IndexCache::child_index(const PrimIndex& parent, Token name) {
  return state_->ask_child(parent, parent.path.child(name));
}

bool IndexCache::build_below(const std::vector<const PrimIndex*>& roots,
                             const Function<bool(const PrimIndex&)>& enters, std::size_t most) {
  const State& state = *state_;
  if (state.at_limit || state.ahead_full) {
    return false;
  }
  KnownIndices known;
  known.options = &state.options;
  known.root_stack = state.root_stack.get();
  known.maps = &state.maps;
  known.node_count = state.node_count;
  known.work_done = state.work.done();
  // Each of two threads gets half of the rest: work without a request is wasted.
  const std::size_t left = state.work.most() - std::min(known.work_done, state.work.most());
  known.max_work = known.work_done + left / 2;
  known.max_indices = most;
  known.index = [&state](Path path) { return state.find_index(path); };
  known.layer = [&state](const std::string& path, const layer::Layer& anchor) {
    return state.find_layer(path, anchor);
  };
  known.stack = [&state](const layer::LayerPtr& layer, const LayerStack* from) {
    return state.find_stack(layer, from);
  };
  known.enters = enters;
  return state_->take(build_ahead(known, roots));
}

const Diagnostics& IndexCache::errors() const { return state_->errors; }

std::size_t IndexCache::work() const { return state_->work.done(); }

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
