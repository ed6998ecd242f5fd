// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each asset path of the package's layers leads to one place in the package, however often the
// asset is named. Assets with the same file name share a place when their bytes are equal, else the
// later one gets a number. The tiles of a pattern go together: a place has to suit all of them. An
// asset that cannot be read keeps a place to itself, so that it can be put there later. The source
// is not trusted: what it may not read is refused and reported, and so is what is no kind of media,
// unless it lies in the asset's own package.
#include "tenon/structure/make/collect_assets.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "tenon/base/file_finding.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/bytes/read_policy.h"
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
  std::string renamed(const std::string& authored, const fs::path& folder, Path at) {
    std::string asset =
        authored.starts_with("file:") ? bytes::plain_asset_path(authored) : authored;
    if (!fs::path(asset).is_absolute()) {
      const std::string found = found_elsewhere(asset);
      if (found.empty()) {
        report_unknown(asset, at);
        return asset;
      }
      asset = found;
    }
    const auto known = places_.find(asset);
    std::string place = known == places_.end() ? collect(asset, at) : known->second;
    places_[asset] = place;
    places_[authored] = place;
    place = fs::path(place).lexically_relative(folder).generic_string();
    return place.starts_with("../") ? place : "./" + place;
  }

  /// What is not in the folder of its layer: in the working directory or on a search path. Of a
  /// pattern, where a tile is.
  std::string found_elsewhere(const std::string& asset) const {
    const layer::Layer nowhere("");
    if (asset.find(kTilePattern) == std::string::npos) {
      return source_.resolve_asset(asset, nowhere);
    }
    for (int tile = kFirstTile; tile <= kLastTile; ++tile) {
      const std::string name = with_tile(asset, std::to_string(tile));
      const std::string found = source_.resolve_asset(name, nowhere);
      if (found.ends_with(name)) {
        return found.substr(0, found.size() - name.size()) + asset;
      }
    }
    return {};
  }

  /// Modules of materials come with renderers, which find them by themselves.
  void report_unknown(const std::string& asset, Path at) {
    const std::string ending = fs::path(asset).extension().string();
    const bool is_module =
        ending == ".mdl" || ending == ".glslfx" || ending == ".osl" || ending == ".oso";
    if (!is_module && unknown_.insert(asset).second) {
      report(Severity::Warning, "structure.asset-missing",
             "the asset @" + asset + "@ cannot be found and is not collected",
             "give its folder with --search-path, or correct the path", at);
    }
  }

  std::string collect(const std::string& asset, Path at) {
    const Files files = read(asset);
    const std::string place = free_place(file_name_of(asset), files);
    for (const Error& refusal : std::exchange(refusals_, {})) {
      report(Severity::Error, refusal.diagnostic().rule.c_str(),
             refusal.message() + "; it is not collected", refusal.diagnostic().fix, at);
    }
    if (files.empty()) {
      if (!is_refused_) {
        report(Severity::Warning, "structure.asset-missing",
               "the asset @" + asset + "@ cannot be read and is not collected",
               "put the file at " + place + " in the new folder, or correct the path", at);
      }
      missing_.insert(place);
      return place;
    }
    for (const auto& [tile, bytes] : files) {
      package_.files[with_tile(place, tile)].bytes = bytes;
    }
    return place;
  }

  void report(Severity severity, const char* rule, std::string message, std::string fix, Path at) {
    Diagnostic finding = file_finding(severity, rule, std::move(message),
                                      source_.root->identifier(), 0, std::move(fix));
    finding.prim = at.prim().str();
    finding.property = at.name().str();
    diagnostics_.add(std::move(finding));
  }

  Files read(const std::string& asset) {
    Files files;
    is_refused_ = false;
    if (asset.find(kTilePattern) == std::string::npos) {
      read(asset, "", files);
      return files;
    }
    for (int tile = kFirstTile; tile <= kLastTile; ++tile) {
      read(with_tile(asset, std::to_string(tile)), std::to_string(tile), files);
    }
    return files;
  }

  /// What may not be read, and what is no texture or the like, is remembered in `refusals_`.
  void read(const std::string& file, const std::string& tile, Files& files) {
    auto bytes = source_.open_asset(file);
    if (bytes && (is_own(file) || bytes::kind_of((*bytes)->text()) != bytes::FileKind::Unknown)) {
      files.emplace(tile, *std::move(bytes));
      return;
    }
    if (bytes) {
      is_refused_ = true;
      refusals_.push_back(bytes::not_media(file));
    } else if (is_there(file, bytes.error())) {
      is_refused_ = true;
      refusals_.push_back(bytes::not_read(file, std::move(bytes).error()));
    }
  }

  /// In the asset's own package: nobody else's file, whatever it is.
  bool is_own(const std::string& file) const {
    const std::string& root = source_.root->identifier();
    return bytes::is_in_package(root) &&
           file.starts_with(bytes::split_package_path(root).package + "[");
  }

  /// Tiles of a pattern, for one, need not be there.
  bool is_there(const std::string& asset, const Error& error) const {
    if (error.diagnostic().rule != bytes::kOutsideRule) {
      return error.code() != ErrorCode::NotFound;
    }
    return source_.files->kind(bytes::split_package_path(asset).package) !=
           bytes::NameKind::Nothing;
  }
  /// The name in the folder, with a number where another file has it.
  std::string free_place(const std::string& name, const Files& files) const {
    const fs::path path(name);
    const bool module = path.extension() == ".mdl" && names_ == Names::Tutorial;
    const bool shape =
        !files.empty() && bytes::kind_of(files.begin()->second->text()) == bytes::FileKind::Shape;
    const std::string folder = module ? "Materials/" : shape ? "Meshes/" : "Textures/";
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
  std::vector<Error> refusals_;    // of the asset at hand, not yet reported
  bool is_refused_ = false;        // something of the asset at hand was refused
  std::set<std::string> unknown_;  // names that were found nowhere
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
