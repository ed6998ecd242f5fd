// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/sdf/read_sdf.h"
#include "tenon/sdf/sdf_file.h"

/// Internal to this folder.
namespace tenon::sdf {

/// The files of a description: those it includes, and meshes and images that these name. A folder
/// with a model.config is a model of Gazebo, and may be read as a ROS package may.
class ModelFiles {
 public:
  ModelFiles(const SdfOptions& options, Diagnostics& diagnostics)
      : options_(options), reading_(options.reading), diagnostics_(diagnostics) {}

  /// The file that was asked for.
  Result<SdfFile*> open_main(std::string_view text, const std::string& path);
  /// The description that `uri` of an <include> leads to, seen from `from`: a file, or a folder
  /// with a model.config or a model.sdf. Parsed once. Errors: NotFound without a rule; under
  /// bytes::kOutsideRule; of reading; Limit kSdfIncludedBytes.
  Result<SdfFile*> open_included(const std::string& uri, const SdfFile& from);
  /// A mesh or an image. `is_guess`: found by the end of its name. Errors: NotFound without a rule,
  /// under bytes::kOutsideRule.
  Result<std::string> find(const std::string& uri, const SdfFile& from, bool& is_guess);
  /// What a person can do about a name that was not found.
  static std::string advice(const std::string& uri);
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Folders that files were found in, beside those of the options.
  const std::vector<std::string>& found_folders() const { return found_folders_; }

 private:
  std::optional<std::string> path_of(const std::string& uri, const SdfFile& from);
  std::optional<std::string> path_in_model(const std::string& name, const std::string& rest,
                                           const SdfFile& from);
  bool exists(const std::string& path) const;
  void take_folder(const std::string& folder);
  std::string description_in(const std::string& folder);

  const SdfOptions& options_;
  bytes::ReadPolicy reading_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::unique_ptr<SdfFile>> files_;  // by path
  std::size_t included_bytes_ = 0;
  std::vector<std::string> found_folders_;
};

}  // namespace tenon::sdf
