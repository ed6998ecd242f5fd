// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Variants: which one a set contributes is decided by the strongest selection among all opinions
// that are known when everything else is expanded; without one by the fallbacks.
#include <algorithm>

#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kVisitUnits = 4;  // for a node that a path is carried to
constexpr std::size_t kMapUnits = 20;   // for each path that is carried across an arc

struct TranslatedPath {
  NodeId node;
  Path path;
};

/// `path` of a node in the namespace of the root, or of the furthest node that it has an image in.
TranslatedPath translate_to_root(const NodeGraph& graph, NodeId node, Path path) {
  TranslatedPath at{node, path.strip_variants()};
  const Path in_root = graph[node].map_to_root->map_source_to_target(at.path);
  if (!in_root.empty()) {
    at = {0, in_root};
  } else {
    while (at.node != 0) {
      const Path up = graph[at.node].map_to_parent->map_source_to_target(at.path);
      if (up.empty()) {
        break;
      }
      at = {graph[at.node].parent, up};
    }
  }
  return at;
}

/// Visits a node and what is below it, strongest first, with a path carried down across the arcs;
/// subtrees that the path has no image in are skipped. `visit` returns true to stop.
template <class Visit>
bool walk_down(const NodeGraph& graph, const TranslatedPath& from, const Visit& visit) {
  std::vector<TranslatedPath> open{from};
  while (!open.empty()) {
    const TranslatedPath at = open.back();
    open.pop_back();
    graph.count(kVisitUnits + 2 * graph[at.node].layer_stack->layers.size());
    if (visit(at.node, at.path)) {
      return true;
    }
    for (NodeId child = graph[at.node].last_child; child != kNoNode;
         child = graph[child].previous_sibling) {
      const MapFunction& map = *graph[child].map_to_parent;
      graph.count(kMapUnits + std::min(map.pairs().size(), kFewPairs) +
                  2 * std::size_t{at.path.depth()});
      const Path down = map.map_target_to_source(at.path);
      if (!down.empty()) {
        open.push_back({child, down});
      }
    }
  }
  return false;
}

/// Where a node's layer stack stores opinions on `path`: within the variant that the node is in.
Path storage_path(const NodeGraph& graph, NodeId node, Path path) {
  if (graph[node].arc != ArcKind::Variant) {
    return path;
  }
  const Path variant = graph.path_at_introduction(node);
  return path.replace_prefix(variant.strip_variants(), variant, false);
}

/// The set has been decided already: some node of the graph is its variant.
bool find_prior_selection(const NodeGraph& graph, const TranslatedPath& from,
                          const std::string& set, std::string* selection) {
  return walk_down(graph, from, [&](NodeId node, Path path) {
    if (graph[node].arc != ArcKind::Variant) {
      return false;
    }
    const Path variant = graph.path_at_introduction(node);
    if (!variant.is_variant_selection() || variant.name().str() != set || variant.prim() != path) {
      return false;
    }
    *selection = variant.variant().str();
    return true;
  });
}

bool find_authored_selection(Indexer& indexer, const TranslatedPath& from, const std::string& set,
                             std::string* selection) {
  const NodeGraph& graph = indexer.graph;
  return walk_down(graph, from, [&](NodeId node, Path path) {
    return can_contribute_at(graph[node], path) &&
           composed_variant_selection(*graph[node].layer_stack, storage_path(graph, node, path),
                                      set, selection, &indexer.errors);
  });
}

/// Many tasks ask for the same set; as long as the graph stays as it is, so does the answer. One
/// that comes with findings is found again, so that these are reported each time.
std::string selected_variant(Indexer& indexer, const Task& task) {
  const NodeGraph& graph = indexer.graph;
  const TranslatedPath from = translate_to_root(graph, task.node, task.set_path);
  Indexer::Selection& known = indexer.selections[{from.node, from.path, task.set_name}];
  if (known.revision == graph.revision()) {
    return known.variant;
  }
  std::string selection;
  const std::size_t findings = indexer.errors.size();
  if (!find_prior_selection(graph, from, task.set_name, &selection)) {
    find_authored_selection(indexer, from, task.set_name, &selection);
  }
  graph.count(kFindingUnits * (indexer.errors.size() - findings));
  if (indexer.errors.size() == findings) {
    known = {graph.revision(), selection};
  }
  return selection;
}

