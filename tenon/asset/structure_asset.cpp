// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/structure_asset.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/asset/editing/engine_layer.h"
#include "tenon/asset_policy.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/stage_sources.h"
#include "tenon/structure/layout.h"

namespace tenon {

namespace {

namespace fs = std::filesystem;

structure::AssetSource source_of(const StageSources& sources, const bytes::ReadPolicy& policy,
                                 std::size_t max_work) {
  structure::AssetSource source;
  source.max_work = max_work;
  source.root = sources.root;
  source.open_layer = sources.opener();
  source.resolve_asset = [registry = sources.registry](const std::string& asset,
                                                       const layer::Layer& anchor) {
    return registry->resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  source.open_asset = [policy](const std::string& identifier) { return policy.open(identifier); };
  source.files = policy.files();
  return source;
}

/// The layer stands on the physics of all engines, as those of the structure do.
bool is_over(const layer::Layer& layer, const std::string& physics) {
  const auto* sublayers = layer.root().get<std::vector<std::string>>(layer::fields::subLayers);
  return sublayers != nullptr &&
         std::any_of(sublayers->begin(), sublayers->end(), [&](const std::string& sublayer) {
           return structure::target_of(sublayer, layer) == physics;
         });
}

void report_loose(const std::string& file, bool taken, Diagnostics& diagnostics) {
  const std::string variant = fs::path(file).stem().string();
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "structure.loose-layer";
  finding.message =
      std::string("no variant of \"Physics\" loads this layer") +
      (taken ? ", which builds on the physics of all engines; it becomes the variant \"" + variant +
                   "\""
             : "; it is skipped");
  finding.file = file;
  finding.fix = taken ? "remove the file where it is not wanted"
                      : "give it the sublayer ./physics.usda, or load it by a variant";
  diagnostics.add(std::move(finding));
}

/// Layers beside physics.usda, in the asset's own folder.
std::vector<std::string> layers_beside(const std::string& physics, const std::string& interface,
                                       const bytes::Files& files) {
  const fs::path folder = fs::path(physics).parent_path();
  const std::string place =
      folder.lexically_relative(fs::path(interface).parent_path()).generic_string();
  const bool own = !bytes::is_in_package(physics) && !place.empty() && !place.starts_with("..");
  const auto entries =
      own ? files->list(folder.string())
          : Result<std::vector<bytes::FolderEntry>>(std::vector<bytes::FolderEntry>());
  std::vector<std::string> layers;
  if (!entries) {
    return layers;  // a source of files that lists none
  }
  for (const bytes::FolderEntry& entry : *entries) {
    if (entry.kind == bytes::NameKind::File && formats::is_layer_name(entry.name)) {
      layers.push_back((folder / entry.name).string());
    }
  }
  return layers;
}

/// Gives layers of engines that no variant of the interface loads one each, in memory.
Result<void> add_loose_engines(StageSources& sources, const bytes::Files& files,
                               Diagnostics& diagnostics) {
  const structure::RolesOfFiles roles = structure::roles_of_files(*sources.root, {});
  const auto physics = std::find_if(roles.begin(), roles.end(), [](const auto& file) {
    return file.second == structure::Role::Physics;
  });
  if (physics == roles.end()) {
    return {};
  }
  const compose::LayerOpener open = sources.opener();
  for (const std::string& file : layers_beside(physics->first, sources.root->identifier(), files)) {
    if (roles.contains(file)) {
      continue;
    }
    const auto layer = open(file, *sources.root);
    const bool taken = layer && is_over(**layer, physics->first);
    report_loose(file, taken, diagnostics);
    if (taken) {
      TENON_TRY(layer::Layer root,
                with_engine_variant(*sources.root, fs::path(file).stem().string(), file));
      sources.root = std::make_shared<const layer::Layer>(std::move(root));
    }
  }
  return {};
}

}  // namespace

structure::AssetSource asset_source(layer::Layer layer, const bytes::ReadPolicy& policy) {
  structure::AssetSource source;
  source.root = std::make_shared<const layer::Layer>(std::move(layer));
  source.open_layer = [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, "the layer is not part of an asset").in_file(asset);
  };
  source.files = policy.files();
  source.resolve_asset = [files = policy.files()](const std::string& asset, const layer::Layer&) {
    const bool found = asset.starts_with('/') && files->kind(asset) != bytes::NameKind::Nothing;
    return found ? asset : std::string();
  };
  source.open_asset = [policy](const std::string& identifier) { return policy.open(identifier); };
  return source;
}

Result<structure::StructuredAsset> structure_asset(const std::string& path, const OpenOptions& open,
                                                   const structure::StructureOptions& options,
                                                   Diagnostics& diagnostics) {
  OpenOptions plain = open;
  plain.physics_variant.clear();  // all variants are looked at
  plain.session_path.clear();
  TENON_TRY(StageSources sources, open_sources(path, plain));
  TENON_CHECK(add_loose_engines(sources, open.files, diagnostics));
  const bytes::ReadPolicy policy = policy_for(path, open);
  TENON_TRY(
      structure::StructuredAsset asset,
      structure::make_package(source_of(sources, policy, open.max_work), options, diagnostics));
  for (const std::string& layer : sources.registry->opened()) {
    name_outside_layer(layer, sources.root->identifier(), policy, diagnostics);
  }
  return asset;
}

}  // namespace tenon
