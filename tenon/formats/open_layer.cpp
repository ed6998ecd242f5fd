// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/open_layer.h"

#include "tenon/base/limits/limits.h"
#include "tenon/bytes/lfs_pointer.h"
#include "tenon/bytes/zip/zip_archive.h"
#include "tenon/formats/crate/reader.h"
#include "tenon/formats/text/reader.h"

namespace tenon::formats {
namespace {

constexpr std::string_view kCrateMagic = "PXR-USDC";

std::string absolute_identifier(const std::string& identifier) {
  const bytes::PackagePath path = bytes::split_package_path(identifier);
  const std::string file = bytes::absolute_file_path(path.package);
  return path.inner.empty() ? file : bytes::join_package_path(file, path.inner);
}

}  // namespace

bool is_layer_name(std::string_view name) {
  return name.ends_with(".usd") || name.ends_with(".usda") || name.ends_with(".usdc");
}

LayerFormat format_of(const bytes::FileBytes& bytes) {
  if (bytes.text().starts_with(kCrateMagic)) {
    return LayerFormat::Crate;
  }
  return bytes::ZipArchive::is_zip(bytes.text()) ? LayerFormat::Package : LayerFormat::Text;
}

/// The root layer of a package is its first file, or that file's root layer where it is a package.
Result<std::shared_ptr<const bytes::FileBytes>> bytes_of_layer(
    std::shared_ptr<const bytes::FileBytes> bytes) {
  for (std::size_t depth = 0; format_of(*bytes) == LayerFormat::Package; ++depth) {
    if (depth == limits::kPackageNesting) {
      return Error(ErrorCode::Limit, "packages are nested too deeply");
    }
    TENON_TRY(const bytes::ZipArchive archive, bytes::ZipArchive::open(std::move(bytes)));
    if (archive.entries().empty()) {
      return Error(ErrorCode::Corrupt, "the package is empty").with_rule("package.empty");
    }
    TENON_TRY(bytes, archive.read(archive.entries().front()));
  }
  return bytes;
}

Result<layer::Layer> read_layer(std::shared_ptr<const bytes::FileBytes> bytes,
                                std::string identifier, Diagnostics& diagnostics) {
  if (format_of(*bytes) == LayerFormat::Package) {
    auto root = bytes_of_layer(std::move(bytes));
    if (!root) {
      return std::move(root).error().in_file(identifier);
    }
    bytes = *std::move(root);
  }
  if (format_of(*bytes) == LayerFormat::Crate) {
    return read_crate(std::move(bytes), std::move(identifier), diagnostics);
  }
  TENON_CHECK(bytes::check_no_lfs_pointer(bytes->text(), identifier));
  return read_text(bytes->text(), std::move(identifier), diagnostics);
}

Result<layer::Layer> open_layer_file(const bytes::AssetResolver& resolver,
                                     const std::string& identifier, Diagnostics& diagnostics) {
  std::string absolute = absolute_identifier(identifier);
  auto bytes = resolver.open(absolute);
  if (!bytes) {
    return std::move(bytes).error().in_file(identifier);
  }
  return read_layer(*std::move(bytes), std::move(absolute), diagnostics);
}

Result<layer::Layer> open_layer_file(const std::string& identifier, Diagnostics& diagnostics) {
  return open_layer_file(bytes::AssetResolver(), identifier, diagnostics);
}

Result<layer::LayerPtr> LayerRegistry::open_root(const std::string& path) {
  const std::string identifier = absolute_identifier(path);
  const std::string file = bytes::split_package_path(identifier).package;
  const std::lock_guard lock(mutex_);
  bytes::ResolverOptions options = resolver_.options();
  options.search_paths.insert(options.search_paths.begin(), file.substr(0, file.rfind('/') + 1));
  resolver_ = bytes::AssetResolver(std::move(options));
  return open_identifier(identifier);
}

Result<layer::LayerPtr> LayerRegistry::open(const std::string& asset_path,
                                            const layer::Layer* anchor) {
  const std::lock_guard lock(mutex_);
  if (const auto known = layers_.find(asset_path); known != layers_.end()) {
    return known->second;
  }
  TENON_TRY(const std::string identifier,
            resolver_.resolve(asset_path, anchor == nullptr ? "" : anchor->identifier()));
  return open_identifier(identifier);
}

void LayerRegistry::insert(layer::LayerPtr layer) {
  const std::lock_guard lock(mutex_);
  layers_.insert_or_assign(layer->identifier(), Result<layer::LayerPtr>(layer));
}

std::vector<std::string> LayerRegistry::opened() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> identifiers;
  for (const auto& [identifier, layer] : layers_) {
    if (layer) {
      identifiers.push_back(identifier);
    }
  }
  return identifiers;
}

Diagnostics LayerRegistry::diagnostics() const {
  const std::lock_guard lock(mutex_);
  return diagnostics_;
}

Result<layer::LayerPtr> LayerRegistry::open_identifier(const std::string& identifier) {
  const auto known = layers_.find(identifier);
  if (known != layers_.end()) {
    return known->second;
  }
  Result<layer::Layer> layer = open_layer_file(resolver_, identifier, diagnostics_);
  Result<layer::LayerPtr> opened =
      layer ? Result<layer::LayerPtr>(std::make_shared<const layer::Layer>(*std::move(layer)))
            : Result<layer::LayerPtr>(std::move(layer).error());
  return layers_.emplace(identifier, std::move(opened)).first->second;
}

}  // namespace tenon::formats
