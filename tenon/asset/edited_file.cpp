// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edited_file.h"

#include <utility>

#include "tenon/bytes/write/file_transaction.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/formats/text/layout/layout_edit.h"

namespace tenon {

Result<EditedFile> edited_file(const bytes::FileBytes& bytes, const layer::Layer& layer) {
  EditedFile file;
  file.path = layer.identifier();
  const formats::LayerFormat format = formats::format_of(bytes);
  file.text = format == formats::LayerFormat::Text;
  if (!file.text) {
    TENON_TRY(file.after, formats::encode_layer(layer, format));
    return file;
  }
  file.before = std::string(bytes.text());
  formats::EditedText edited = formats::edit_text(file.before, layer);
  file.after = std::move(edited.text);
  file.kept_layout = edited.kept_layout;
  return file;
}

Result<EditedFile> new_file(const layer::Layer& layer) {
  EditedFile file;
  file.path = layer.identifier();
  file.text = true;
  TENON_TRY(file.after, formats::encode_layer(layer, formats::LayerFormat::Text));
  return file;
}

Result<void> write_files(const std::vector<EditedFile>& files,
                         std::vector<bytes::ReplacedFile>* replaced) {
  bytes::FileTransaction transaction;
  for (const EditedFile& file : files) {
    file.removed ? transaction.remove(file.path, file.path.substr(0, file.path.rfind('/')))
                 : transaction.put(file.path, file.after);
  }
  return transaction.commit({.in_place = true, .make_folders = true, .replaced = replaced});
}

}  // namespace tenon
