// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Files, registry and composition wired together. What the caller asks for (a variant, overridden
// attributes) becomes opinions of a session layer in memory; no file changes.
#include "tenon/open_stage.h"

#include <memory>

#include "tenon/formats/open_layer.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/text/reader.h"
#include "tenon/layer/finding_place.h"
#include "tenon/pack_asset.h"
#include "tenon/physics/layer_units.h"
#include "tenon/physics_selection.h"
#include "tenon/session_opinions.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

Result<stage::StageOptions> stage_options(const OpenOptions& options, const StageSources& sources) {
  stage::StageOptions result;
  TENON_TRY(result.compose, compose_options(options, *sources.root));
  for (const std::string& text : options.mask) {
    TENON_TRY(const Path path, parse_prim_path(text, "the mask"));
    result.mask.insert(path);
  }
  result.resolve_asset = [registry = sources.registry](const std::string& asset,
                                                       const layer::Layer& anchor) {
    return registry->resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  return result;
}

Result<stage::Stage> compose_stage(const StageSources& sources, const OpenOptions& options) {
  TENON_TRY(auto composed, stage_options(options, sources));
  return stage::Stage::open(sources.root, sources.session, sources.opener(), std::move(composed));
}

/// The stage composed again, of layers in its own units (S-11).
Result<void> convert_layers(const StageSources& sources, const OpenOptions& options,
                            stage::Stage& stage) {
  const auto converted = physics::layers_in_stage_units(stage);
  if (converted.empty()) {
    return {};
  }
  TENON_TRY(auto composed, stage_options(options, sources));
  const auto opener = [open = sources.opener(), converted](
                          const std::string& asset,
                          const layer::Layer& anchor) -> Result<layer::LayerPtr> {
    TENON_TRY(layer::LayerPtr layer, open(asset, anchor));
    const auto found = converted.find(layer->identifier());
    return found == converted.end() ? layer : found->second;
  };
  TENON_TRY(stage, stage::Stage::open(sources.root, sources.session, opener, std::move(composed)));
  return {};
}

/// Selects the variant on prims below as well, and on those that come with it.
Result<void> select_below(StageSources& sources, const OpenOptions& options, stage::Stage& stage) {
  constexpr int kRounds = 32;  // of references within variants; each adds selections
  for (int i = 0; i < kRounds; ++i) {
    const std::vector<Path> prims = prims_to_select(stage, options);
    if (prims.empty()) {
      break;
    }
    for (const Path prim : prims) {
      sources.session = with_variant(sources.session, prim, "Physics", options.physics_variant);
    }
    TENON_TRY(stage, compose_stage(sources, options));
  }
  return {};
}

/// Says which files that asset values name may not be read. What arcs name composition reports.
void check_assets(const stage::Stage& stage, const bytes::AssetResolver& resolver,
                  Diagnostics& diagnostics) {
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    layer::Layer copy = *layer;
    formats::rename_asset_parts(copy, [&](const std::string& path, formats::AssetUse use, Path spec,
                                          const StatementPart& part) {
      const auto found = use == formats::AssetUse::Value
                             ? resolver.resolve(path, layer->identifier())
                             : Result<std::string>(path);
      if (!found && found.error().diagnostic().rule == "layer.outside") {
        Diagnostic finding = found.error().diagnostic();
        layer::place_finding(finding, *layer, spec, part);
        finding.prim = spec.prim().str();
        finding.property = spec.is_property() ? spec.name().str() : std::string();
        diagnostics.add(std::move(finding));
      }
      return path;
    });
  }
}

}  // namespace

Result<layer::LayerPtr> open_layer(const std::string& path, Diagnostics& diagnostics) {
  return open_layer(path, {}, diagnostics);
}

Result<layer::LayerPtr> open_layer(const std::string& path, const OpenOptions& options,
                                   Diagnostics& diagnostics) {
  const bytes::AssetResolver resolver(resolver_options(options));
  TENON_TRY(auto layer, formats::open_layer_file(resolver, path, diagnostics));
  return layer::LayerPtr(std::make_shared<const layer::Layer>(std::move(layer)));
}

Result<std::string> pack_layer(layer::Layer layer, const std::string& path,
                               const OpenOptions& options, Diagnostics& diagnostics) {
  return pack_layer(std::move(layer), path, options, {}, diagnostics);
}

Result<stage::Stage> open(const std::string& path, const OpenOptions& options) {
  Diagnostics found;
  TENON_TRY(stage::Stage stage, open(path, options, found));
  stage.set_diagnostics(std::move(found));
  return stage;
}

Result<stage::Stage> open(const std::string& path, const OpenOptions& options,
                          Diagnostics& diagnostics) {
  TENON_TRY(StageSources sources, open_sources(path, options));
  TENON_TRY(auto stage, compose_stage(sources, options));
  if (!options.physics_variant.empty() && options.physics_below) {
    TENON_CHECK(select_below(sources, options, stage));
  }
  if (!options.overrides.empty()) {
    // The types of the attributes are known only once the stage is composed.
    TENON_TRY(sources.session, with_overrides(sources.session, stage, options.overrides));
    TENON_TRY(stage, compose_stage(sources, options));
  }
  if (options.layer_units) {
    TENON_CHECK(convert_layers(sources, options, stage));
  }
  diagnostics.append(sources.registry->diagnostics());
  diagnostics.append(stage.diagnostics());
  if (!options.sandbox_roots.empty()) {
    check_assets(stage, sources.registry->resolver(), diagnostics);
  }
  TENON_CHECK(check_physics_selection(stage, options, diagnostics));
  return stage;
}

}  // namespace tenon
