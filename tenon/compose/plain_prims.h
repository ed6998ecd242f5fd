// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/compose/indexer.h"

/// Internal: prims at which no arc starts, as most do not. What is above them tells everything but
/// what the layers say; the pass list of arcs is not needed.
namespace tenon::compose {

/// Fills `index`, whose path is given, of a child of the prim `parent` that has opinions of the
/// root layer stack alone. False, with nothing done, where an arc starts here or other stacks
/// matter. When there has been too much work, arcs count no more: what remains is as large as the
/// layers of the root stack.
bool build_local_child(const IndexServices& services, const PrimIndex& parent, PrimIndex& index);

/// The same of a child below arcs, where every node of the parent goes one name deeper.
bool build_child_below_arcs(const IndexServices& services, const PrimIndex& parent,
                            PrimIndex& index);

/// What is kept of an index, and what the names of its opinions take to combine.
void count_index(const IndexServices& services, const PrimIndex& index);

}  // namespace tenon::compose
