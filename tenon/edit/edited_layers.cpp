// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/edited_layers.h"

#include <utility>

namespace tenon::edit {

layer::LayerPtr EditedLayers::current(const layer::LayerPtr& original) const {
  const layer::LayerPtr copy = original == nullptr ? nullptr : find(original->identifier());
  return copy == nullptr ? original : copy;
}

layer::LayerPtr EditedLayers::find(const std::string& identifier) const {
  const auto copy = copies_.find(identifier);
  return copy == copies_.end() ? nullptr : copy->second.layer;
}

compose::LayerOpener EditedLayers::opener(compose::LayerOpener inner) const {
  std::map<std::string, layer::LayerPtr> known;
  for (const auto& [identifier, copy] : copies_) {
    known.emplace(identifier, copy.layer);
  }
  return [inner = std::move(inner), known = std::move(known)](
             const std::string& asset_path, const layer::Layer& anchor) -> Result<layer::LayerPtr> {
    if (const auto named = known.find(asset_path); named != known.end()) {
      return named->second;
    }
    TENON_TRY(const layer::LayerPtr opened, inner(asset_path, anchor));
    const auto edited = known.find(opened->identifier());
    return edited == known.end() ? opened : edited->second;
  };
}

void EditedLayers::add(layer::Layer layer) {
  const std::string identifier = layer.identifier();
  auto added = std::make_shared<layer::Layer>(std::move(layer));
  copies_.insert_or_assign(identifier, Copy{added, std::make_shared<layer::Layer>(*added)});
}

void EditedLayers::copy(const layer::LayerPtr& original) {
  if (find(original->identifier()) == nullptr) {
    copies_.emplace(original->identifier(),
                    Copy{std::make_shared<layer::Layer>(*original), original});
  }
}

layer::Layer& EditedLayers::writable(const std::string& identifier) {
  Copy& copy = copies_.at(identifier);
  if (copy.layer.use_count() > 1) {
    copy.layer = std::make_shared<layer::Layer>(*copy.layer);
  }
  return *copy.layer;
}

std::vector<LayerChange> EditedLayers::changes() const {
  std::vector<LayerChange> all;
  for (const auto& [identifier, copy] : copies_) {
    LayerChange change = difference(*copy.original, *copy.layer);
    if (!change.empty()) {
      all.push_back(std::move(change));
    }
  }
  return all;
}

}  // namespace tenon::edit
