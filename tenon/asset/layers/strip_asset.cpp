// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Stripping composes nothing: every layer that the asset leads to is stripped by itself, so that
// the physics of variants that are not selected goes as well. Layers outside of the folders of the
// asset stay; those among them that hold physics are errors. Muting composes the asset, since only
// that tells which flags are on, and switches them off in one layer: a new one over the asset, or
// the root layer.
#include "tenon/asset/layers/strip_asset.h"

#include <filesystem>

#include "tenon/asset/layers/asset_layers.h"
#include "tenon/base/file_finding.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/files.h"

namespace tenon {
namespace {

using answers::Json;

/// Physics in layers that do not belong to the asset stays, which is no success.
void report_outside(const AssetLayers& asset, const std::string& path, const OpenOptions& open,
                    Diagnostics& diagnostics) {
  diagnostics.append(asset.refused());
  for (const std::string& identifier : asset.outside()) {
    Diagnostics ignored;
    const auto layer = open_layer(identifier, open, ignored);
    if (!layer) {
      continue;
    }
    layer::Layer copy = **layer;
    if (physics::strip_physics(copy).total() != 0) {
      diagnostics.add(file_finding(
          Severity::Error, bytes::kOutsideRule,
          "the layer @" + identifier +
              "@ is outside of the folders of the asset; its physics "
              "stays",
          path, 0,
          "if it belongs to the asset, give --allow-read " +
              shell_word(std::filesystem::path(bytes::split_package_path(identifier).package)
                             .parent_path()
                             .string())));
    }
  }
}

void add_counts(physics::StripCounts& sum, const physics::StripCounts& counts) {
  sum.prims += counts.prims;
  sum.api_schemas += counts.api_schemas;
  sum.properties += counts.properties;
  sum.metadata += counts.metadata;
}

Json counts_json(const physics::StripCounts& counts) {
  return {{"prims", counts.prims},
          {"apiSchemas", counts.api_schemas},
          {"properties", counts.properties},
          {"metadata", counts.metadata}};
}

}  // namespace

Result<StrippedAsset> strip_asset(const std::string& path, const StripOptions& options,
                                  Diagnostics& diagnostics) {
  TENON_TRY(AssetLayers asset, AssetLayers::open(path, options.open));
  report_outside(asset, path, options.open, diagnostics);
  StrippedAsset result;
  result.is_whole = asset.is_whole();
  for (AssetLayer& part : asset.layers()) {
    layer::Layer edited = *part.layer;
    const physics::StripCounts counts = physics::strip_physics(edited);
    if (counts.total() == 0) {
      continue;
    }
    add_counts(result.counts, counts);
    result.layers.push_back({part.layer->identifier(), counts});
    part.edited = std::make_shared<layer::Layer>(std::move(edited));
  }
  TENON_TRY(result.files, options.in_place ? asset.in_place() : asset.elsewhere(options.output));
  result.without_layout = asset.without_layout();
  return result;
}

Result<MutedAsset> mute_asset(const std::string& path, const StripOptions& options,
                              Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, tenon::open(path, options.open, diagnostics));
  const layer::Layer& root = stage.root_layer();
  const std::string output = root_output(options.output, root);
  const bytes::Files& files = options.open.files;
  const bool same =
      files->real_path(root.identifier()) == files->real_path(bytes::absolute_file_path(output));
  if (same && !options.in_place) {
    return Error(ErrorCode::Invalid, "the layer over the asset would replace the asset")
        .in_file(output)
        .with_rule("output.is-input")
        .with_fix("name another place, or give --in-place");
  }
  layer::Layer layer = options.in_place ? root : layer_over(root, output);
  MutedAsset muted;
  muted.counts = bake::mute_physics(stage, layer, diagnostics);
  if (options.in_place) {
    TENON_TRY(LayerContents made, edited_contents(layer, layer.identifier(), files));
    muted.file = {layer.identifier(), std::move(made.contents)};
  } else {
    TENON_TRY(std::string contents, new_contents(layer, output));
    muted.file = {output, std::move(contents)};
  }
  return muted;
}

Json stripped_json(const StrippedAsset& asset) {
  Json body = counts_json(asset.counts);
  body["layers"] = Json::array();
  for (const StrippedLayer& layer : asset.layers) {
    Json row = {{"file", shown_path(layer.file)}};
    row.update(counts_json(layer.counts));
    body["layers"].push_back(std::move(row));
  }
  return body;
}

Json muted_json(const bake::MuteCounts& counts) {
  return {{"bodies", counts.bodies},
          {"colliders", counts.colliders},
          {"joints", counts.joints},
          {"outOfReach", counts.out_of_reach}};
}

}  // namespace tenon
