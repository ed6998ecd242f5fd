// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/layer/dictionary.h"
#include "tenon/stage/stage.h"

/// What the requirements of SimReady look at.
namespace tenon::check::simready {

/// What the header of an image says.
struct ImageFacts {
  std::size_t width = 0;   ///< [pixels]
  std::size_t height = 0;  ///< [pixels]
  bool single_channel = false;
};

/// Questions about the files beside a layer, by absolute path.
struct FileFacts {
  Function<bool(const std::string& path)> exists;                          ///< a file or a folder
  Function<std::vector<std::string>(const std::string& folder)> files_in;  ///< names, sorted
  /// None where it is no PNG or JPEG file.
  Function<std::optional<ImageFacts>(const std::string& file)> image;
};

/// An asset path that a layer of the asset names, in an arc, a value or metadata.
struct NamedFile {
  std::string layer;     ///< identifier of the layer
  std::string authored;  ///< as it is written
  std::string resolved;  ///< absolute path; empty: there is no such file
  Path spec;             ///< in that layer
  bool is_layer;         ///< named by an arc, not by a value
};

/// A stage with its prims as validators walk them, each list in pre-order.
struct JudgedStage {
  explicit JudgedStage(const stage::Stage& composed);

  const stage::Stage* stage;
  stage::Prim root;                      ///< the default prim; invalid where there is none
  std::vector<stage::Prim> plain;        ///< active, loaded, defined, not abstract; no instance is
                                         ///< entered
  std::vector<stage::Prim> below_root;   ///< those of `plain` that are the root or below it
  std::vector<stage::Prim> with_shared;  ///< as `plain`, and what instances share
  std::vector<stage::Prim> every;        ///< all prims; no instance is entered
};

/// An asset in its files.
struct JudgedAsset {
  std::string file;  ///< absolute path of the asset
  FileFacts files;
  std::vector<std::string> layers;  ///< files of all layers that the asset may use, sorted
  std::vector<NamedFile> named;     ///< by those layers
  std::string sidecar;              ///< the JSON file with the asset's name; empty: none
  std::optional<layer::Dictionary> facts_beside;  ///< of the sidecar; none where it is unusable
  /// The stage with this variant set of the default prim at "Enabled" and the other runtimes'
  /// at "Disabled"; "": all at "Disabled". Null where it does not open.
  Function<const JudgedStage*(std::string_view runtime)> stage_of;
};

/// Names of the variant sets of runtimes: PhysX, Newton, MuJoCo.
const std::vector<std::string>& runtimes();

}  // namespace tenon::check::simready
