// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/compose/indexer.h"

/// Internal: one prim index from that of its parent. It depends only on its queries of `services`
/// and the layers.
namespace tenon::compose {

/// The index of the pseudo-root, which has no arcs.
void build_root_index(const IndexServices& services, PrimIndex& index);

/// The index of the child at `index.path` of the prim with the finished index `parent`.
void build_child_index(const IndexServices& services, const PrimIndex& parent, PrimIndex& index);

}  // namespace tenon::compose
