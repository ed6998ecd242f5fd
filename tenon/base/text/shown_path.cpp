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

namespace fs = std::filesystem;

/// What arguments named, by absolute paths.
struct Given {
  std::vector<std::string> absolute;  ///< files and folders
  std::vector<std::string> relative;
  std::vector<std::string> folders;  ///< of absolute files
};

Given& given_paths() {
  static Given given;
  return given;
}

bool is_at_or_below(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder.ends_with('/') ? folder : folder + '/');
}

/// The longest of `places` that is `path` or a folder above it; 0 for none.
std::size_t nearest(const std::vector<std::string>& places, const std::string& path) {
  std::size_t longest = 0;
  for (const std::string& place : places) {
    longest = is_at_or_below(path, place) ? std::max(longest, place.size()) : longest;
  }
  return longest;
}

/// Without a slash at the end; empty for what is no path of a file: a prim is absolute, too.
std::string plain_absolute(const std::string& given) {
  std::error_code ignored;
  const fs::path path =
      fs::path(given).is_absolute() ? fs::path(given) : fs::current_path(ignored) / given;
  std::string plain = path.lexically_normal().string();
  while (plain.size() > 1 && plain.ends_with('/')) {
    plain.pop_back();
  }
  const std::size_t second = plain.find('/', 1);
  const bool is_file = second == std::string::npos || fs::exists(plain.substr(0, second), ignored);
  return is_file ? plain : std::string();
}

/// `in_place`: what was given by its absolute path keeps that inside of the working folder, too.
std::string shown(const std::string& path, bool in_place) {
  const std::size_t bracket = path.find('[');
  const fs::path file = path.substr(0, bracket);
  if (!file.is_absolute()) {
    return path;
  }
  std::error_code ignored;
  std::string text = file.lexically_proximate(fs::current_path(ignored)).string();
  const Given& given = given_paths();
  const std::string plain = file.string();
  const std::size_t absolute = nearest(given.absolute, plain);
  const bool is_outside = text.starts_with("..");
  if ((absolute > 0 && absolute >= nearest(given.relative, plain) && (in_place || is_outside)) ||
      (is_outside && nearest(given.folders, plain) > nearest(given.relative, plain))) {
    text = plain;
  }
  return bracket == std::string::npos ? text : text + path.substr(bracket);
}

}  // namespace

void show_as_given(const std::string& given) {
  const std::string plain = plain_absolute(given);
  if (given.empty() || plain.empty()) {
    return;
  }
  const bool is_absolute = fs::path(given).is_absolute();
  (is_absolute ? given_paths().absolute : given_paths().relative).push_back(plain);
  const std::string folder = fs::path(plain).parent_path().string();
  std::error_code ignored;
  if (is_absolute && folder != "/" && fs::exists(folder, ignored)) {
    given_paths().folders.push_back(folder);
  }
}

std::string shown_path(const std::string& path) { return shown(path, true); }

std::string path_from_here(const std::string& path) { return shown(path, false); }

}  // namespace tenon
