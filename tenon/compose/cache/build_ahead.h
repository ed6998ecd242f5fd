// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "tenon/base/containers/stable_list.h"
#include "tenon/compose/indexer.h"
#include "tenon/compose/node_graph.h"

/// Internal: indices that are built side by side before they are asked for. They are those that
/// would be built when they are: whatever opens a layer, or would leave a trace outside of the
/// index, is left until then.
namespace tenon::compose {

struct IndexAhead {
  [[no_unique_address]] PrimIndex index;  // the numbers use its tail padding
  bool waits = false;                     ///< it was built ahead and not asked for yet
  std::uint16_t node_count = 0;           ///< nodes that building it made
  std::uint32_t work = 0;                 ///< units that building it took
};
static_assert(sizeof(IndexAhead) <= 64, "many of them are in memory");

/// Indices, each after that of its parent, and what they point into.
struct IndexBatch {
  StableList<IndexAhead> indices;
  MapPool maps;
  std::unordered_map<const IndexAhead*, std::vector<ArcCost>> costs;  ///< of work for arcs, if any
  bool complete = true;                                               ///< nothing was skipped
  bool full = false;  ///< it ended because as much is built as may be
};

/// The indices known so far. Called from several threads at once.
struct KnownIndices {
  const ComposeOptions* options = nullptr;
  const LayerStack* root_stack = nullptr;
  const MapPool* maps = nullptr;  ///< of all indices that were asked for
  std::size_t node_count = 0;     ///< nodes of all indices so far
  std::size_t work_done = 0;      ///< units of all indices so far
  std::size_t max_work = 0;       ///< units that all may take
  std::size_t max_indices = 0;    ///< of one batch
  /// nullptr where an index, a layer or a stack is not there yet.
  std::function<const PrimIndex*(Path)> index;
  std::function<const Result<layer::LayerPtr>*(const std::string&, const layer::Layer&)> layer;
  std::function<const LayerStack*(const layer::LayerPtr&, const LayerStack* from)> stack;
  /// Whether the children of a prim will be asked for.
  std::function<bool(const PrimIndex&)> enters;
};

/// The indices of all prims below `roots` that are not known, in two batches.
std::vector<IndexBatch> build_ahead(const KnownIndices& known,
                                    const std::vector<const PrimIndex*>& roots);

}  // namespace tenon::compose
