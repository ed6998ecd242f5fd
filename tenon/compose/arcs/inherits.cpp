// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/indexer.h"
#include "tenon/layer/fields.h"

namespace tenon::compose {

void eval_inherits(Indexer& indexer, NodeId node) {
  add_class_arcs(indexer, node, ArcKind::Inherit, layer::fields::inheritPaths);
}

}  // namespace tenon::compose
