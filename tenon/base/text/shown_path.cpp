// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/shown_path.h"

#include <cstddef>
#include <filesystem>
#include <system_error>

namespace tenon {

std::string shown_path(const std::string& path) {
  const std::size_t bracket = path.find('[');
  const std::filesystem::path file = path.substr(0, bracket);
  if (!file.is_absolute()) {
    return path;
  }
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  const std::string shown = file.lexically_proximate(here).string();
  return bracket == std::string::npos ? shown : shown + path.substr(bracket);
}

}  // namespace tenon
