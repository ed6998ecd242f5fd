// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Judges by the codes of SimReady and of REP-0158. What they ask of files is gathered here: all
// layers that the asset may use, whichever variants are selected, found from layer to layer, with
// every asset path in them; the JSON file beside the asset; headers of images. Stages are composed
// once for each runtime whose variant set the default prim has, when a requirement asks for it.
#include "tenon/asset/checking/judge_simready.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "tenon/answers/json.h"
#include "tenon/asset/checking/image_header.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/profile_limits.h"
#include "tenon/check/rep0158/rep0158.h"
#include "tenon/formats/package/asset_paths.h"
#include "tenon/layer/field_values.h"
#include "tenon/stage_sources.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;
namespace simready = check::simready;

constexpr const char* kRep0158 = "rep-0158";

layer::Value value_of_json(const answers::Json& json, std::size_t depth);

layer::Dictionary dictionary_of_json(const answers::Json& json, std::size_t depth) {
  layer::Dictionary made;
  for (const auto& [key, value] : json.items()) {
    made.items[key] = value_of_json(value, depth);
  }
  return made;
}

layer::Value value_of_json(const answers::Json& json, std::size_t depth) {
  if (json.is_string()) {
    return json.get<std::string>();
  }
  if (json.is_boolean()) {
    return json.get<bool>();
  }
  if (json.is_number_integer()) {
    return json.get<std::int64_t>();
  }
  if (json.is_number()) {
    return json.get<double>();
  }
  if (json.is_object() && depth < limits::kSidecarDepth) {
    return dictionary_of_json(json, depth + 1);
  }
  std::vector<double> numbers;
  if (json.is_array()) {
    for (const answers::Json& one : json) {
      if (one.is_number()) {
        numbers.push_back(one.get<double>());
      }
    }
  }
  return layer::Array<double>(std::move(numbers));
}

/// Every layer that the root may use, and every asset path in them.
void gather_files(const StageSources& sources, simready::JudgedAsset& asset) {
  std::vector<layer::LayerPtr> pending{sources.root};
  std::set<std::string> known{sources.root->identifier()};
  while (!pending.empty() && known.size() < limits::kLayerStackLayers) {
    const layer::LayerPtr from = pending.back();
    pending.pop_back();
    asset.layers.push_back(from->identifier());
    layer::Layer copy = *from;
    formats::rename_assets(
        copy, [&](const std::string& path, formats::AssetUse use, Path spec) -> std::string {
          const auto found = sources.registry->resolver().resolve(path, from->identifier());
          asset.named.push_back({from->identifier(), path, found ? *found : "", spec,
                                 use == formats::AssetUse::Layer});
          if (found && use == formats::AssetUse::Layer && known.insert(*found).second) {
            if (auto layer = sources.registry->open(path, from.get())) {
              pending.push_back(*std::move(layer));
            }
          }
          return path;
        });
  }
  std::sort(asset.layers.begin(), asset.layers.end());
}

void read_sidecar(const bytes::Files& files, simready::JudgedAsset& asset) {
  const std::string beside = fs::path(asset.file).replace_extension(".json").string();
  if (files->kind(beside) != bytes::NameKind::File) {
    return;
  }
  asset.sidecar = beside;
  bytes::FileRules rules;
  rules.max_bytes = limits::kSidecarBytes;
  const auto bytes = files->open(beside, rules);
  const answers::Json json = bytes ? answers::parsed((*bytes)->text()) : answers::Json(nullptr);
  if (json.is_object()) {
    asset.facts_beside = dictionary_of_json(json, 0);
  }
}

