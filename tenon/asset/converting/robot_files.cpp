// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each output carries a note with digests of itself and of the files beside it, by which a later
// run sees that somebody edited them. A package holds checksums over its own digest and is
// therefore made twice. Images in no file of their own, and those outside of the folders of the
// output, come along in a folder beside a single layer.
#include "tenon/asset/converting/robot_files.h"

#include <filesystem>
#include <map>
#include <set>

#include "tenon/asset/layers/relative_path.h"
#include "tenon/asset/structure_asset.h"
#include "tenon/asset/updating/base_copy.h"
#include "tenon/asset_policy.h"
#include "tenon/base/content_digest.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/files.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/save_layer.h"
#include "tenon/pack_asset.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

/// Absolute asset paths become relative to the folder of `output`.
void make_relative(layer::Layer& layer, const std::string& output) {
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const auto* asset = entry.spec.get<layer::AssetPath>(layer::fields::default_value);
    if (asset == nullptr || !fs::path(asset->authored).is_absolute()) {
      continue;
    }
    const std::string name = relative_asset_path(asset->authored, folder);
    layer.find(entry.path)
        ->set(layer::fields::default_value, layer::Value(layer::AssetPath{name, "", ""}));
  }
}

std::string name_of_image(const std::string& identifier) {
  const std::string inner = bytes::split_package_path(identifier).inner;
  return inner.empty() ? fs::path(identifier).filename().string() : inner;
}

/// Images of the description's folders that would lie outside of the folders of the output: they
/// have to come along, for the asset to be whole.
convert::InnerImages images_elsewhere(const ConvertedFile& converted, const std::string& output) {
  convert::InnerImages found;
  if (bytes::is_package_name(output)) {
    return found;  // takes them in
  }
  const bytes::ReadPolicy here = policy_for(output, {});
  layer::Layer copy = converted.layer;
  formats::rename_assets(copy, [&](const std::string& asset, formats::AssetUse use, Path) {
    const bool is_file = use == formats::AssetUse::Value && fs::path(asset).is_absolute();
    if (is_file && !converted.images.contains(asset) && !here.allows(asset)) {
      if (const auto contents = converted.reading.open(asset)) {
        found.emplace(asset, std::string((*contents)->text()));
      }
    }
    return asset;
  });
  return found;
}

/// Images, those inside of mesh files for one, get places in a folder of their own beside the
/// output; asset paths follow. The images by their places.
convert::InnerImages place_images(convert::InnerImages images, const std::string& output,
                                  layer::Layer& layer) {
  convert::InnerImages placed;
  if (images.empty()) {
    return placed;
  }
  const fs::path file = bytes::absolute_file_path(output);
  const fs::path folder = file.parent_path() / (file.stem().string() + "_images");
  std::map<std::string, std::string> place_of;
  std::set<std::string> taken;
  for (auto& [identifier, contents] : images) {
    const fs::path name(name_of_image(identifier));
    std::string free = name.string();
    for (int i = 2; !taken.insert(free).second; ++i) {
      free = name.stem().string() + "_" + std::to_string(i) + name.extension().string();
    }
    const std::string place = (folder / free).generic_string();
    placed.emplace(place, std::move(contents));
    place_of.emplace(identifier, place);
  }
  formats::rename_assets(layer, [&](const std::string& asset, formats::AssetUse, Path) {
    const auto place = place_of.find(asset);
    return place == place_of.end() ? asset : place->second;
  });
  return placed;
}

/// Digests of files beside the output, by their names from there.
structure::Digests digests_of(const convert::InnerImages& files, const std::string& output) {
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  structure::Digests digests;
  for (const auto& [place, contents] : files) {
    digests.emplace(fs::path(place).lexically_relative(folder).generic_string(),
                    content_digest(contents));
  }
  return digests;
}

/// A package holds checksums: it is made once to know the digest, once more with it.
Result<std::string> noted_package(layer::Layer layer, const convert::InnerImages& images,
                                  const bytes::ReadPolicy& policy, const std::string& output,
                                  Diagnostics& diagnostics) {
  OpenOptions open;
  open.allowed_reads = policy.roots();
  const std::string name = fs::path(output).filename().string();
  structure::add_note(layer, name, {}, formats::LayerFormat::Package);
  TENON_TRY(const std::string first, pack_layer(layer, output, open, images, diagnostics));
  structure::set_own_digest(layer, structure::own_digest(first, name));
  Diagnostics known;
  return pack_layer(std::move(layer), output, open, images, known);
}

}  // namespace

Result<NotedFiles> robot_files(ConvertedFile converted, const std::string& output,
                               Diagnostics& diagnostics) {
  TENON_TRY(const formats::LayerFormat format, formats::layer_format_for(output));
  converted.images.merge(images_elsewhere(converted, output));
  layer::Layer& layer = converted.layer;
  convert::InnerImages images = place_images(std::move(converted.images), output, layer);
  NotedFiles made;
  if (format == formats::LayerFormat::Package) {  // takes them in
    TENON_TRY(std::string package,
              noted_package(std::move(layer), images, converted.reading, output, diagnostics));
    made.files.push_back({output, std::move(package)});
    return made;
  }
  make_relative(layer, output);
  const std::string name = fs::path(output).filename().string();
  made.beside = digests_of(images, output);
  structure::add_note(layer, name, made.beside, format);
  for (auto& [place, contents] : images) {
    made.files.push_back({place, std::move(contents)});
  }
  TENON_TRY(std::string contents, formats::encode_layer(layer, format));
  structure::seal(contents, name);
  made.files.push_back({output, std::move(contents)});
  made.layer = std::make_shared<const layer::Layer>(std::move(layer));
  TENON_TRY(const structure::Package package, package_of(made, output));
  TENON_TRY(std::string copy, encode_base(package));
  const fs::path place = fs::path(output).parent_path() / structure::copy_place(name);
  made.files.insert(made.files.begin(), {place.string(), std::move(copy)});
  return made;
}

Result<structure::Package> package_of(const NotedFiles& made, const std::string& output) {
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  structure::Package package;
  for (const MadeFile& file : made.files) {
    const std::string name =
        fs::path(bytes::absolute_file_path(file.path)).lexically_relative(folder).generic_string();
    if (!structure::is_copy_place(name)) {
      package.files[name].bytes = bytes::FileBytes::own(file.contents);
      package.interface = name;  // the last one
    }
  }
  structure::PackageFile& opening = package.files[package.interface];
  opening.layer = made.layer;
  TENON_TRY(opening.format, formats::layer_format_for(output));
  return package;
}

Result<structure::StructuredAsset> structured_robot(const ConvertedFile& converted,
                                                    Diagnostics& diagnostics,
                                                    const structure::StructureOptions& options) {
  const convert::InnerImages& images = converted.images;
  structure::AssetSource source = asset_source(converted.layer, converted.reading);
  const auto resolve = source.resolve_asset;
  source.resolve_asset = [&images, resolve](const std::string& asset, const layer::Layer& anchor) {
    return images.contains(asset) ? asset : resolve(asset, anchor);
  };
  const auto open = source.open_asset;
  source.open_asset = [&images,
                       open](const std::string& asset) -> decltype(source.open_asset(asset)) {
    const auto image = images.find(asset);
    if (image == images.end()) {
      return open(asset);
    }
    return bytes::FileBytes::own(image->second);
  };
  return structure::make_package(source, options, diagnostics);
}

}  // namespace tenon
