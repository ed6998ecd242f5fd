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

/// Copies of the layers of scenes, which edits change where they are, beside the layers as they
/// were given, and the history of these edits. Several editors may share one: each sees the edits
/// of all, in one history.
class EditedLayers {
 public:
  using Edit = Function<Result<void>(LayerEditor&)>;

  /// The copy that scenes are composed of, made where there is none; null for null. It changes with
  /// the edits, until somebody else holds it or keep() was called: then the next edit makes
  /// another.
  layer::LayerPtr shown(const layer::LayerPtr& original);
  /// The same where there is a copy, else `original`.
  layer::LayerPtr shown_if_copied(const layer::LayerPtr& original) const;
  /// Opens copies: those that there are when this is called, and of other layers new ones.
  static compose::LayerOpener opener(const std::shared_ptr<EditedLayers>& layers,
                                     compose::LayerOpener inner);
  /// The copy of a layer; null: none. While somebody holds it, it stays as it is.
  layer::LayerPtr find(const std::string& identifier) const;
  /// Edits were made to the layer, or begun, or it was added.
  bool is_edited(const std::string& identifier) const;
  /// All copies of now stay as they are.
  void keep();

  /// A layer that is in no file, as it is before all edits.
  void add(layer::Layer layer);
  /// Makes a copy of `original`, unless there is one; scenes that have opened it are composed
  /// again.
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
  /// memory. Values, properties, types and applied schemas may differ under the same one.
  std::size_t composition() const { return composition_; }
  /// The changes of the log since then are all that may make scenes of these layers differ.
  bool are_in_place_since(std::size_t composition,
                          const std::vector<layer::LayerPtr>& layers) const;
  /// Steps of the history that can be taken back.
  std::size_t step_count() const { return done_.size(); }

 private:
  using Step = std::vector<LayerChange>;
  struct Copy {
    std::shared_ptr<layer::Layer> layer;
    layer::LayerPtr shown;     ///< the same, which scenes hold: edits need not mind these
    layer::LayerPtr original;  ///< before all edits
    bool kept = false;         ///< stays as it is
    bool edited = false;       ///< may differ from `original`
    std::size_t placed = 0;    ///< composition() when it took the place of another
  };

  static void place(Copy& copy, layer::Layer layer);
  layer::Layer& writable(const std::string& identifier);
  void note_place(const std::string& identifier);
  void note(LayerChange change);
  void apply_step(const Step& step);
  static Step backwards(const Step& step);

  std::map<std::string, Copy> copies_;  // by identifier
  std::vector<LayerChange> log_;
  std::size_t revision_ = 0;
  std::size_t composition_ = 0;
  std::size_t added_ = 0;  // composition() when a layer came that arcs may not have found
  std::vector<Step> done_;
  std::vector<Step> undone_;
  Step* open_step_ = nullptr;  // while as_one_step runs
};

}  // namespace tenon::edit