simready::FileFacts file_facts(const bytes::Files& files,
                               const std::shared_ptr<formats::LayerRegistry>& registry) {
  simready::FileFacts facts;
  facts.exists = [files](const std::string& path) {
    return files->kind(path) != bytes::NameKind::Nothing;
  };
  facts.files_in = [files](const std::string& folder) {
    std::vector<std::string> names;
    if (const auto entries = files->list(folder)) {
      for (const bytes::FolderEntry& entry : *entries) {
        if (entry.kind == bytes::NameKind::File) {
          names.push_back(entry.name);
        }
      }
    }
    return names;
  };
  facts.image = [registry](const std::string& file) -> std::optional<simready::ImageFacts> {
    const auto bytes = registry->resolver().open(file);
    return bytes ? image_header((*bytes)->text()) : std::nullopt;
  };
  return facts;
}

/// Stages of one asset by runtime, composed when they are asked for.
class RuntimeStages {
 public:
  RuntimeStages(std::string path, OpenOptions options)
      : path_(std::move(path)), options_(std::move(options)) {}

  /// The asset as it opens, with every runtime disabled where `apart`. Fails as tenon::open does.
  Result<const simready::JudgedStage*> open(bool apart) {
    TENON_TRY(stage::Stage stage, tenon::open(path_, options_));
    if (!apart) {
      return keep("", std::move(stage));
    }
    const stage::Prim root = stage.default_prim();
    const std::vector<std::string> sets = root.variant_set_names();
    for (const std::string& runtime : simready::runtimes()) {
      if (std::find(sets.begin(), sets.end(), runtime) != sets.end()) {
        present_.push_back(runtime);
      }
    }
    root_ = root ? root.path().str() : "";
    return present_.empty() ? keep("", std::move(stage)) : compose("");
  }

  const simready::JudgedStage* of(std::string_view runtime) {
    const bool present = std::find(present_.begin(), present_.end(), runtime) != present_.end();
    const std::string key = present ? std::string(runtime) : "";
    const auto known = kept_.find(key);
    if (known != kept_.end()) {
      return known->second.judged.get();
    }
    const auto composed = compose(key);
    return composed ? *composed : nullptr;
  }

 private:
  struct Kept {
    std::unique_ptr<stage::Stage> stage;
    std::unique_ptr<simready::JudgedStage> judged;
  };

  Result<const simready::JudgedStage*> compose(const std::string& runtime) {
    OpenOptions options = options_;
    for (const std::string& set : present_) {
      options.selections.push_back({root_, set, set == runtime ? "Enabled" : "Disabled"});
    }
    TENON_TRY(stage::Stage stage, tenon::open(path_, options));
    return keep(runtime, std::move(stage));
  }

  const simready::JudgedStage* keep(const std::string& runtime, stage::Stage stage) {
    Kept& kept = kept_[runtime];
    kept.stage = std::make_unique<stage::Stage>(std::move(stage));
    kept.judged = std::make_unique<simready::JudgedStage>(*kept.stage);
    return kept.judged.get();
  }

  std::string path_;
  OpenOptions options_;
  std::string root_;
  std::vector<std::string> present_;
  std::map<std::string, Kept> kept_;
};

}  // namespace

bool has_codes(const std::string& profile) {
  return profile.starts_with("simready") || profile == kRep0158;
}

Result<simready::Judgement> judge_by_codes(const std::string& path, const OpenOptions& options,
                                           const std::string& profile) {
  TENON_TRY(const StageSources sources, open_sources(path, options));
  simready::JudgedAsset asset;
  asset.file = sources.root->identifier();
  asset.files = file_facts(options.files, sources.registry);
  gather_files(sources, asset);
  read_sidecar(options.files, asset);
  RuntimeStages stages(path, options);
  TENON_TRY(const simready::JudgedStage* neutral, stages.open(profile != kRep0158));
  asset.stage_of = [&stages](std::string_view runtime) { return stages.of(runtime); };
  if (profile == kRep0158) {
    return simready::judge(asset, check::rep0158::requirements(), simready::Kind::Robot);
  }
  simready::Kind kind = simready::kind_of(*neutral);
  if (profile.starts_with("simready-robot")) {
    kind = simready::Kind::Robot;
  } else if (profile.starts_with("simready-prop")) {
    kind = simready::Kind::Prop;
  }
  return simready::judge(asset, simready::requirements(), kind);
}

}  // namespace tenon
