// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/edit/layer_change.h"
#include "tenon/layer/layer.h"

/// Internal to this folder.
namespace tenon::edit {

class LayerEditor;

/// Copies of layers that edits have changed, beside the layers as they were given, and the history
/// of these edits. Several editors may share one: each sees the edits of all, in one history.
class EditedLayers {
 public:
  using Edit = Function<Result<void>(LayerEditor&)>;

  /// The copy where there is one, else `original`, which may be null.
  layer::LayerPtr current(const layer::LayerPtr& original) const;
  /// The copy of a layer; null: none.
  layer::LayerPtr find(const std::string& identifier) const;
  /// Opens copies where there are some; others by `inner`. It keeps the copies of this moment.
  compose::LayerOpener opener(compose::LayerOpener inner) const;

  /// The same two for views that live no longer than `composition()` stays as it is: a copy that is
  /// lent is not kept alive, so that edits may change it where it is.
  layer::LayerPtr lent(const layer::LayerPtr& original) const;
  compose::LayerOpener lending_opener(compose::LayerOpener inner) const;

  /// A layer that is in no file, as it is before all edits.
  void add(layer::Layer layer);
  /// Makes a copy of `original`, unless there is one.
  void copy(const layer::LayerPtr& original);

  /// Runs an edit of a layer that there is a copy of, all or nothing; a step or part of one.
  Result<void> edit(const std::string& identifier, const Edit& work);
  /// All edits of `work` as one step; when it returns an Error none of them stays.
  Result<void> as_one_step(const Function<Result<void>()>& work);
  bool undo();  ///< false when there is nothing to take back
  bool redo();

  /// What differs from the layers before all edits, by identifier.
  std::vector<LayerChange> changes() const;
  /// Every change that was made, forwards or backwards, in order.
  const std::vector<LayerChange>& log() const { return log_; }
  /// Another number after each change of a layer, and after a layer came.
  std::size_t revision() const { return revision_; }
  /// Another number when prims may be composed of other specs, or of specs at another place in
  /// memory. Values and properties may differ under the same one.
  std::size_t composition() const { return composition_; }

 private:
  using Step = std::vector<LayerChange>;
  struct Copy {
    std::shared_ptr<layer::Layer> layer;
    layer::LayerPtr original;  ///< before all edits
  };

  layer::Layer& writable(const std::string& identifier);
  void note(LayerChange change);
  void apply_step(const Step& step);
  static Step backwards(const Step& step);

  std::map<std::string, Copy> copies_;  // by identifier
  std::vector<LayerChange> log_;
  std::size_t revision_ = 0;
  std::size_t composition_ = 0;
  std::vector<Step> done_;
  std::vector<Step> undone_;
  Step* open_step_ = nullptr;  // while as_one_step runs
};

}  // namespace tenon::edit
