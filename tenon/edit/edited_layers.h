// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tenon/compose/layer_opener.h"
#include "tenon/edit/layer_change.h"
#include "tenon/layer/layer.h"

/// Internal to this folder.
namespace tenon::edit {

/// Copies of layers that edits have changed, beside the layers as they were given.
class EditedLayers {
 public:
  /// The copy where there is one, else `original`, which may be null.
  layer::LayerPtr current(const layer::LayerPtr& original) const;
  /// The copy of a layer; null: none.
  layer::LayerPtr find(const std::string& identifier) const;
  /// Opens copies where there are some; others by `inner`. It keeps the copies of this moment.
  compose::LayerOpener opener(compose::LayerOpener inner) const;

  /// A layer that is in no file, as it is before all edits.
  void add(layer::Layer layer);
  /// Makes a copy of `original`, unless there is one.
  void copy(const layer::LayerPtr& original);
  /// The copy, which nobody else holds; there must be one.
  layer::Layer& writable(const std::string& identifier);

  /// What differs from the layers before all edits, by identifier.
  std::vector<LayerChange> changes() const;

 private:
  struct Copy {
    std::shared_ptr<layer::Layer> layer;
    layer::LayerPtr original;  ///< before all edits
  };
  std::map<std::string, Copy> copies_;  // by identifier
};

}  // namespace tenon::edit
