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
#include "tenon/base/result.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/interpolate.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/time.h"

namespace tenon::stage {

struct StageOptions {
  compose::ComposeOptions compose;
  /// Only these prims, their ancestors and descendants are populated; empty = all.
  std::set<Path> mask;
  /// Populated prims, prototypes counted once; those beyond are skipped with a diagnostic.
  std::size_t max_prims = limits::kStagePrims;
  /// Prims with those below instances, each as often as a walk meets it, and how many more for each
  /// spec of the layers; descendants of further instances are skipped with a diagnostic.
  std::size_t max_instanced_prims = limits::kInstancedPrims;
  std::size_t max_instanced_prims_per_spec = limits::kInstancedPrimsPerSpec;
  /// Asset path authored in a layer -> where it is, "" when nowhere; for resolved asset values.
  Function<std::string(const std::string& asset_path, const layer::Layer& anchor)> resolve_asset;
  Interpolation interpolation = Interpolation::Linear;  ///< of time samples
};

/// A composed scene. Move-only; prims, attributes and relationships are handles into it and must
/// not outlive it.
class Stage {
 public:
  /// Composes and populates. Fails only when nothing can be composed at all; unresolved arcs and
  /// the like are in `diagnostics`.
  static Result<Stage> open(layer::LayerPtr root, layer::LayerPtr session,
                            compose::LayerOpener opener, StageOptions options = {});
  Stage(Stage&&) noexcept;
  Stage& operator=(Stage&&) noexcept;
  ~Stage();

  Prim pseudo_root() const;
  /// The prim at an absolute path, instance proxies included; an invalid handle when there is none.
  Prim prim(Path path) const;
  Prim default_prim() const;
  /// Prototype roots in a stable order.
  std::vector<Prim> prototypes() const;

  const layer::Layer& root_layer() const;
  const layer::Layer* session_layer() const;
  const compose::LayerStack& layer_stack() const;
  /// All layers opened so far, those of value clips included, sorted by identifier.
  std::vector<layer::LayerPtr> used_layers() const;
  /// One of them is from a binary form (Layer::may_lack_text).
  bool may_lack_text() const;
  /// Layers that arcs name and that cannot be opened.
  const std::vector<compose::MissingArc>& missing_arcs() const;
  /// Units of work that composition took so far (limits::kComposeWork).
  std::size_t work() const;
  /// Composition errors and value errors found so far.
  const Diagnostics& diagnostics() const;
  /// Puts `all`, which has these and what else opening found, in their place.
  void set_diagnostics(Diagnostics all);

  double start_time_code() const;
  double end_time_code() const;
  double time_codes_per_second() const;
  double frames_per_second() const;
  /// Metadata of the pseudo-root: session layer over root layer, sublayers do not count; registered
  /// fallbacks of upAxis, metersPerUnit and the like where neither authors it.
  layer::Value metadata(Token field) const;
  bool has_authored_metadata(Token field) const;
  /// Authored fields of the pseudo-root, sorted by name.
  std::map<std::string, layer::Value> all_authored_metadata() const;

  /// Opaque to users; shared by the handles.
  const StageData& data() const { return *data_; }

 private:
  explicit Stage(std::unique_ptr<StageData> data);
  std::unique_ptr<StageData> data_;
};

}  // namespace tenon::stage
