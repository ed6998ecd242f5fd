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
#include "tenon/bytes/write/replaced_file.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/formats/layer_format.h"
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
/// `max_work` as in compose::ComposeOptions; 0: the limit.
Result<stage::Stage> open_package(const Package& package,
                                  const std::map<std::string, std::string>& selections,
                                  std::size_t max_work = 0);

/// Makes the bytes of the files of all layers, and each layer what a reader has of them: from then
/// on the package is what its folder will contain. Each layer is written and read once. The
/// interface notes the files written (written_note.h). Errors: Invalid "structure.differs" with the
/// file, where a layer cannot be written or its bytes cannot be read.
Result<void> store_layers(Package& package);
/// Adds a file that is no layer to a package with its layers stored; the interface notes it.
Result<void> add_stored_file(Package& package, const std::string& name, std::string contents);

/// What may be done to a folder that holds something.
struct WriteOptions {
  /// Edits of what was written are overwritten. Files that were not written as part of an asset
  /// stay, except those with the name of a new file or at a place of the structure.
  bool force = false;
  bool in_place = false;         ///< the folder may be that of the asset that is read
  bool can_be_in_place = false;  ///< messages may name --in-place
  /// Is given what the files of a folder that exists held (bytes::CommitOptions).
  std::vector<bytes::ReplacedFile>* replaced = nullptr;
};

/// Puts the package, with its layers stored, into `folder`. A new folder is written under a hidden
/// name beside it, synced, then renamed: other programs see the whole package or nothing. In one
/// that exists the files change in one transaction (bytes/write/file_transaction.h); those of an
/// earlier package go, all others stay. Errors, all of which leave the folder as it was:
/// ErrorCode::Invalid with the rules "output.edited" (what an earlier package said about its files
/// is not so any more, see written_note.h), "output.unknown" (there are other files),
/// "output.is-input" (the run has read files of it); Io.
Result<void> write_package(const Package& package, const std::string& folder,
                           const WriteOptions& options = {});
/// The same for contents at hand.
Result<void> write_folder(const std::map<std::string, std::string_view>& files,
                          const std::string& folder, const WriteOptions& options = {});
/// Looks whether the folder may be written to, before there is something to write.
Result<void> check_folder(const std::string& folder, const WriteOptions& options);

}  // namespace tenon::structure
