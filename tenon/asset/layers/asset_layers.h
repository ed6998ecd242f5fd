// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tenon/asset/made_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/layer/layer.h"
#include "tenon/open_stage.h"

namespace tenon {

/// One layer of an asset and, where it changes, its new contents.
struct AssetLayer {
  layer::LayerPtr layer;
  std::shared_ptr<layer::Layer> edited;  ///< null: stays as it is
};

/// All layers that an asset leads to by sublayers, references, payloads and clips, those of
/// variants that are not selected too, the root layer first; for edits that reach through all of
/// them. Layers outside of the asset's folders (docs/reading.md) are not among them.
class AssetLayers {
 public:
  static Result<AssetLayers> open(const std::string& path, const OpenOptions& options);

  std::vector<AssetLayer>& layers() { return layers_; }
  /// The edited layers in their files; text keeps its layout.
  /// Errors: Unsupported where one is in a package.
  Result<MadeFiles> in_place();
  /// The root layer for `output` and, in the folder "<output without its ending>_layers", every
  /// layer that is edited or leads to an edited one; asset paths follow. A folder (names_folder)
  /// takes them all, each under its own name, where it is beside the root layer. "-" is standard
  /// output, for the root layer as text. Errors: Unsupported for "-" where another layer is edited;
  /// Invalid for a folder where a layer of the asset itself would be written over.
  Result<MadeFiles> elsewhere(const std::string& output);
  /// Whether they include every layer that one of them names, so that composing finds none missing
  /// either. False also where a name has to be composed to be known.
  bool is_whole() const { return is_whole_; }
  /// Layers that the asset uses and that do not belong to it: they stay unchanged.
  const std::set<std::string>& outside() const { return outside_; }
  /// Files that the sandbox refused to open.
  const Diagnostics& refused() const { return refused_; }
  /// Files whose comments and layout could not be kept.
  const std::vector<std::string>& without_layout() const { return without_layout_; }

 private:
  struct Search;

  std::optional<std::size_t> named_layer(const std::string& name, const layer::Layer& from,
                                         Search& search);
  std::map<std::string, std::string> new_places(const std::string& output) const;
  Result<void> check_apart(const std::map<std::string, std::string>& places) const;
  Result<void> check_one_edit() const;
  Result<MadeFile> made(const layer::Layer& layer, const std::string& original,
                        const std::string& file);
  void rename(layer::Layer& layer, const std::string& from, const std::string& to,
              const std::map<std::string, std::string>& places) const;

  bytes::AssetResolver resolver_;
  std::vector<AssetLayer> layers_;
  std::vector<std::vector<std::size_t>> leads_to_;  // (layer_count)
  std::vector<std::string> without_layout_;
  bool is_whole_ = true;
  std::set<std::string> outside_;
  Diagnostics refused_;
};

/// The file that an output means for the asset: a folder takes it under its own name.
std::string root_output(const std::string& output, const layer::Layer& root);

/// A new layer for `output` ("-": for the current folder) with an asset as its sublayer, which
/// repeats the default prim, the units and the times of the asset. It may lack a text, as the name
/// of the asset's file may.
layer::Layer layer_over(const layer::Layer& asset, const std::string& output);

/// The contents of a file.
struct LayerContents {
  std::string contents;
  bool kept_layout = true;  ///< comments and layout of text stay
};

/// `layer` as the contents of `file`, text for "-". Where the layer's own file is text and the new
/// one must be text, its comments and layout stay except for the changes, if possible; `files` have
/// the layer's.
Result<LayerContents> edited_contents(const layer::Layer& layer, const std::string& file,
                                      const bytes::Files& files);

/// `layer` in the format that the name of `file` asks for; as text for "-".
Result<std::string> new_contents(const layer::Layer& layer, const std::string& file);

}  // namespace tenon
