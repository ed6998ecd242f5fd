// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/compose/node_graph.h"

/// Which of two nodes is stronger. Core Spec 1.0.1 section 10.4: kind of arc, then how deep in
/// namespace it was introduced, then what it originates from, then its place in its list.
namespace tenon::compose {

/// Negative when sibling `a` is stronger, positive when `b` is, 0 when they are the same.
int compare_siblings(const NodeGraph& graph, NodeId a, NodeId b);

/// The same for any two nodes of a graph: a parent is stronger than what is below it.
int compare_nodes(const NodeGraph& graph, NodeId a, NodeId b);

}  // namespace tenon::compose
