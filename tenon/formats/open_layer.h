// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/formats/layer_format.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// Detected by the first bytes, never by the name; neither crate nor zip means text.
LayerFormat format_of(const bytes::FileBytes& bytes);

/// What a layer is read from: the root layer of a package, else the bytes themselves.
Result<std::shared_ptr<const bytes::FileBytes>> bytes_of_layer(
    std::shared_ptr<const bytes::FileBytes> bytes);

/// True for a name that ends as those of layers in one file do: .usd, .usda, .usdc.
bool is_layer_name(std::string_view name);

/// The layer that `identifier` names: a file (a relative path is taken from the working directory)
/// or a file in a package, `a.usdz[b.usda]`; a package alone means its root layer, the first of
/// its files. The layer's identifier is the absolute form.
/// Errors: ErrorCode::NotFound, Io, Parse, Corrupt, Unsupported, Limit, each with the file.
Result<layer::Layer> open_layer_file(const std::string& identifier, Diagnostics& diagnostics);
Result<layer::Layer> open_layer_file(const bytes::AssetResolver& resolver,
                                     const std::string& identifier, Diagnostics& diagnostics);
/// The same for bytes at hand.
Result<layer::Layer> read_layer(std::shared_ptr<const bytes::FileBytes> bytes,
                                std::string identifier, Diagnostics& diagnostics);

/// Layers that are open, one per identifier, so that equal identifiers give equal pointers. Usable
/// from several threads at once.
class LayerRegistry {
 public:
  explicit LayerRegistry(bytes::AssetResolver resolver = {}) : resolver_(std::move(resolver)) {}
  LayerRegistry(const LayerRegistry&) = delete;
  LayerRegistry& operator=(const LayerRegistry&) = delete;

  /// The layer that a stage begins with. Its folder joins the search paths of the resolver, as
  /// OpenUSD's default context has it; call it before `open`.
  Result<layer::LayerPtr> open_root(const std::string& path);
  /// The layer that `asset_path` means in `anchor` (nullptr: the working directory). Why a layer
  /// could not be opened is remembered: asking again costs nothing and gives the same answer.
  Result<layer::LayerPtr> open(const std::string& asset_path, const layer::Layer* anchor);
  /// Makes a layer that is in no file, or an edited one, known under its identifier.
  void insert(layer::LayerPtr layer);

  const bytes::AssetResolver& resolver() const { return resolver_; }
  /// Identifiers of the layers that are open, sorted.
  std::vector<std::string> opened() const;
  /// Findings in the layers opened so far, in the order of opening.
  Diagnostics diagnostics() const;

 private:
  Result<layer::LayerPtr> open_identifier(const std::string& identifier);

  mutable std::mutex mutex_;
  bytes::AssetResolver resolver_;
  std::map<std::string, Result<layer::LayerPtr>> layers_;
  Diagnostics diagnostics_;
};

}  // namespace tenon::formats
