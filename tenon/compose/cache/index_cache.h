// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/work_limits.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/compose/layer_stack.h"

namespace tenon::compose {

struct PrimIndex;

/// Which payloads are included and which variants are taken when none is selected.
struct ComposeOptions {
  /// Where no rule names the prim or one above it.
  bool load_payloads = true;
  /// Rules, the nearest counts; UsdStageLoadRules calls them AllRule, OnlyRule and NoneRule. What
  /// is above a loaded prim is loaded as well, unless AllRule decides already.
  std::set<Path> loaded;        ///< these prims and below
  std::set<Path> loaded_alone;  ///< these prims, nothing below
  std::set<Path> unloaded;      ///< not these and below
  /// Variant set -> variants to fall back to, best first.
  std::map<std::string, std::vector<std::string>> variant_fallbacks;
  std::set<std::string> muted;  ///< identifiers of layers that count as absent
  /// A reference to the root layer leads into the root layer stack itself. Not so where the stack
  /// has a session layer, and in a stage, which always has one, if only an empty one.
  bool shares_root_stack = true;
  /// Siblings that bring in the same are composed once; off, each is, with the same outcome.
  bool shares_twins = true;
  /// Nodes of all prim indices together; arcs beyond are skipped with a diagnostic.
  std::size_t max_nodes = limits::kCacheNodes;
  /// Units of work on all prim indices together, and more for each spec of the layers; arcs beyond
  /// are skipped with a diagnostic that names the most expensive one.
  std::size_t max_work = limits::kComposeWork;
  std::size_t max_work_per_spec = limits::kComposeWorkPerSpec;

  /// `units` in place of both bounds of work; 0 leaves them.
  void set_max_work(std::size_t units) {
    max_work = units == 0 ? max_work : units;
    max_work_per_spec = units == 0 ? max_work_per_spec : 0;
  }
};

/// Path -> PrimIndex, computed on demand and kept; the only state of composition.
class IndexCache {
 public:
  IndexCache(layer::LayerPtr root, layer::LayerPtr session, LayerOpener opener,
             ComposeOptions options = {});
  IndexCache(const IndexCache&) = delete;
  IndexCache& operator=(const IndexCache&) = delete;
  ~IndexCache();

  const LayerStackPtr& layer_stack() const;
  /// The index of an absolute prim path (or of the pseudo-root); never null, empty of opinions for
  /// a path where nothing is. The reference stays valid for the life of the cache.
  const PrimIndex& index(Path prim_path);
  /// The same for a child of a prim whose index is at hand, which is cheaper.
  const PrimIndex& child_index(const PrimIndex& parent, Token name);
  /// Builds the indices of what is below `roots` on two threads, as far as that takes no layer that
  /// is not open yet; `enters` tells, on either thread, whether children of a prim are wanted,
  /// `most` how many indices each thread may make. Later answers are the same as without, only
  /// sooner. False when something was skipped.
  bool build_below(const std::vector<const PrimIndex*>& roots,
                   const Function<bool(const PrimIndex&)>& enters, std::size_t most);
  /// Layers that could not be opened and other errors of layer stacks, in order of discovery.
  const Diagnostics& errors() const;
  /// Units of work that what was asked for took: the same however it was built.
  std::size_t work() const;
  /// Each missing layer once per opinion, in order of discovery (the stage and `info` report them).
  const std::vector<MissingArc>& missing_arcs() const;
  /// All layers opened so far, sorted by identifier.
  std::vector<layer::LayerPtr> used_layers() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tenon::compose
