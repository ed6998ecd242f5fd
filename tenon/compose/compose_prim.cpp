// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The pass list of a prim index. A graph of sites starts from what the namespace parent has, one
// name deeper, and grows arc by arc: each new node puts the arcs that it authors onto a queue, the
// queue decides which is expanded next.
#include "tenon/compose/composition_error.h"
#include "tenon/compose/indexer.h"

namespace tenon::compose {
namespace {

constexpr std::size_t kTaskUnits = 8;
constexpr std::size_t kTextOfUnit = 2;  // bytes of its text

void run_task(Indexer& indexer, const Task& task) {
  switch (task.kind) {
    case TaskKind::NodeRelocates:
      return eval_node_relocates(indexer, task.node);
    case TaskKind::ImpliedRelocates:
      return eval_implied_relocates(indexer, task.node);
    case TaskKind::References:
      return eval_references(indexer, task.node);
    case TaskKind::Payloads:
      return eval_payloads(indexer, task.node);
    case TaskKind::Inherits:
      return eval_inherits(indexer, task.node);
    case TaskKind::Specializes:
      return eval_specializes(indexer, task.node);
    case TaskKind::ImpliedSpecializes:
      return eval_implied_specializes(indexer, task.node);
    case TaskKind::ImpliedClasses:
      return eval_implied_classes(indexer, task.node);
    case TaskKind::AncestralVariantSets:
      return eval_ancestral_variant_sets(indexer, task.node);
    case TaskKind::VariantSets:
      return eval_variant_sets(indexer, task.node);
    case TaskKind::AncestralVariantAuthored:
      return eval_authored_variant(indexer, task, true);
    case TaskKind::VariantAuthored:
      return eval_authored_variant(indexer, task, false);
    case TaskKind::AncestralVariantFallback:
      return eval_fallback_variant(indexer, task, true);
    case TaskKind::VariantFallback:
      return eval_fallback_variant(indexer, task, false);
    case TaskKind::UnresolvedPrimPath:
      return eval_unresolved_prim_path(indexer, task.node);
    case TaskKind::AncestralVariantNone:
    case TaskKind::VariantNone:
      return;  // only there to be retried
  }
}

/// The arcs that a task follows, where they are authored.
ArcPlace place_of(const NodeGraph& graph, const Task& task) {
  const Node& node = graph[task.node];
  switch (task.kind) {
    case TaskKind::References:
      return {node.layer_stack, node.path, ArcKind::Reference};
    case TaskKind::Payloads:
      return {node.layer_stack, node.path, ArcKind::Payload};
    case TaskKind::Inherits:
      return {node.layer_stack, node.path, ArcKind::Inherit};
    case TaskKind::Specializes:
      return {node.layer_stack, node.path, ArcKind::Specialize};
    case TaskKind::NodeRelocates:
      return {node.layer_stack, node.path, ArcKind::Relocate};
    case TaskKind::ImpliedRelocates:
    case TaskKind::ImpliedSpecializes:
    case TaskKind::ImpliedClasses:
    case TaskKind::UnresolvedPrimPath: {
      const NodeId authored = graph.origin_root(task.node).first;
      const NodeId parent = graph[authored].parent;
      return {graph[parent == kNoNode ? authored : parent].layer_stack,
              graph.introducing_path(authored), graph[authored].arc};
    }
    default:
      return {node.layer_stack, task.set_path.empty() ? node.path : task.set_path,
              ArcKind::Variant};
  }
}

void run_tasks(Indexer& indexer) {
  WorkMeter& work = *indexer.services.work;
  while (!indexer.tasks.empty() && !work.exhausted()) {
    const Task task = indexer.tasks.pop();
    const TaskTally tally(work, place_of(indexer.graph, task));
    work.count(kTaskUnits);
    run_task(indexer, task);
  }
}

/// Turns the graph of a prim into the start of its child's.
void descend(Indexer& indexer, Path child_path, bool parent_is_instance) {
  NodeGraph& graph = indexer.graph;
  if (parent_is_instance) {
    disable_unshared_nodes(graph);
  }
  graph.descend(child_path);
  indexer.has_payloads = false;
  indexer.payload_loaded = false;
  for (Node& node : graph.nodes()) {
    graph.count(node.has_specs ? node.layer_stack->layers.size() : 0);
    node.has_specs = node.has_specs && node.layer_stack->has_spec(node.path);
  }
}

/// Arcs that a level of namespace adds to what came from above.
void expand_level(Indexer& indexer, bool root_contributes) {
  if (!root_contributes) {
    indexer.graph.set_inert(0, true);
  }
  if (elide_if_prohibited(indexer)) {
    return;
  }
  add_root_tasks(indexer);
  run_tasks(indexer);
}

void start_from_site(Indexer& indexer, const Site& site) {
  indexer.graph.reset(site);
  indexer.graph[0].has_specs = site.layer_stack->has_spec(site.path);
}

/// A variant's site is not built from its parent: the arc that leads here has seen to that.
void build_variant_site(Indexer& indexer, const Site& site, bool contributes) {
  start_from_site(indexer, site);
  indexer.graph.set_inert(0, !contributes);
  add_root_tasks(indexer);
  run_tasks(indexer);
}

/// Whether the prim at `site`, whose graph is there, is an instance. The graph of an ancestor of
/// the stage prim may lack what the outer graph has already; its finished index knows.
bool is_instance(const Indexer& indexer, const Site& site) {
  const bool is_above = site.path != indexer.root_prim && indexer.root_prim.has_prefix(site.path);
  return is_above && site.layer_stack == indexer.services.root_stack
             ? indexer.services.index(site.path).instanceable
             : is_instanceable(indexer.graph);
}

void build_from_top(Indexer& indexer, const Site& site, bool root_contributes) {
  std::vector<Path> levels;
  Path top = site.path;
  for (; top.is_prim(); top = top.parent()) {
    levels.push_back(top);
  }
  if (top.is_variant_selection()) {
    build_variant_site(indexer, {site.layer_stack, top}, levels.empty() ? root_contributes : true);
  } else {
    start_from_site(indexer, {site.layer_stack, top});
  }
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    descend(indexer, *level, is_instance(indexer, {site.layer_stack, level->parent()}));
    expand_level(indexer, *level == site.path ? root_contributes : true);
  }
}

}  // namespace

void Indexer::report(std::string_view error_class, const layer::Layer* layer, Path spec,
                     const Message& message, std::string fix, StatementPart part) {
  services.work->count(kFindingUnits + message.text().size() / kTextOfUnit);
  errors.add(composition_error(error_class, Severity::Error,
                               {layer, spec, root_prim, std::move(part)}, message, std::move(fix)));
}

void build_graph(Indexer& indexer, const Site& site, bool root_contributes) {
  if (!indexer.is_outermost()) {
    return build_from_top(indexer, site, root_contributes);
  }
  if (!site.path.is_prim()) {
    return start_from_site(indexer, site);
  }
  const PrimIndex& parent = indexer.services.index(site.path.parent());
  indexer.graph.reset(parent.nodes());
  descend(indexer, site.path, parent.instanceable);
  expand_level(indexer, root_contributes);
}

}  // namespace tenon::compose
