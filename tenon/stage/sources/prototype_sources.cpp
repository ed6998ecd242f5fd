// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/sources/prototype_sources.h"

#include <algorithm>

#include "tenon/compose/load_rules.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/composed_type.h"

namespace tenon::stage {
namespace {

/// The mask as it looks from a prim down; empty when all is included.
std::string mask_below(const std::set<Path>& mask, Path prim_path) {
  std::string text;
  Path last;
  for (const Path path : mask) {
    if (prim_path.has_prefix(path)) {
      return {};
    }
    if (path.has_prefix(prim_path) && (last.empty() || !path.has_prefix(last))) {
      text += ' ' + path.replace_prefix(prim_path, Path::absolute_root(), false).str();
      last = path;
    }
  }
  return text;
}

}  // namespace

bool is_in_mask(const std::set<Path>& mask, Path path) {
  return mask.empty() || std::any_of(mask.begin(), mask.end(), [&](Path included) {
           return path.has_prefix(included) || included.has_prefix(path);
         });
}

std::vector<ClipDefinition> own_clip_definitions(const StageData& data,
                                                 const compose::PrimIndex& index,
                                                 Diagnostics& diagnostics) {
  if (!has_clips(index)) {
    return {};
  }
  const auto exists = [&](const std::string& asset, const layer::Layer& anchor) {
    return !data.options.resolve_asset || !data.options.resolve_asset(asset, anchor).empty();
  };
  return clip_definitions(index, {exists, &data.template_files_left}, diagnostics);
}

std::string prototype_key(const StageData& data, const compose::PrimIndex& instance,
                          const std::vector<ClipDefinition>& clips) {
  std::string key = instance.extras().instance_key;
  for (const ClipDefinition& definition : clips) {
    key += definition.key();
  }
  return key + mask_below(data.options.mask, instance.path) + '\n' +
         compose::load_rules_below(data.options.compose, instance.path);
}

std::unordered_map<std::string, Path> prototype_sources(StageData& data) {
  std::unordered_map<std::string, Path> sources;
  std::vector<const compose::PrimIndex*> open{&data.cache->index(Path::absolute_root())};
  for (std::size_t count = 0; !open.empty() && count < data.options.max_prims; ++count) {
    const compose::PrimIndex& index = *open.back();
    open.pop_back();
    if (!is_active(index)) {
      continue;
    }
    if (index.instanceable) {
      Diagnostics known;  // reported where the instance is populated
      const std::string key = prototype_key(data, index, own_clip_definitions(data, index, known));
      if (!sources.try_emplace(key, index.path).second) {
        continue;
      }
    }
    for (const Token name : index.child_names) {
      if (is_in_mask(data.options.mask, index.path.child(name))) {
        open.push_back(&data.cache->child_index(index, name));
      }
    }
  }
  return sources;
}

}  // namespace tenon::stage
