// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/layers/copy_layer.h"

#include <utility>

#include "tenon/asset_policy.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/read_record.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/save_layer.h"
#include "tenon/stage/flatten/flatten.h"

namespace tenon {

Result<layer::Layer> copy_layer(const std::string& path, const OpenOptions& open, CopyForm form,
                                Diagnostics& diagnostics) {
  if (form == CopyForm::AsItIs) {
    TENON_TRY(const layer::LayerPtr layer, open_layer(path, open, diagnostics));
    return *layer;
  }
  TENON_TRY(const stage::Stage stage, tenon::open(path, open, diagnostics));
  name_outside_layers(stage, policy_for(path, open), diagnostics);
  return form == CopyForm::FlattenedLayerStack ? stage::flatten_layer_stack(stage)
                                               : stage::flatten(stage);
}

void note_named_layers(layer::Layer& layer, const OpenOptions& open) {
  const bytes::AssetResolver resolver({open.search_paths, open.sandbox_roots, open.files});
  formats::rename_assets(layer, [&](const std::string& name, formats::AssetUse use, Path) {
    const bool is_layer = use == formats::AssetUse::Layer && !name.empty();
    const auto identifier = is_layer ? resolver.resolve(name, layer.identifier()) : std::string();
    if (identifier && !identifier->empty()) {
      bytes::note_read(bytes::split_package_path(*identifier).package);
    }
    return name;
  });
}

Result<std::string> copied_contents(layer::Layer layer, formats::LayerFormat format,
                                    const std::string& path, const OpenOptions& open,
                                    Diagnostics& diagnostics) {
  return format == formats::LayerFormat::Package
             ? pack_layer(std::move(layer), path, open, diagnostics)
             : formats::encode_layer(layer, format);
}

}  // namespace tenon
