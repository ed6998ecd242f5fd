// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "tenon/asset/edit_asset.h"
#include "tenon/asset/editing/edit_effects.h"
#include "tenon/formats/text/reader.h"

namespace tenon {
namespace {

/// The lines of the places in the new texts.
Result<void> find_lines(const AssetEditor& editor, EditedAsset& asset) {
  std::map<std::string, layer::LayerPtr> read;
  for (const EditedFile& file : asset.files) {
    Diagnostics ignored;
    if (file.text && !file.removed) {
      TENON_TRY(layer::Layer again, formats::read_text(file.after, file.path, ignored));
      read[file.path] = std::make_shared<const layer::Layer>(std::move(again));
    }
  }
  for (EditedPlace& place : asset.places) {
    const auto known = read.find(place.file);
    const layer::LayerPtr layer = known == read.end() ? editor.layer(place.file) : known->second;
    const layer::Spec* spec = layer == nullptr ? nullptr : layer->find(place.spec);
    place.line = spec == nullptr ? 0 : spec->line;
  }
  return {};
}

}  // namespace

Result<EditedAsset> edit_asset(const std::string& path, const std::vector<AssetEdit>& edits,
                               const EditOptions& options, Diagnostics& diagnostics) {
  TENON_TRY(AssetEditor editor, AssetEditor::open(path, options, diagnostics));
  EditedAsset asset;
  EditEffects effects(editor, edits);
  TENON_CHECK(effects.look_before());
  TENON_TRY(asset.places, editor.edit(edits, diagnostics));
  TENON_CHECK(effects.judge(asset, diagnostics));
  TENON_TRY(asset.files, editor.files());
  TENON_CHECK(find_lines(editor, asset));
  return asset;
}

}  // namespace tenon
