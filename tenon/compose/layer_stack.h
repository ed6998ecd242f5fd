// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/compose/maps/map_function.h"
#include "tenon/layer/layer.h"

namespace tenon::compose {

class WorkMeter;

/// One layer of a stack and how its times map to the stack's root layer.
struct StackedLayer {
  layer::LayerPtr layer;
  layer::LayerOffset offset;  ///< stack time = offset(layer time), tcps differences included
};

/// A layer that an arc names and that cannot be opened.
struct MissingArc {
  std::string layer;  ///< identifier of the layer with the opinion
  Path prim;          ///< of the spec with the opinion; the root for sublayers
  std::string arc;    ///< "subLayer", "reference" or "payload"
  std::string path;   ///< as authored
};

/// A root layer with its session layer and all sublayers, strongest first.
struct LayerStack {
  layer::LayerPtr root;
  layer::LayerPtr session;  ///< may be null
  std::vector<StackedLayer> layers;
  double time_codes_per_second = 24;
  bool has_offsets = false;  ///< some layer's offset is no identity
  /// Composed over the stack and its referencing stacks.
  layer::Dictionary expression_variables;
  /// The stack that first authored these variables, this one or a referencing one.
  const LayerStack* expression_source = nullptr;
  /// Whose variables were composed over this stack's own; null for that of the stage.
  const LayerStack* override_source = nullptr;
  /// Relocates in force as authored: source to target, both absolute, target may be empty; sorted
  /// by source.
  MapFunction::Pairs relocates;
  /// The same, target to source, sorted by target; without those that delete.
  MapFunction::Pairs relocates_by_target;
  /// From where a prim is before any relocate to its target; sorted by source.
  MapFunction::Pairs combined_relocates;
  Diagnostics errors;
  std::vector<MissingArc> missing;  ///< sublayers that cannot be opened

  const std::string& identifier() const { return root->identifier(); }
  bool has_relocates() const { return !relocates.empty(); }
  /// Target of a relocate of exactly `source`, or nullptr.
  const Path* relocation_target(Path source) const;
  /// Source of the relocate to exactly `target`, or nullptr.
  const Path* relocation_source(Path target) const;
  /// Some layer has a prim spec at `path`.
  bool has_spec(Path path) const;
};

using LayerStackPtr = std::shared_ptr<const LayerStack>;

/// What to build a layer stack from.
struct LayerStackInputs {
  layer::LayerPtr root;
  layer::LayerPtr session;  ///< may be null
  const LayerOpener* opener = nullptr;
  const std::set<std::string>* muted = nullptr;  ///< identifiers of layers to skip
  const LayerStack* override_source = nullptr;   ///< whose expression variables win; may be null
  WorkMeter* work = nullptr;  ///< counts it, and ends it when there is no more; may be null
};

/// Opens all sublayers and composes offsets, expression variables and relocates. Never fails: what
/// cannot be opened or contradicts itself is reported in `errors` and skipped.
std::shared_ptr<LayerStack> build_layer_stack(const LayerStackInputs& inputs);

/// Finite, and time goes forward.
bool is_usable(const layer::LayerOffset& offset);

/// The scale from times at `other` codes per second to times at `rate`; 1 for nonsense.
double rate_ratio(double rate, double other);

/// timeCodesPerSecond of a whole stack: of the session layer where it authors one, else the root's.
bool session_sets_time_codes(const layer::Layer& session, const layer::Layer& root);

/// The part of a stack's relocates at and below `path` as a map with root identity.
MapFunction relocates_map(const LayerStack& stack, Path path);

}  // namespace tenon::compose
