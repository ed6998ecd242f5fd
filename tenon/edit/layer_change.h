// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

/// Edits as values: what an edit did to the specs of a layer, forwards and backwards.
namespace tenon::edit {

/// One spec before and after an edit; nothing where there is none.
struct SpecChange {
  Path path;
  std::optional<layer::Spec> before;
  std::optional<layer::Spec> after;
};

/// An edit of one layer. Each path stands once, in the order in which it was touched first.
struct LayerChange {
  std::string layer;  ///< identifier
  std::vector<SpecChange> specs;

  bool empty() const { return specs.empty(); }
};

/// Gives the specs of `layer` the state after the edit.
void apply(const LayerChange& change, layer::Layer& layer);
/// The edit that takes `change` back.
LayerChange inverse(LayerChange change);
/// The edit that leads from one layer to another: all specs that differ, in order of paths.
LayerChange difference(const layer::Layer& before, const layer::Layer& after);

}  // namespace tenon::edit
