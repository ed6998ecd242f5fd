// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The layers of an asset form a graph with an edge from each layer to every layer that it names. A
// worklist opens each of them once. A copy elsewhere takes the root layer and, by a fixed point
// over the edges, every layer that is edited or that names one that moves, because it has to name
// the copy. Edges to the root layer do not count. Whatever does not move stays where it is: asset
// paths of the copies lead to other copies where there are some, else back to the original files.
#include "tenon/asset/layers/asset_layers.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "tenon/asset/edited_file.h"
#include "tenon/asset/layers/output_place.h"
#include "tenon/asset/layers/relative_path.h"
#include "tenon/asset_policy.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/formats/save_layer.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

struct LayerNames {
  std::set<std::string> names;  ///< as the layer writes them
  bool patterns = false;        ///< clips by a template for names
};

LayerNames layer_names(layer::Layer layer) {
  LayerNames named;
  formats::rename_assets(layer, [&](const std::string& name, formats::AssetUse use, Path) {
    if (use == formats::AssetUse::Layer && !name.empty()) {
      named.names.insert(name);
    }
    named.patterns = named.patterns || use == formats::AssetUse::ClipTemplate;
    return name;
  });
  return named;
}

}  // namespace

struct AssetLayers::Search {
  const OpenOptions& options;
  bytes::ReadPolicy policy;
  std::map<std::string, std::size_t> known;  // index by identifier
};

/// The index of the layer that `from` names, which is opened where it is new.
std::optional<std::size_t> AssetLayers::named_layer(const std::string& name,
                                                    const layer::Layer& from, Search& search) {
  const auto identifier = resolver_.resolve(name, from.identifier());
  if (!identifier) {  // a missing layer holds no physics
    if (identifier.error().diagnostic().rule == "layer.outside") {
      refused_.add(identifier.error().diagnostic());
    }
    return std::nullopt;
  }
  if (!search.policy.allows(*identifier)) {
    outside_.insert(*identifier);
    return std::nullopt;
  }
  if (const auto known = search.known.find(*identifier); known != search.known.end()) {
    return known->second;
  }
  Diagnostics ignored;  // opening the stage reports them
  auto opened = open_layer(*identifier, search.options, ignored);
  if (!opened) {
    return std::nullopt;
  }
  layers_.push_back({*std::move(opened), nullptr});
  return search.known.emplace(*identifier, layers_.size() - 1).first->second;
}

Result<AssetLayers> AssetLayers::open(const std::string& path, const OpenOptions& options) {
  AssetLayers asset;
  Search search{options, policy_for(path, options), {}};
  Diagnostics ignored;  // opening the stage reports them
  TENON_TRY(layer::LayerPtr root, open_layer(path, options, ignored));
  bytes::ResolverOptions resolving = resolver_options(options);
  const std::string file = bytes::split_package_path(root->identifier()).package;
  resolving.search_paths.insert(resolving.search_paths.begin(),
                                file.substr(0, file.rfind('/') + 1));  // as composition has it
  asset.resolver_ = bytes::AssetResolver(std::move(resolving));
  search.known.emplace(root->identifier(), 0);
  asset.layers_.push_back({std::move(root), nullptr});
  for (std::size_t i = 0; i < asset.layers_.size(); ++i) {
    const layer::LayerPtr from = asset.layers_[i].layer;
    const LayerNames named = layer_names(*from);
    std::vector<std::size_t> leads_to;
    for (const std::string& name : named.names) {
      if (const auto other = asset.named_layer(name, *from, search)) {
        leads_to.push_back(*other);
      }
    }
    asset.is_whole_ = asset.is_whole_ && !named.patterns && leads_to.size() == named.names.size();
    asset.leads_to_.push_back(std::move(leads_to));
  }
  return asset;
}

/// One file; a text that loses its layout is noted under the name of its original.
Result<MadeFile> AssetLayers::made(const layer::Layer& layer, const std::string& original,
                                   const std::string& file) {
  TENON_TRY(LayerContents made, edited_contents(layer, file, resolver_.options().files));
  if (!made.kept_layout) {
    without_layout_.push_back(original);
  }
  return MadeFile{file, std::move(made.contents)};
}

