// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Instances share their descendants. Opinions over arcs of the prim itself are shared; opinions of
// the prim and of its ancestors' arcs on what is below do not count.
#include "tenon/base/text/text_number.h"
#include "tenon/compose/indexer.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {
namespace {

/// Visits nodes strongest first, each with whether it can be shared: it has specs that count and
/// was brought in by an arc of this prim. `visit` returns true to go on below the node. Culled
/// subtrees are skipped.
template <class Visit>
void walk_shareable(const NodeGraph& graph, const Visit& visit) {
  NodeIds open(0);
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const Node& node = graph[id];
    if (node.culled || !visit(id, is_shareable(node))) {
      continue;
    }
    for (NodeId child = node.last_child; child != kNoNode; child = graph[child].previous_sibling) {
      open.push_back(child);
    }
  }
}

/// Stacks of one layer differ by where their expression variables come from.
std::string sources_of_variables(const LayerStack& stack) {
  std::string text;
  for (const LayerStack* at = stack.override_source; at != nullptr; at = at->override_source) {
    text += " @" + at->identifier() + "@";
  }
  return text;
}

bool composed_instanceable(const NodeGraph& graph) {
  for (const NodeId id : graph.subtree(0)) {
    if (!graph[id].has_opinions()) {
      continue;
    }
    for (const StackedLayer& stacked : graph[id].layer_stack->layers) {
      const layer::Spec* spec = stacked.layer->find(graph[id].path);
      const bool* value = spec == nullptr ? nullptr : spec->get<bool>(layer::fields::instanceable);
      if (value != nullptr) {
        return *value;
      }
    }
  }
  return false;
}

}  // namespace

bool is_shareable(const Node& node) {
  return node.arc != ArcKind::Root && node.due_to_direct_arc && node.has_specs && !node.inert;
}

bool is_instanceable(const NodeGraph& graph) {
  if (graph.size() < 2) {
    return false;
  }
  bool shares = false;
  walk_shareable(graph, [&](NodeId, bool shareable) {
    shares = shares || shareable;
    return !shares;
  });
  return shares && composed_instanceable(graph);
}

void disable_unshared_nodes(NodeGraph& graph) {
  NodeIds unshared;
  walk_shareable(graph, [&](NodeId id, bool shareable) {
    if (!shareable) {
      unshared.push_back(id);
    }
    return !shareable;
  });
  for (const NodeId id : unshared) {
    graph.set_inert(id, true);
  }
}

std::string instance_key(const NodeGraph& graph, bool has_payloads) {
  std::string key;
  walk_shareable(graph, [&](NodeId id, bool shareable) {
    if (shareable) {
      const Node& node = graph[id];
      const layer::LayerOffset& offset = node.map_to_root->offset();
      key += std::to_string(static_cast<int>(node.arc)) + " @" + node.layer_stack->identifier() +
             "@<" + node.path.str() + "> " + shortest(offset.offset) + " " +
             shortest(offset.scale) + sources_of_variables(*node.layer_stack) + "\n";
    }
    // Payloads that are or are not included tell instances apart wherever they are.
    return !shareable || has_payloads;
  });
  std::map<std::string, std::string> selections;
  for (const NodeId id : graph.subtree(0)) {
    if (graph[id].has_opinions()) {
      add_variant_selections(*graph[id].layer_stack, graph[id].path, selections);
    }
  }
  for (const auto& [set, selection] : selections) {
    key += set + "=" + selection + "\n";
  }
  return key;
}

}  // namespace tenon::compose
