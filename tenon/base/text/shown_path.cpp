// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/shown_path.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <vector>

namespace tenon {
namespace {

std::vector<std::string>& absolute_folders() {
  static std::vector<std::string> folders;
  return folders;
}

}  // namespace

void show_absolute(const std::string& folder) { absolute_folders().push_back(folder); }

std::string shown_path(const std::string& path) {
  const std::size_t bracket = path.find('[');
  const std::filesystem::path file = path.substr(0, bracket);
  if (!file.is_absolute()) {
    return path;
  }
  std::error_code ignored;
  const auto here = std::filesystem::current_path(ignored);
  std::string shown = file.lexically_proximate(here).string();
  const auto names = [&](const std::string& folder) {
    const std::string plain = file.string();
    return plain == folder || plain.starts_with(folder.ends_with('/') ? folder : folder + '/');
  };
  const auto& absolute = absolute_folders();
  if (shown.starts_with("..") && std::any_of(absolute.begin(), absolute.end(), names)) {
    shown = file.string();
  }
  return bracket == std::string::npos ? shown : shown + path.substr(bracket);
}

}  // namespace tenon