Result<MadeFiles> AssetLayers::in_place() {
  MadeFiles files;
  for (const AssetLayer& part : layers_) {
    if (part.edited != nullptr && bytes::is_in_package(part.layer->identifier())) {
      return Error(ErrorCode::Unsupported,
                   "files in a package cannot be edited in place: " + part.layer->identifier())
          .with_fix("give -o FILE");
    }
  }
  for (const AssetLayer& part : layers_) {
    if (part.edited != nullptr) {
      const std::string& file = part.layer->identifier();
      TENON_TRY(MadeFile one, made(*part.edited, file, file));
      files.push_back(std::move(one));
    }
  }
  return files;
}

/// Where copies go, by identifier of the original: the root layer and all that lead to an edit.
std::map<std::string, std::string> AssetLayers::new_places(const std::string& output) const {
  std::vector<char> moves(layers_.size(), 0);
  moves[0] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      bool needed = moves[i] != 0 || layers_[i].edited != nullptr;
      for (const std::size_t other : leads_to_[i]) {
        needed = needed || (other != 0 && moves[other] != 0);
      }
      changed = changed || (needed && moves[i] == 0);
      moves[i] = needed ? 1 : 0;
    }
  }
  const fs::path target = bytes::absolute_file_path(root_output(output, *layers_[0].layer));
  const fs::path beside = target.parent_path();
  const fs::path folder = names_folder(output) ? beside : beside / (target.stem() += "_layers");
  const fs::path home = fs::path(layers_[0].layer->identifier()).parent_path();
  std::map<std::string, std::string> places;
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const std::string& identifier = layers_[i].layer->identifier();
    if (moves[i] == 0) {
      continue;
    }
    fs::path name = fs::path(identifier).lexically_relative(home);
    if (bytes::is_in_package(identifier) || name.empty() || *name.begin() == "..") {
      name = fs::path(std::to_string(i)) / (fs::path(identifier).stem().string() + ".usda");
    }
    places[identifier] = i == 0 ? target.string() : (folder / name).lexically_normal().string();
  }
  return places;
}

/// A folder may hold the asset itself, whose layers must not be replaced.
Result<void> AssetLayers::check_apart(const std::map<std::string, std::string>& places) const {
  const bytes::Files& files = resolver_.options().files;
  for (const auto& [from, to] : places) {
    const bool is_own = std::any_of(layers_.begin(), layers_.end(), [&](const AssetLayer& part) {
      return files->real_path(part.layer->identifier()) == files->real_path(to);
    });
    if (is_own) {
      return Error(ErrorCode::Invalid, "the result would replace a layer of the asset itself")
          .in_file(to)
          .with_fix("name another place, or give --in-place");
    }
  }
  return {};
}

/// Asset paths of a layer that moves: to copies where there are some, else to the old files.
void AssetLayers::rename(layer::Layer& layer, const std::string& from, const std::string& to,
                         const std::map<std::string, std::string>& places) const {
  const std::string folder = fs::path(to).parent_path().string();
  const bool same_folder = fs::path(from).parent_path() == fs::path(to).parent_path();
  formats::rename_assets(layer, [&](const std::string& name, formats::AssetUse use, Path) {
    if (name.empty()) {
      return name;
    }
    const auto identifier = resolver_.resolve(name, from);
    const auto place = identifier ? places.find(*identifier) : places.end();
    if (use == formats::AssetUse::Layer && place != places.end()) {
      return relative_asset_path(place->second, folder);
    }
    if (same_folder || fs::path(name).is_absolute()) {
      return name;
    }
    // Also patterns such as <UDIM>, which name no file: from the old folder.
    const bool found_beside = identifier.has_value() || name.starts_with(".");
    return found_beside && !bytes::is_in_package(from)
               ? relative_asset_path(
                     (fs::path(from).parent_path() / name).lexically_normal().string(), folder)
               : name;
  });
}

