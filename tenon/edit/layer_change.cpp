// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/layer_change.h"

#include <map>
#include <utility>

#include "tenon/layer/spec_equality.h"

namespace tenon::edit {

void apply(const LayerChange& change, layer::Layer& layer) {
  for (const SpecChange& spec : change.specs) {
    if (spec.after) {
      layer.create(spec.path, spec.after->kind) = *spec.after;
    } else {
      layer.erase(spec.path);
    }
  }
}

LayerChange inverse(LayerChange change) {
  for (SpecChange& spec : change.specs) {
    std::swap(spec.before, spec.after);
  }
  return change;
}

LayerChange difference(const layer::Layer& before, const layer::Layer& after) {
  std::map<Path, SpecChange> changes;
  for (const layer::Layer::Entry& entry : before.entries()) {
    const layer::Spec* now = entry.path.empty() ? nullptr : after.find(entry.path);
    if (now != nullptr && !layer::same_spec(entry.spec, *now)) {
      changes[entry.path] = {entry.path, entry.spec, *now};
    } else if (now == nullptr && !entry.path.empty()) {
      changes[entry.path] = {entry.path, entry.spec, std::nullopt};
    }
  }
  for (const layer::Layer::Entry& entry : after.entries()) {
    if (!entry.path.empty() && !before.has(entry.path)) {
      changes[entry.path] = {entry.path, std::nullopt, entry.spec};
    }
  }
  LayerChange change{after.identifier(), {}};
  for (auto& [path, spec] : changes) {
    change.specs.push_back(std::move(spec));
  }
  return change;
}

}  // namespace tenon::edit
