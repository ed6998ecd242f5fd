// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A clip set in use: which clip is active when, and what the manifest declares. A set that breaks a
// rule is skipped as a whole.
#include "tenon/stage/clips/clip_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/stage/clips/clip_places.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

constexpr double kEarliest = -std::numeric_limits<double>::max();
constexpr double kLatest = std::numeric_limits<double>::max();

Result<void> check_prim_path(const std::string& text) {
  const auto path = Path::parse(text);
  if (!path || !path->is_absolute() || !path->is_prim()) {
    return Error(ErrorCode::Invalid, "primPath `" + text + "` is not the absolute path of a prim");
  }
  return {};
}

bool all_finite(const std::vector<Vec2d>& pairs) {
  return std::all_of(pairs.begin(), pairs.end(), [](const Vec2d& pair) {
    return std::isfinite(pair[0]) && std::isfinite(pair[1]);
  });
}

Result<void> check_active(const std::vector<Vec2d>& active, std::size_t clip_count) {
  std::set<double> starts;
  for (const Vec2d& entry : active) {
    if (entry[1] < 0 || entry[1] >= static_cast<double>(clip_count)) {
      return Error(ErrorCode::Invalid,
                   "active names clip " + shortest(entry[1]) + " of " + std::to_string(clip_count));
    }
    if (!starts.insert(entry[0]).second) {
      return Error(ErrorCode::Invalid, "active names two clips for the time " + shortest(entry[0]));
    }
  }
  return {};
}

Result<void> check_times(const std::vector<Vec2d>& times) {
  std::map<double, int> seen;
  for (const Vec2d& entry : times) {
    if (++seen[entry[0]] > 2) {
      return Error(ErrorCode::Invalid,
                   "times has more than two entries for the time " + shortest(entry[0]));
    }
  }
  return {};
}

// Empty lists are no mistake: they block weaker clips.
Result<void> check(const ClipDefinition& definition) {
  for (const layer::AssetPath& asset : *definition.asset_paths) {
    if (asset.authored.empty()) {
      return Error(ErrorCode::Invalid, "assetPaths has an empty path");
    }
  }
  TENON_CHECK(check_prim_path(*definition.prim_path));
  if (!all_finite(*definition.active) ||
      !all_finite(definition.times.value_or(std::vector<Vec2d>()))) {
    return Error(ErrorCode::Invalid, "active or times has an entry that is not a number");
  }
  TENON_CHECK(check_active(*definition.active, definition.asset_paths->size()));
  return definition.times ? check_times(*definition.times) : Result<void>();
}

}  // namespace

std::shared_ptr<const ClipSet> ClipSet::make(const ClipDefinition& definition, ClipLayers& layers,
                                             const std::string& prim, Diagnostics& diagnostics) {
  if (!definition.asset_paths || !definition.prim_path || !definition.active) {
    return nullptr;
  }
  if (const Result<void> checked = check(definition); !checked) {
    Diagnostic diagnostic;
    diagnostic.severity = Severity::Warning;
    diagnostic.rule = "clips.invalid";
    diagnostic.message =
        "the clip set `" + definition.name + "` is skipped: " + checked.error().message();
    diagnostic.prim = prim;
    layer::place_finding(diagnostic, *definition.layer, definition.site);
    place_clip_finding(diagnostic, *definition.layer_stack, definition.site, definition.name,
                       checked.error().message());
    diagnostics.add(std::move(diagnostic));
    return nullptr;
  }
  if (definition.active->empty()) {
    return nullptr;
  }
  std::shared_ptr<ClipSet> set(new ClipSet());
  set->name_ = definition.name;
  set->layer_stack_ = definition.layer_stack;
  set->layer_ = definition.layer;
  set->site_ = definition.site;
  set->clip_prim_ = Path::from(*definition.prim_path);
  set->interpolate_missing_ = definition.interpolate_missing;
  set->times_ = ClipTimes(definition.times.value_or(std::vector<Vec2d>()));
  set->offset_ = definition.offset;
  set->add_clips(definition, layers, prim);
  if (definition.manifest) {
    set->manifest_ = &set->layers_.emplace_back(layers, definition.manifest->authored,
                                                *definition.layer, ClipUser{definition.site, prim});
  } else {
    set->generate_manifest();
  }
  return set;
}

void ClipSet::add_clips(const ClipDefinition& definition, ClipLayers& layers,
                        const std::string& prim) {
  std::vector<const ClipLayer*> by_index;
  for (const layer::AssetPath& asset : *definition.asset_paths) {
    by_index.push_back(&layers_.emplace_back(layers, asset.authored, *definition.layer,
                                             ClipUser{definition.site, prim}));
  }
  for (const Vec2d& entry : *definition.active) {
    clips_.push_back({by_index[static_cast<std::size_t>(entry[1])], entry[0], entry[0], kLatest});
  }
  std::sort(clips_.begin(), clips_.end(),
            [](const Clip& a, const Clip& b) { return a.start < b.start; });
  for (std::size_t i = 0; i + 1 < clips_.size(); ++i) {
    clips_[i].end = clips_[i + 1].start;
  }
  clips_.front().start = kEarliest;
}

// Attributes that have samples in some clip; the first that has them says whether they vary.
void ClipSet::generate_manifest() {
  std::set<const layer::Layer*> done;
  for (const Clip& clip : clips_) {
    const layer::Layer* layer = clip.layer->get();
    if (layer == nullptr || !done.insert(layer).second) {
      continue;
    }
    for (const layer::Layer::Entry& entry : layer->entries()) {
      const auto* samples = entry.spec.kind == layer::SpecKind::Attribute
                                ? entry.spec.get<layer::TimeSamples>(fields::timeSamples)
                                : nullptr;
      if (samples == nullptr || samples->empty() || !entry.path.has_prefix(clip_prim_)) {
        continue;
      }
      const auto variability = entry.spec.get_or(fields::variability, layer::Variability::Varying);
      generated_.emplace(entry.path, variability == layer::Variability::Varying);
    }
  }
}

bool ClipSet::declares(Path attribute) const {
  const Path path = in_clip(attribute);
  if (manifest_ == nullptr) {
    const auto it = generated_.find(path);
    return it != generated_.end() && it->second;
  }
  const layer::Layer* layer = manifest_->get();
  const layer::Spec* spec = layer == nullptr ? nullptr : layer->find(path);
  return spec != nullptr && spec->kind == layer::SpecKind::Attribute &&
         spec->get_or(fields::variability, layer::Variability::Varying) ==
             layer::Variability::Varying;
}

std::size_t ClipSet::active(double time) const {
  const auto after = std::upper_bound(clips_.begin(), clips_.end(), time,
                                      [](double at, const Clip& clip) { return at < clip.start; });
  return after == clips_.begin() ? 0 : static_cast<std::size_t>(after - clips_.begin()) - 1;
}

ClipSets clip_sets(const std::vector<ClipDefinition>& definitions, const ClipSets* inherited,
                   ClipLayers& layers, const std::string& prim, Diagnostics& diagnostics) {
  ClipSets result;
  for (const ClipDefinition& definition : definitions) {
    if (auto set = ClipSet::make(definition, layers, prim, diagnostics)) {
      result.push_back(std::move(set));
    }
  }
  if (inherited != nullptr) {
    result.insert(result.end(), inherited->begin(), inherited->end());
  }
  return result;
}

}  // namespace tenon::stage