/// Standard output takes one layer.
Result<void> AssetLayers::check_one_edit() const {
  for (std::size_t i = 1; i < layers_.size(); ++i) {
    if (layers_[i].edited != nullptr) {
      return Error(ErrorCode::Unsupported,
                   "standard output takes one layer, and a layer below the asset changes too")
          .in_file(layers_[i].layer->identifier())
          .with_fix("give -o FILE, or one layer: tenon cat --flatten");
    }
  }
  return {};
}

Result<MadeFiles> AssetLayers::elsewhere(const std::string& output) {
  MadeFiles files;
  if (output == "-") {
    TENON_CHECK(check_one_edit());
    const layer::Layer& root = layers_[0].edited ? *layers_[0].edited : *layers_[0].layer;
    TENON_TRY(std::string text, formats::encode_layer(root, formats::LayerFormat::Text));
    files.push_back({"-", std::move(text)});
    return files;
  }
  const std::map<std::string, std::string> places = new_places(output);
  if (names_folder(output)) {
    TENON_CHECK(check_apart(places));
  }
  for (const AssetLayer& part : layers_) {
    const auto place = places.find(part.layer->identifier());
    if (place == places.end()) {
      continue;
    }
    layer::Layer copy = part.edited ? *part.edited : *part.layer;
    rename(copy, part.layer->identifier(), place->second, places);
    TENON_TRY(MadeFile one, made(copy, part.layer->identifier(), place->second));
    files.push_back(std::move(one));
  }
  return files;
}

std::string root_output(const std::string& output, const layer::Layer& root) {
  if (output == "-" || !names_folder(output)) {
    return output;
  }
  fs::path name = fs::path(root.identifier()).filename();
  if (bytes::is_in_package(root.identifier())) {
    const std::string package = bytes::split_package_path(root.identifier()).package;
    name = fs::path(package).stem() += ".usda";
  }
  return (fs::path(output) / name).string();
}

Result<LayerContents> edited_contents(const layer::Layer& layer, const std::string& file,
                                      const bytes::Files& files) {
  const auto wanted = file == "-" ? Result<formats::LayerFormat>(formats::LayerFormat::Text)
                                  : formats::layer_format_for(file);
  const auto bytes = files->open(layer.identifier(), {});
  const bool in_place = file == layer.identifier();
  const bool text = bytes && formats::format_of(**bytes) == formats::LayerFormat::Text &&
                    (in_place || (wanted && *wanted == formats::LayerFormat::Text));
  if (text || (in_place && bytes)) {  // whatever its name says
    TENON_TRY(EditedFile edited, edited_file(**bytes, layer));
    return LayerContents{std::move(edited.after), edited.kept_layout};
  }
  TENON_TRY(const formats::LayerFormat format, wanted);
  TENON_TRY(std::string contents, formats::encode_layer(layer, format));
  return LayerContents{std::move(contents)};  // binary, or another format: no layout to keep
}

Result<std::string> new_contents(const layer::Layer& layer, const std::string& file) {
  formats::LayerFormat format = formats::LayerFormat::Text;
  if (file != "-") {
    TENON_TRY(format, formats::layer_format_for(file));
  }
  return formats::encode_layer(layer, format);
}

layer::Layer layer_over(const layer::Layer& asset, const std::string& output) {
  layer::Layer over(output);
  over.set_may_lack_text();
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  over.root().set(
      "subLayers",
      layer::Value(std::vector<std::string>{relative_asset_path(asset.identifier(), folder)}));
  for (const char* field : {"defaultPrim", "kilogramsPerUnit", "metersPerUnit", "upAxis",
                            "startTimeCode", "endTimeCode", "timeCodesPerSecond"}) {
    const layer::Value* value = asset.root().find(field);
    if (value != nullptr &&
        layer::is_value_of_metadata(field, layer::SpecKind::PseudoRoot, *value)) {
      over.root().set(field, *value);
    }
  }
  return over;
}

}  // namespace tenon
