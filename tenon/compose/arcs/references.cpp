// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/indexer.h"

namespace tenon::compose {

void eval_references(Indexer& indexer, NodeId node) {
  const Site site = indexer.graph.site(node);
  if (!indexer.graph[node].can_contribute()) {
    return;
  }
  add_asset_arcs(
      indexer, node, ArcKind::Reference,
      composed_references(*site.layer_stack, site.path, asset_identity(indexer), &indexer.errors));
}

}  // namespace tenon::compose
