// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bytes/read_policy.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/base/limits/reading_limits.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/bytes/asset_resolver.h"

namespace tenon::bytes {

namespace fs = std::filesystem;

ReadPolicy::ReadPolicy(const std::vector<std::string>& folders, Files files)
    : files_(std::move(files)) {
  for (const std::string& folder : folders) {
    add(folder);
  }
}

void ReadPolicy::add(const std::string& folder) {
  const std::string named = folder.empty() ? "." : folder;
  if (files_->kind(named) == NameKind::Nothing) {
    return;
  }
  const std::string real = files_->real_path(named);
  if (std::find(roots_.begin(), roots_.end(), real) == roots_.end()) {
    roots_.push_back(real);
  }
}

void ReadPolicy::add_found(const std::string& folder) {
  if (!is_closed_) {
    add(folder);
  }
}

bool ReadPolicy::allows_real(const std::string& real) const {
  return std::any_of(roots_.begin(), roots_.end(), [&](const std::string& root) {
    return real == root || real.starts_with(root == "/" ? root : root + "/");
  });
}

bool ReadPolicy::allows(const std::string& path) const {
  return allows_real(files_->real_path(split_package_path(path).package));
}

Result<void> ReadPolicy::check_real(const std::string& real, const std::string& path) const {
  if (allows_real(real)) {
    return {};
  }
  const std::string leads = real == path ? "" : ", which leads to " + real + ",";
  return Error(ErrorCode::NotFound,
               "@" + path + "@" + leads + " is outside of the folders that the asset may read")
      .with_rule(kOutsideRule)
      .with_fix("if it is meant to go into the result, give --allow-read " +
                shell_word(fs::path(real).parent_path().string()));
}

Result<void> ReadPolicy::check(const std::string& path) const {
  const std::string file = split_package_path(path).package;
  return check_real(files_->real_path(file), absolute_file_path(file));
}

Result<std::shared_ptr<const FileBytes>> ReadPolicy::open(const std::string& identifier) const {
  TENON_CHECK(check(identifier));
  const std::string file = absolute_file_path(split_package_path(identifier).package);
  FileRules rules;
  rules.check = [&](const std::string& real) { return check_real(real, file); };
  rules.max_bytes = limits::kCopiedFileBytes;
  return open_identifier(files_, identifier, rules);
}

}  // namespace tenon::bytes
