// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/source_bytes.h"

#include <filesystem>

#include "tenon/bytes/asset_resolver.h"
#include "tenon/formats/open_layer.h"

namespace tenon::formats {

std::shared_ptr<const bytes::FileBytes> source_bytes(const std::string& identifier) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(bytes::split_package_path(identifier).package, ignored)) {
    return nullptr;
  }
  auto bytes = bytes::AssetResolver().open(identifier);
  if (bytes) {
    bytes = bytes_of_layer(*std::move(bytes));
  }
  return bytes ? *std::move(bytes) : nullptr;
}

}  // namespace tenon::formats
