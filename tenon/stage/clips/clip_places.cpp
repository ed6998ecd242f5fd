// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/clips/clip_places.h"

#include <algorithm>
#include <vector>

#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/stage/clips/clip_definition.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;
using layer::AssetPath;
using layer::Dictionary;

const Dictionary* clips_at(const layer::Layer& layer, Path site) {
  const layer::Spec* spec = layer.find(site);
  return spec == nullptr ? nullptr : spec->get<Dictionary>(fields::clips);
}

const Dictionary* set_at(const layer::Layer& layer, Path site, const std::string& name) {
  const Dictionary* clips = clips_at(layer, site);
  const layer::Value* set = clips == nullptr ? nullptr : clips->find(name);
  return set == nullptr ? nullptr : set->get<Dictionary>();
}

std::string first_word(std::string_view message) {
  return std::string(message.substr(0, message.find_first_of(" :")));
}

/// The key of a set that names the asset; empty when none does.
std::string key_of_asset(const Dictionary& set, const std::string& asset) {
  for (const auto& [key, value] : set.items) {
    if (const auto* one = value.get<AssetPath>(); one != nullptr && one->authored == asset) {
      return key;
    }
    if (const auto* list = value.get<std::vector<AssetPath>>();
        list != nullptr && std::any_of(list->begin(), list->end(), [&](const AssetPath& path) {
          return path.authored == asset;
        })) {
      return key;
    }
  }
  return {};
}

}  // namespace

void place_clip_finding(Diagnostic& finding, const compose::LayerStack& stack, Path site,
                        const std::string& set, std::string_view message) {
  for (const std::string& key : {first_word(message), std::string(kTemplateKey), std::string()}) {
    for (const compose::StackedLayer& stacked : stack.layers) {
      const Dictionary* authored = set_at(*stacked.layer, site, set);
      if (authored != nullptr && (key.empty() || authored->find(key) != nullptr)) {
        std::vector<std::string> keys{set};
        if (!key.empty()) {
          keys.push_back(key);
        }
        layer::place_finding(finding, *stacked.layer, site,
                             layer::entry_part(fields::clips, std::move(keys)));
        return;
      }
    }
  }
}

void place_clip_asset(Diagnostic& finding, const layer::Layer& layer, Path site,
                      const std::string& asset) {
  StatementPart part = layer::field_part(fields::clips);
  if (const Dictionary* clips = clips_at(layer, site)) {
    for (const auto& [name, value] : clips->items) {
      const auto* set = value.get<Dictionary>();
      if (set == nullptr) {
        continue;
      }
      const std::string key = key_of_asset(*set, asset);
      if (!key.empty()) {
        part = layer::entry_part(fields::clips, {name, key}, layer::item_text(asset, Path()));
        break;
      }
      if (set->find(kTemplateKey) != nullptr) {
        part = layer::entry_part(fields::clips, {name, std::string(kTemplateKey)});
      }
    }
  }
  layer::place_finding(finding, layer, site, std::move(part));
}

}  // namespace tenon::stage
