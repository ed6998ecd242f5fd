// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

namespace tenon::urdf {

/// From file names in a description to files: `package://NAME/x` and `model://NAME/x` by the given
/// folders, then upward from the description; `file://`; else relative to the description.
class MeshPaths {
 public:
  /// `path` is the description.
  MeshPaths(const std::string& path, const std::map<std::string, std::string>& packages);

  /// The file; none when there is none.
  std::optional<std::string> find(const std::string& written);
  /// What a person can do about a name that was not found.
  std::string advice(const std::string& written) const;

 private:
  std::optional<std::string> find_in_package(const std::string& name, const std::string& rest);
  /// The name that the package.xml of a folder gives; empty without one.
  const std::string& package_name(const std::string& folder);

  std::string folder_;
  const std::map<std::string, std::string>& packages_;
  std::map<std::string, std::string> names_;  // of folders, once read
};

}  // namespace tenon::urdf
