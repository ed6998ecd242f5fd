// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A name has candidates in a fixed order, and the first that exists counts: beside the layer that
// names it, in the working directory, in the search paths. In a package the folder of the layer
// comes first, then that of the root layer, then files outside, where "./" never leads. Identifiers
// nest packages in brackets and are opened from the outside in, to a bounded depth. A sandbox
// judges the real path, when a name is resolved and once more on the open file, because links may
// change between the two.
#include "tenon/bytes/asset_resolver.h"

#include <algorithm>
#include <filesystem>

#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/reading_limits.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {
namespace {

bool is_absolute(std::string_view path) { return path.starts_with('/'); }
bool is_file_relative(std::string_view path) {
  return path.starts_with("./") || path.starts_with("../");
}

/// "a/b/c" -> "a/b/", "c" -> "".
std::string_view folder_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : path.substr(0, slash + 1);
}

std::string normal(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().string();
}

int hex_digit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/// "%20" becomes a blank, and so on.
std::string percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
                        hex_digit(text[i + 2]) >= 0;
    if (escape) {
      result += static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2]));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

Error not_found(const std::string& asset_path, const std::string& anchor) {
  return Error(ErrorCode::NotFound,
               "cannot find @" + asset_path + "@" + (anchor.empty() ? "" : " named in " + anchor))
      .with_rule("layer.not-found");
}

/// The innermost file that `identifier` names: its package (an identifier) and its name there.
PackagePath split_innermost(const std::string& identifier) {
  PackagePath outer = split_package_path(identifier);
  if (outer.inner.empty()) {
    return outer;
  }
  const PackagePath below = split_innermost(outer.inner);
  if (below.inner.empty()) {
    return outer;
  }
  return {join_package_path(outer.package, below.package), below.inner};
}

Result<ZipArchive> open_package(const AssetResolver& resolver, const std::string& package) {
  TENON_TRY(std::shared_ptr<const FileBytes> bytes, resolver.open(package));
  auto archive = ZipArchive::open(std::move(bytes));
  if (!archive) {
    return std::move(archive).error().in_file(package);
  }
  return archive;
}

}  // namespace

std::string plain_asset_path(const std::string& path) {
  constexpr std::string_view kArguments = ":SDF_FORMAT_ARGS:";
  constexpr std::string_view kScheme = "file:";
  std::string_view plain = path;
  if (const std::size_t at = plain.find(kArguments); at != std::string_view::npos) {
    plain = plain.substr(0, at);
  }
  if (!plain.starts_with(kScheme)) {
    return std::string(plain);
  }
  plain.remove_prefix(kScheme.size());
  for (const std::string_view host : {"//localhost/", "///"}) {
    if (plain.starts_with(host)) {
      plain.remove_prefix(host.size() - 1);
    }
  }
  return percent_decoded(plain);
}

PackagePath split_package_path(std::string_view path) {
  const std::size_t open = path.find('[');
  if (open == std::string_view::npos || open == 0 || !path.ends_with(']')) {
    return {std::string(path), ""};
  }
  return {std::string(path.substr(0, open)),
          std::string(path.substr(open + 1, path.size() - open - 2))};
}

std::string join_package_path(std::string_view package, std::string_view inner) {
  if (package.ends_with(']')) {  // into the innermost brackets
    const PackagePath outer = split_package_path(package);
    return outer.package + "[" + join_package_path(outer.inner, inner) + "]";
  }
  return std::string(package) + "[" + std::string(inner) + "]";
}

bool is_package_name(std::string_view path) {
  if (path.size() < 5) {
    return false;
  }
  std::string ending(path.substr(path.size() - 5));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending == ".usdz";
}

bool is_in_package(std::string_view path) {
  return !split_package_path(path).inner.empty() || is_package_name(path);
}

Result<std::string> AssetResolver::resolve(const std::string& asset_path,
                                           const std::string& anchor) const {
  if (asset_path.empty()) {
    return Error(ErrorCode::Invalid, "an empty asset path").with_rule("layer.not-found");
  }
  if (asset_path.size() > limits::kPathTextLength || asset_path.find('\0') != std::string::npos) {
    return Error(ErrorCode::Invalid, "an asset path that cannot be a file's")
        .with_rule("layer.not-found");
  }
  const PackagePath wanted = split_package_path(plain_asset_path(asset_path));
  TENON_TRY(std::string file, is_in_package(anchor) && !is_absolute(wanted.package)
                                  ? resolve_in_package(wanted.package, anchor)
                                  : resolve_file(wanted.package, anchor));
  if (wanted.inner.empty()) {
    return file;
  }
  std::string inner = join_package_path(file, wanted.inner);
  TENON_CHECK(open(inner));
  return inner;
}

