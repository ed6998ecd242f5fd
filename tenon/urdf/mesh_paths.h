// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"

namespace tenon::urdf {

struct UrdfOptions;

/// From file names in a description to files: `package://NAME/x` and `model://NAME/x` by the given
/// folders, then upward from the description, then in the search paths; `file://`; else relative to
/// the description. Descriptions are passed on without their packages, so what is nowhere there is
/// looked for near the description by the end of its name.
class MeshPaths {
 public:
  /// `path` is the description.
  MeshPaths(const std::string& path, const UrdfOptions& options);

  /// The file. Errors: NotFound without a rule where there is none, with bytes::kOutsideRule where
  /// it lies outside of what may be read.
  Result<std::string> find(const std::string& written);
  /// Whether the file was found by the end of its name only.
  bool is_guess(const std::string& written) const { return guesses_.count(written) != 0; }
  /// What a person can do about a name that was not found.
  std::string advice(const std::string& written) const;
  /// Folders that files were found in: UrdfOptions::reading had them not.
  const std::vector<std::string>& found_folders() const { return found_folders_; }

 private:
  std::optional<std::string> look_for(const std::string& written);
  std::optional<std::string> find_in_package(const std::string& name, const std::string& rest);
  std::optional<std::string> find_upward(const std::string& name, const std::string& rest);
  std::optional<std::string> find_nearby(const std::string& written);
  bool may_be_read(const std::string& file) const;
  void take_folder(const std::string& folder);
  /// The name that the package.xml of a folder gives; empty without one.
  const std::string& package_name(const std::string& folder);

  std::string path_;
  std::string folder_;
  std::map<std::string, std::string> packages_;
  std::vector<std::string> search_paths_;
  bytes::ReadPolicy reading_;
  std::vector<std::string> found_folders_;
  std::map<std::string, std::string> names_;  // of folders, once read
  std::set<std::string> guesses_;
  std::map<std::string, std::string> seen_in_;  // folders by packages, where files were found
};

}  // namespace tenon::urdf
