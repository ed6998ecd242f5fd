// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/layer/layer.h"
#include "tenon/tenon.h"

namespace tenon::cli {

/// One layer of an asset and, where it is to change, what it becomes.
struct AssetLayer {
  layer::LayerPtr layer;
  std::shared_ptr<layer::Layer> edited;  ///< null: stays as it is
};

/// All layers that an asset leads to by sublayers, references, payloads and clips, those of
/// variants that are not selected too, the root layer first; for edits that reach through all of
/// them.
class AssetLayers {
 public:
  static Result<AssetLayers> open(const std::string& path, const OpenOptions& options);

  std::vector<AssetLayer>& layers() { return layers_; }
  /// Writes the edited layers over their files; text keeps its layout. The files written.
  /// Errors: Unsupported where one lies in a package.
  Result<std::vector<std::string>> write_in_place();
  /// Writes the root layer to `output` and, into the folder "<output without its ending>_layers",
  /// every layer that is edited or leads to an edited one; asset paths follow. The files written.
  /// A folder (names_folder) takes them all, each under its own name, where it stands beside the
  /// root layer. "-" is standard output, for the root layer as text.
  /// Errors: Unsupported for "-" where another layer is edited; Invalid for a folder where a layer
  /// of the asset itself would be written over.
  Result<std::vector<std::string>> write_to(const std::string& output);
  /// Files whose comments and layout could not be kept.
  const std::vector<std::string>& without_layout() const { return without_layout_; }

 private:
  std::map<std::string, std::string> new_places(const std::string& output) const;
  Result<void> check_apart(const std::map<std::string, std::string>& places) const;
  void rename(layer::Layer& layer, const std::string& from, const std::string& to,
              const std::map<std::string, std::string>& places) const;

  bytes::AssetResolver resolver_;
  std::vector<AssetLayer> layers_;
  std::vector<std::vector<std::size_t>> leads_to_;  // (layer_count)
  std::vector<std::string> without_layout_;
};

/// The file that an output means for the asset: a folder takes it under its own name.
std::string root_output(const std::string& output, const layer::Layer& root);

/// Writes `layer` to `file`. Where the layer's own file is text and the new one is to be text, its
/// comments and layout stay but for what changed: the answer is whether they did.
Result<bool> save_edited(const layer::Layer& layer, const std::string& file);

}  // namespace tenon::cli
