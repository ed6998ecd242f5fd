// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/read_policy.h"

/// From asset paths as layers name them to files. The rules are those of OpenUSD's default
/// resolver (26.11).
namespace tenon::bytes {

/// An identifier names a file by its absolute path, `/a/b.usda`, or a file in a package,
/// `/a/b.usdz[c/d.usda]`, packages in packages nested: `/a/b.usdz[c.usdz[d.usda]]`.

struct PackagePath {
  std::string package;  ///< the outer file
  std::string inner;    ///< the part in brackets; empty for a path without any
};
/// Splits at the outermost brackets.
PackagePath split_package_path(std::string_view path);
std::string join_package_path(std::string_view package, std::string_view inner);
/// True for a name that ends in ".usdz", whatever its case.
bool is_package_name(std::string_view path);
/// True for what is in a package, and for a package itself.
bool is_in_package(std::string_view path);

struct ResolverOptions {
  /// Folders that `x.usda` (without "./") is looked up in, after the anchor's folder and the
  /// working directory.
  std::vector<std::string> search_paths;
  /// When not empty: no file outside of these folders, symbolic links followed; files are copied
  /// rather than mapped.
  std::vector<std::string> roots;
  Files files = {};  ///< where all of them are looked up
};

/// `path` as a plain file name: a `file:` URI becomes a path; file format arguments
/// (":SDF_FORMAT_ARGS:...") are removed, since they change nothing for layers of USD.
std::string plain_asset_path(const std::string& path);

/// "./x.usda" and "../x.usda" are taken from the anchor's folder; "x.usda" too, then from the
/// working directory, then from the search paths. The anchor's folder may be one in a package,
/// which relative paths cannot leave; there the folder of the package's root layer comes second.
class AssetResolver {
 public:
  AssetResolver() = default;
  explicit AssetResolver(ResolverOptions options)
      : options_(std::move(options)), sandbox_(options_.roots, options_.files) {}

  const ResolverOptions& options() const { return options_; }

  /// The identifier that `asset_path`, authored in the layer `anchor` (an identifier; "" or a
  /// made-up name: the working directory), means. ErrorCode::NotFound names what was looked for.
  Result<std::string> resolve(const std::string& asset_path, const std::string& anchor) const;

  /// The bytes of what `identifier` names.
  Result<std::shared_ptr<const FileBytes>> open(const std::string& identifier) const;

 private:
  Result<std::string> resolve_file(const std::string& asset_path, const std::string& anchor) const;
  Result<std::string> resolve_in_package(const std::string& asset_path,
                                         const std::string& anchor) const;
  Result<void> check_sandbox(const std::string& file) const;
  Result<void> check_real_path(const std::string& real) const;

  ResolverOptions options_;
  ReadPolicy sandbox_;  // of options_.roots
};

/// The bytes of what `identifier` names, without a sandbox. `rules` are for the outer file.
Result<std::shared_ptr<const FileBytes>> open_identifier(const Files& files,
                                                         const std::string& identifier,
                                                         const FileRules& rules = {});

}  // namespace tenon::bytes
