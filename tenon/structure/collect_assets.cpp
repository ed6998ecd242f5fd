// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/collect_assets.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "tenon/base/file_finding.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTilePattern = "<UDIM>";
constexpr int kFirstTile = 1001;
constexpr int kLastTile = 1100;

/// A file, or the tiles of a pattern: what replaces the pattern -> bytes.
using Files = std::map<std::string, std::shared_ptr<const bytes::FileBytes>>;

/// Without folders; of a file in packages within packages, `a.usdz[b.usdz[c/d.png]]`, its own.
std::string file_name_of(const std::string& asset) {
  bytes::PackagePath path = bytes::split_package_path(asset);
  while (!path.inner.empty()) {
    path = bytes::split_package_path(path.inner);
  }
  return fs::path(path.package).filename().string();
}

class Collector {
 public:
  Collector(const AssetSource& source, Names names, Package& package, Diagnostics& diagnostics)
      : source_(source), names_(names), package_(package), diagnostics_(diagnostics) {}

  CollectedAssets run() {
    std::vector<std::string> layers;
    for (const auto& [name, file] : package_.files) {
      if (file.layer != nullptr) {
        layers.push_back(name);
      }
    }
    for (const std::string& name : layers) {
      layer::Layer layer = *package_.files.at(name).layer;
      const fs::path folder = fs::path(name).parent_path();
      const bool changed = formats::rename_assets(
          layer, [&](const std::string& asset, formats::AssetUse use, Path at) {
            return use == formats::AssetUse::Value ? renamed(asset, folder, at) : asset;
          });
      if (changed) {
        package_.files.at(name).layer = std::make_shared<layer::Layer>(std::move(layer));
      }
    }
    return std::move(places_);
  }

 private:
  std::string renamed(const std::string& asset, const fs::path& folder, Path at) {
    if (!fs::path(asset).is_absolute()) {
      return asset;  // it was found nowhere: a module that comes with the renderer, or missing
    }
    const auto known = places_.find(asset);
    std::string place = known == places_.end() ? collect(asset, at) : known->second;
    places_[asset] = place;
    place = fs::path(place).lexically_relative(folder).generic_string();
    return place.starts_with("../") ? place : "./" + place;
  }

  std::string collect(const std::string& asset, Path at) {
    const Files files = read(asset);
    const std::string place = free_place(file_name_of(asset), files);
    if (files.empty()) {
      Diagnostic missing =
          file_finding(Severity::Warning, "structure.asset-missing",
                       "the asset @" + asset + "@ cannot be read and is not collected", "", 0,
                       "put the file to " + place + " in the new folder, or correct the path");
      missing.prim = at.prim().str();
      missing.property = at.name().str();
      diagnostics_.add(std::move(missing));
      missing_.insert(place);
      return place;
    }
    for (const auto& [tile, bytes] : files) {
      package_.files[with_tile(place, tile)].bytes = bytes;
    }
    return place;
  }

  Files read(const std::string& asset) const {
    Files files;
    if (asset.find(kTilePattern) == std::string::npos) {
      if (auto bytes = source_.open_asset(asset)) {
        files.emplace("", *std::move(bytes));
      }
      return files;
    }
    for (int tile = kFirstTile; tile <= kLastTile; ++tile) {
      if (auto bytes = source_.open_asset(with_tile(asset, std::to_string(tile)))) {
        files.emplace(std::to_string(tile), *std::move(bytes));
      }
    }
    return files;
  }

  /// The name in the folder, with a number where another file has it.
  std::string free_place(const std::string& name, const Files& files) const {
    const fs::path path(name);
    const bool module = path.extension() == ".mdl" && names_ == Names::Tutorial;
    const std::string folder = module ? "Materials/" : "Textures/";
    std::string place = folder + name;
    for (int i = 2; !is_free(place, files); ++i) {
      place = folder + path.stem().string() + "_" + std::to_string(i) + path.extension().string();
    }
    return place;
  }

  bool is_free(const std::string& place, const Files& files) const {
    if (missing_.contains(place) || (files.empty() && is_taken(place))) {
      return false;
    }
    for (const auto& [tile, bytes] : files) {
      const auto there = package_.files.find(with_tile(place, tile));
      if (there != package_.files.end() && there->second.bytes->text() != bytes->text()) {
        return false;
      }
    }
    return true;
  }

  bool is_taken(const std::string& place) const {
    return std::any_of(places_.begin(), places_.end(),
                       [&](const auto& known) { return known.second == place; });
  }

  static std::string with_tile(std::string path, const std::string& tile) {
    const std::size_t at = path.find(kTilePattern);
    if (at != std::string::npos && !tile.empty()) {
      path.replace(at, kTilePattern.size(), tile);
    }
    return path;
  }

  const AssetSource& source_;
  Names names_;
  Package& package_;
  Diagnostics& diagnostics_;
  CollectedAssets places_;
  std::set<std::string> missing_;  // places that are kept for what cannot be read
};

}  // namespace

CollectedAssets collect_assets(const AssetSource& source, Names names, Package& package,
                               Diagnostics& diagnostics) {
  return Collector(source, names, package, diagnostics).run();
}

layer::Layer with_collected_assets(const layer::Layer& content, const CollectedAssets& assets) {
  layer::Layer renamed = content;
  formats::rename_assets(renamed, [&](const std::string& asset, formats::AssetUse use, Path) {
    const auto place = assets.find(asset);
    return use == formats::AssetUse::Value && place != assets.end()
               ? identifier_in_package(place->second)
               : asset;
  });
  return renamed;
}

}  // namespace tenon::structure
