// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// A payload is a reference that is included only when the load rules say so. They name stage prims,
// so the path of the node that has the payload is mapped up to the stage first.
#include "tenon/compose/indexer.h"
#include "tenon/compose/load_rules.h"

namespace tenon::compose {
namespace {

/// Internal arcs map everything outside to itself; that is no way to the stage's namespace.
Path map_over(const MapFunction& map, ArcKind kind, Path path) {
  const bool internal =
      map.has_root_identity() && (kind == ArcKind::Reference || kind == ArcKind::Payload);
  return internal ? map.without_root_identity().map_source_to_target(path)
                  : map.map_source_to_target(path);
}

Path map_to_root(const NodeGraph& graph, NodeId id, Path path) {
  const MapFunction& to_root = *graph[id].map_to_root;
  Path mapped = to_root.map_source_to_target(path);
  if (mapped == path && to_root.has_root_identity()) {
    for (; !mapped.empty() && id != 0; id = graph[id].parent) {
      mapped = map_over(*graph[id].map_to_parent, graph[id].arc, mapped);
    }
  }
  return mapped;
}

/// Empty when the node is there only because of a path that the stage cannot name.
Path stage_path(const Indexer& indexer, NodeId node, Path path) {
  Path mapped = map_to_root(indexer.graph, node, path.strip_variants());
  for (const Frame* frame = indexer.frame; frame != nullptr && !mapped.empty();
       frame = frame->previous) {
    mapped = map_over(*frame->arc->map_to_parent, frame->arc->kind, mapped);
    if (!mapped.empty()) {
      mapped = map_to_root(*frame->graph, frame->parent, mapped);
    }
  }
  return mapped;
}

}  // namespace

void eval_payloads(Indexer& indexer, NodeId node) {
  const Site site = indexer.graph.site(node);
  if (!indexer.graph[node].can_contribute()) {
    return;
  }
  const std::vector<AssetArc> arcs =
      composed_payloads(*site.layer_stack, site.path, asset_identity(indexer), &indexer.errors);
  if (arcs.empty()) {
    return;
  }
  indexer.has_payloads = true;
  const Path path = stage_path(indexer, node, site.path);
  if (!path.empty() && !is_loaded(*indexer.services.options, path)) {
    return;
  }
  indexer.payload_loaded = true;
  add_asset_arcs(indexer, node, ArcKind::Payload, arcs);
}

}  // namespace tenon::compose
