// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/mesh_paths.h"

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include <pugixml.hpp>

namespace tenon::urdf {
namespace {

namespace fs = std::filesystem;

std::optional<std::string> file_at(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    return std::nullopt;
  }
  return path.lexically_normal().generic_string();
}

/// "package://a/b/c" -> {"a", "b/c"}; nothing for other schemes.
std::optional<std::pair<std::string, std::string>> package_parts(const std::string& written) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (written.starts_with(scheme)) {
      const std::string rest = written.substr(scheme.size());
      const std::size_t slash = rest.find('/');
      return std::pair(rest.substr(0, slash),
                       slash == std::string::npos ? std::string() : rest.substr(slash + 1));
    }
  }
  return std::nullopt;
}

}  // namespace

MeshPaths::MeshPaths(const std::string& path, const std::map<std::string, std::string>& packages)
    : packages_(packages) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  folder_ = (error ? fs::path(path) : absolute).lexically_normal().parent_path().generic_string();
}

const std::string& MeshPaths::package_name(const std::string& folder) {
  const auto [at, is_new] = names_.emplace(folder, "");
  if (is_new) {
    pugi::xml_document document;
    if (document.load_file((folder + "/package.xml").c_str())) {
      at->second = document.child("package").child("name").text().as_string();
    }
  }
  return at->second;
}

std::optional<std::string> MeshPaths::find_in_package(const std::string& name,
                                                      const std::string& rest) {
  if (const auto given = packages_.find(name); given != packages_.end()) {
    return file_at(fs::path(given->second) / rest);
  }
  for (fs::path at = folder_;; at = at.parent_path()) {
    if (at.filename() == name || package_name(at.generic_string()) == name) {
      if (auto found = file_at(at / rest)) {
        return found;
      }
    }
    if (auto found = file_at(at / name / rest)) {
      return found;
    }
    if (at == at.parent_path()) {
      return std::nullopt;
    }
  }
}

std::optional<std::string> MeshPaths::find(const std::string& written) {
  if (const auto parts = package_parts(written)) {
    return find_in_package(parts->first, parts->second);
  }
  constexpr std::string_view kFile = "file://";
  const std::string plain = written.starts_with(kFile) ? written.substr(kFile.size()) : written;
  if (plain.empty() || plain.find("://") != std::string::npos) {
    return std::nullopt;
  }
  return file_at(fs::path(folder_) / plain);
}

std::string MeshPaths::advice(const std::string& written) const {
  if (const auto parts = package_parts(written)) {
    if (packages_.count(parts->first) != 0) {
      return "look into the folder given for the package \"" + parts->first + "\"";
    }
    return "say where the package lies: --package " + parts->first + "=DIR";
  }
  return "put the file at that place, seen from the description";
}

}  // namespace tenon::urdf