Result<std::string> AssetResolver::resolve_file(const std::string& asset_path,
                                                const std::string& anchor) const {
  std::vector<std::string> candidates;
  if (is_absolute(asset_path)) {
    candidates.push_back(asset_path);
  } else {
    if (is_absolute(anchor)) {
      const std::string outer = split_package_path(anchor).package;
      candidates.push_back(std::string(folder_of(outer)) + asset_path);
    }
    if (!is_absolute(anchor) || !is_file_relative(asset_path)) {
      candidates.push_back(asset_path);
    }
    if (!is_file_relative(asset_path)) {
      for (const std::string& folder : options_.search_paths) {
        candidates.push_back(folder + "/" + asset_path);
      }
    }
  }
  for (const std::string& candidate : candidates) {
    if (options_.files->kind(candidate) == NameKind::File) {
      std::string file = absolute_file_path(candidate);
      TENON_CHECK(check_sandbox(file));
      return file;
    }
  }
  return not_found(asset_path, anchor);
}

Result<std::string> AssetResolver::resolve_in_package(const std::string& asset_path,
                                                      const std::string& anchor) const {
  PackagePath at = split_innermost(anchor);
  // A package itself: its root layer, which is its first file or that file's root layer.
  for (std::size_t depth = 0; at.inner.empty() || is_package_name(at.inner); ++depth) {
    at.package = at.inner.empty() ? at.package : join_package_path(at.package, at.inner);
    TENON_TRY(const ZipArchive archive, open_package(*this, at.package));
    if (archive.entries().empty() || depth == limits::kPackageNesting) {
      return not_found(asset_path, anchor);
    }
    at.inner = archive.entries().front().name;
  }
  TENON_TRY(const ZipArchive archive, open_package(*this, at.package));
  const std::string candidate = normal(std::string(folder_of(at.inner)) + asset_path);
  if (archive.find(candidate) != nullptr) {
    return join_package_path(at.package, candidate);
  }
  if (!is_file_relative(asset_path)) {
    const std::string root = archive.entries().empty() ? "" : archive.entries().front().name;
    const std::string beside_root = normal(std::string(folder_of(root)) + asset_path);
    if (archive.find(beside_root) != nullptr) {
      return join_package_path(at.package, beside_root);
    }
    if (Result<std::string> found = resolve_file(asset_path, "")) {
      return found;
    }
  }
  return not_found(asset_path, anchor);
}

Result<void> AssetResolver::check_sandbox(const std::string& file) const {
  return options_.roots.empty() ? Result<void>() : check_real_path(options_.files->real_path(file));
}

Result<void> AssetResolver::check_real_path(const std::string& real) const {
  if (sandbox_.allows_real(real)) {
    return {};
  }
  return Error(ErrorCode::NotFound, "@" + real + "@ is outside the folders that may be read")
      .with_rule("layer.outside")
      .with_fix("add its folder to the roots of the sandbox, if it may be read");
}

Result<std::shared_ptr<const FileBytes>> AssetResolver::open(const std::string& identifier) const {
  TENON_CHECK(check_sandbox(split_package_path(identifier).package));
  FileRules rules;
  if (!options_.roots.empty()) {
    // Checked again once it is open: the path may name another file by then. Third-party files,
    // which others may shorten, are not mapped.
    rules.check = [this](const std::string& real) { return check_real_path(real); };
    rules.may_map = false;
    rules.max_bytes = limits::kCopiedFileBytes;
  }
  return open_identifier(options_.files, identifier, rules);
}

Result<std::shared_ptr<const FileBytes>> open_identifier(const Files& files,
                                                         const std::string& identifier,
                                                         const FileRules& rules) {
  PackagePath path = split_package_path(identifier);
  TENON_TRY(std::shared_ptr<const FileBytes> bytes, files->open(path.package, rules));
  for (std::size_t depth = 0; !path.inner.empty(); ++depth) {
    if (depth == limits::kPackageNesting) {
      return Error(ErrorCode::Limit, "packages are nested too deeply").in_file(identifier);
    }
    auto archive = ZipArchive::open(std::move(bytes));
    if (!archive) {
      return std::move(archive).error().in_file(path.package);
    }
    path = split_package_path(path.inner);
    const ZipEntry* entry = archive->find(path.package);
    if (entry == nullptr) {
      return Error(ErrorCode::NotFound, "the package has no file \"" + path.package + "\"")
          .in_file(identifier)
          .with_rule("layer.not-found");
    }
    auto contents = archive->read(*entry);
    if (!contents) {
      return std::move(contents).error().in_file(identifier);
    }
    bytes = *std::move(contents);
  }
  return bytes;
}

}  // namespace tenon::bytes
