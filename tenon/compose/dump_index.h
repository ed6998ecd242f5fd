// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tenon/compose/cache/index_cache.h"

namespace tenon::compose {

/// How a dump names layers: for example by the path relative to the root layer's folder.
using LayerLabel = std::function<std::string(const layer::Layer&)>;

/// What composition made of prims in the text form that the published composition suite records:
/// the layer stack; then per prim its specs strongest first, time offsets of all nodes, variant
/// selections, names of children and properties, specs of properties, targets and connections.
/// Findings follow as lines `rule message`, under a heading per prim.
/// Without `prims` all prims of the stage are dumped, depth-first.
std::string dump_indices(IndexCache& cache, const LayerLabel& label,
                         const std::vector<Path>& prims = {});

/// The nodes of an index as an indented tree, with arc, site, maps and flags; for comparisons.
std::string dump_nodes(const PrimIndex& index, const LayerLabel& label);

}  // namespace tenon::compose