/// The first fallback that the set has a variant for; empty when there is none.
std::string fallback_variant(const Indexer& indexer, const Task& task) {
  const auto& fallbacks = indexer.services.options->variant_fallbacks;
  const auto found = fallbacks.find(task.set_name);
  if (found == fallbacks.end()) {
    return {};
  }
  const std::vector<std::string> options =
      variant_options(*indexer.graph[task.node].layer_stack, task.set_path, task.set_name);
  for (const std::string& fallback : found->second) {
    if (std::find(options.begin(), options.end(), fallback) != options.end()) {
      return fallback;
    }
  }
  return {};
}

/// Below a class arc of this level the same variant can be reached twice.
bool skips_duplicates(const NodeGraph& graph, NodeId node) {
  for (; graph[node].arc != ArcKind::Root; node = graph[node].parent) {
    if (is_class_based(graph[node].arc) && graph.depth_below_introduction(node) == 0 &&
        !graph[node].inert && !graph[node].culled) {
      return true;
    }
  }
  return false;
}

/// A variant that could bring in selections, itself or over arcs of its own.
bool may_select_variants(const LayerStack& stack, Path variant) {
  const AuthoredArcs arcs = authored_arcs(stack, variant);
  return arcs.references || arcs.inherits || arcs.specializes || arcs.payloads ||
         has_variant_selections(stack, variant);
}

void add_variant_arc(Indexer& indexer, const Task& task, const std::string& variant,
                     bool ancestral) {
  const Site site = indexer.graph.site(task.node);
  const Path variant_path = task.set_path.variant_selection(task.set_name, variant);
  Arc arc;
  arc.kind = ArcKind::Variant;
  arc.map_to_parent = indexer.services.maps->identity();
  arc.parent = arc.origin = task.node;
  arc.namespace_depth = namespace_depth_of(task.set_path);
  arc.sibling_number = task.set_number;
  ArcOptions options;
  options.include_ancestral = ancestral;
  options.skip_duplicates = ancestral && skips_duplicates(indexer.graph, task.node);
  const Path path = site.path.replace_prefix(task.set_path, variant_path, false);
  if (add_arc(indexer, arc, {site.layer_stack, path}, options) != kNoNode &&
      may_select_variants(*site.layer_stack, variant_path)) {
    indexer.graph.count(indexer.tasks.size() / 4);
    indexer.tasks.retry_variants();
  }
}

void add_set_tasks(Indexer& indexer, NodeId node, Path path, TaskKind kind) {
  std::uint16_t number = 0;
  for (std::string& set : composed_variant_sets(*indexer.graph[node].layer_stack, path)) {
    indexer.tasks.push(Task{kind, node, path, std::move(set), number++});
  }
}

}  // namespace

void eval_variant_sets(Indexer& indexer, NodeId node) {
  if (indexer.graph[node].can_contribute()) {
    add_set_tasks(indexer, node, indexer.graph[node].path, TaskKind::VariantAuthored);
  }
}

void eval_ancestral_variant_sets(Indexer& indexer, NodeId node) {
  for (Path path = indexer.graph[node].path.parent(); !path.empty() && !path.is_absolute_root();
       path = path.parent()) {
    if (!can_contribute_at(indexer.graph[node], path)) {
      continue;
    }
    add_set_tasks(indexer, node, path, TaskKind::AncestralVariantAuthored);
    if (path.is_variant_selection()) {
      return;  // sets further up are decided: this variant is one of theirs
    }
  }
}

void eval_authored_variant(Indexer& indexer, const Task& task, bool ancestral) {
  if (!can_contribute_at(indexer.graph[task.node], task.set_path)) {
    return;
  }
  const std::string selection = selected_variant(indexer, task);
  if (!selection.empty()) {
    return add_variant_arc(indexer, task, selection, ancestral);
  }
  Task later = task;
  later.kind = ancestral ? TaskKind::AncestralVariantFallback : TaskKind::VariantFallback;
  indexer.tasks.push(std::move(later));
}

void eval_fallback_variant(Indexer& indexer, const Task& task, bool ancestral) {
  if (!can_contribute_at(indexer.graph[task.node], task.set_path)) {
    return;
  }
  const std::string fallback = fallback_variant(indexer, task);
  if (!fallback.empty()) {
    return add_variant_arc(indexer, task, fallback, ancestral);
  }
  Task later = task;
  later.kind = ancestral ? TaskKind::AncestralVariantNone : TaskKind::VariantNone;
  indexer.tasks.push(std::move(later));
}

}  // namespace tenon::compose
