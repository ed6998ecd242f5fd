// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/compose/arcs/arc.h"
#include "tenon/compose/prim_index.h"
#include "tenon/layer/arcs.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// One arc on the way from the stage to an opinion (Core Spec 1.0.1 section 10).
struct ArcStep {
  compose::ArcKind kind = compose::ArcKind::Root;
  Path from;               ///< prim with the arc, in the namespace of the layer stack that has it
  std::string layer;       ///< identifier of the layer that authors it; empty when none does
  std::uint32_t line = 0;  ///< of that prim there; 0 when unknown
  std::string to_layer;    ///< root layer of the stack that it leads to
  Path to;                 ///< prim there; a variant selection for variants
};

/// What one layer says about a prim or property, and how composition gets there.
struct OpinionSource {
  const layer::Layer* layer = nullptr;
  const layer::Spec* spec = nullptr;
  Path path;                  ///< of the spec in that layer, variant selections included
  std::string stack;          ///< root layer of the layer's stack: another one for sublayers
  std::vector<ArcStep> arcs;  ///< from the stage's own layers on; empty for opinions in these
  layer::LayerOffset offset;  ///< stage time = offset(layer time)
};

/// The way to one opinion of a prim's index.
OpinionSource source_of(const compose::PrimIndex& index, const compose::Opinion& opinion);

/// Every opinion in force on the prim at `prim` (instance proxies included) or, where `property` is
/// not empty, on that property of it; strongest first. Empty when there is no such prim.
std::vector<OpinionSource> opinion_sources(const Stage& stage, Path prim, Token property = {});

/// Opinions that composition ignores because they are authored below an instance, outside of the
/// part that the instance shares; strongest first. Empty for all but instance proxies.
std::vector<OpinionSource> ignored_below_instance(const Stage& stage, Path prim,
                                                  Token property = {});

/// Where an opinion of a layer on a prim stands, or would stand.
struct LayerSite {
  Path path;                                  ///< prim spec in the layer, variants included
  const compose::PrimIndex* index = nullptr;  ///< of the prim, or of the nearest one above it that
  std::uint32_t node = 0;                     ///< the layer reaches, and its node there
  Path shared_from;  ///< of instance proxies: the instance, as the stage names it,
  Path shared_as;    ///< and as the index does
};

/// The strongest place where an opinion of `layer` (an identifier) would count for the prim at
/// `prim`; the layer need not say anything about it yet. For instance proxies only what all
/// instances share counts. Nothing when the layer does not reach the prim.
std::optional<LayerSite> site_in_layer(const Stage& stage, Path prim, const std::string& layer);

}  // namespace tenon::stage
