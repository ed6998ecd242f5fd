// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/layers/output_place.h"

#include <filesystem>

namespace tenon {

bool names_folder(const std::string& output) {
  std::error_code error;
  return output.ends_with('/') || std::filesystem::path(output).extension().empty() ||
         std::filesystem::is_directory(output, error);
}

}  // namespace tenon
