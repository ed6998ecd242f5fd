// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/layer_change.h"

#include <algorithm>

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
  LayerChange change{after.identifier(), {}};
  for (const layer::Layer::Entry& entry : before.entries()) {
    if (entry.path.empty()) {
      continue;
    }
    const layer::Spec* now = after.find(entry.path);
    if (now == nullptr) {
      change.specs.push_back({entry.path, entry.spec, std::nullopt});
    } else if (!layer::same_spec(entry.spec, *now)) {
      change.specs.push_back({entry.path, entry.spec, *now});
    }
  }
  for (const layer::Layer::Entry& entry : after.entries()) {
    if (!entry.path.empty() && !before.has(entry.path)) {
      change.specs.push_back({entry.path, std::nullopt, entry.spec});
    }
  }
  std::sort(change.specs.begin(), change.specs.end(),
            [](const SpecChange& a, const SpecChange& b) { return a.path < b.path; });
  return change;
}

}  // namespace tenon::edit
