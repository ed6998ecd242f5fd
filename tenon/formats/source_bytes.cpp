// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/source_bytes.h"

#include "tenon/bytes/asset_resolver.h"
#include "tenon/formats/open_layer.h"

namespace tenon::formats {

std::shared_ptr<const bytes::FileBytes> source_bytes(const bytes::Files& files,
                                                     const std::string& identifier) {
  if (files->kind(bytes::split_package_path(identifier).package) != bytes::NameKind::File) {
    return nullptr;
  }
  auto bytes = bytes::open_identifier(files, identifier);
  if (bytes) {
    bytes = bytes_of_layer(*std::move(bytes));
  }
  return bytes ? *std::move(bytes) : nullptr;
}

}  // namespace tenon::formats
