// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/write/replaced_file.h"
#include "tenon/layer/layer.h"

namespace tenon {

/// A file before and after edits of its layer.
struct EditedFile {
  std::string path;
  std::string before;  ///< empty for what is no text
  std::string after;   ///< text, or the bytes of a binary layer
  bool text = false;
  bool kept_layout = true;  ///< comments and layout of text stay
  bool removed = false;     ///< it goes

  bool differs() const { return !text || before != after; }
};

/// The file of `layer`, which holds `bytes` now, as the layer is. It stays in its format, whatever
/// its name says; text keeps its layout. Errors: those of formats::encode_layer.
Result<EditedFile> edited_file(const bytes::FileBytes& bytes, const layer::Layer& layer);

/// The text of a layer that is in no file yet, under its identifier.
Result<EditedFile> new_file(const layer::Layer& layer);

/// Writes all files in one step, also when the process is killed (bytes/write/file_transaction.h).
/// `replaced` is given what the files held (bytes::CommitOptions).
Result<void> write_files(const std::vector<EditedFile>& files,
                         std::vector<bytes::ReplacedFile>* replaced = nullptr);

}  // namespace tenon
