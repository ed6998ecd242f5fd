// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

namespace tenon::structure {

/// One file of a package: a layer, or anything else.
struct PackageFile {
  layer::LayerPtr layer;  ///< its identifier is identifier_in_package of its name; null: no layer
  formats::LayerFormat format = formats::LayerFormat::Text;
  std::shared_ptr<const bytes::FileBytes> bytes;  ///< of a layer from store_layers on
};

/// An asset of several files as a value, in no folder yet.
struct Package {
  std::string interface;                     ///< name of the file that opens the asset
  std::map<std::string, PackageFile> files;  ///< by name relative to the asset's folder
};

/// A session layer that selects variants of the root prim of that name; "" selects none.
layer::LayerPtr selections_layer(Token prim, const std::map<std::string, std::string>& selections);

/// The identifier that a layer of a package has while it is in no folder.
std::string identifier_in_package(const std::string& name);

/// Opens the layers of a package, which must outlive it, and no others.
compose::LayerOpener opener_of(const Package& package);
/// Composes a package with these variants of its default prim selected ("" selects none).
Result<stage::Stage> open_package(const Package& package,
                                  const std::map<std::string, std::string>& selections);

/// Makes the bytes of the files of all layers, and each layer what a reader has of them: from then
/// on the package is what will stand in its folder. Each layer is written and read once.
/// Errors: Invalid "structure.differs" with the file, where a layer cannot be written or its bytes
/// cannot be read.
Result<void> store_layers(Package& package);

/// Puts the package, with its layers stored, into `folder` in one step: other programs see what was
/// there before or the whole package, also when the process is killed or the disk is full. Written
/// to a hidden folder beside it, synced, then exchanged with it by name. What was there before
/// goes. A kill may leave the hidden folder behind. Errors: ErrorCode::Invalid when the folder
/// holds files that are no part of such an asset; Unsupported where the file system cannot exchange
/// folders; Io. All leave the folder as it was.
Result<void> write_package(const Package& package, const std::string& folder);
/// The same for contents at hand.
Result<void> write_folder(const std::map<std::string, std::string_view>& files,
                          const std::string& folder);

/// Files below `folder` that no such asset has, by name, sorted; empty for a folder that does not
/// exist.
std::vector<std::string> foreign_files(const std::string& folder);

}  // namespace tenon::structure
