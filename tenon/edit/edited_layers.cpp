// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes are composed of copies, which edits change where they are: an edit costs what it changes,
// not what there is. A layer is copied again before an edit when somebody else holds the copy or
// keeps scenes of it, so that what was handed out stays as it was. Prim indices point to prim specs
// of layers: they hold until a spec of a prim, a variant or the root comes, goes or changes in more
// than what stage::SpecFollower follows, or until a copy takes the place of another layer.
// `composition_` counts these events, `revision_` all changes.
#include "tenon/edit/edited_layers.h"

#include <algorithm>
#include <utility>

#include "tenon/edit/composed_change.h"
#include "tenon/edit/layer_editor.h"

namespace tenon::edit {

// Layers

/// Puts a layer into the place of the copy.
void EditedLayers::place(Copy& copy, layer::Layer layer) {
  copy.layer = std::make_shared<layer::Layer>(std::move(layer));
  copy.shown = {copy.layer.get(), [keeps = copy.layer](const layer::Layer*) {}};
  copy.kept = false;
}

layer::LayerPtr EditedLayers::shown(const layer::LayerPtr& original) {
  if (original == nullptr) {
    return nullptr;
  }
  const auto [copy, made] = copies_.try_emplace(original->identifier());
  if (made) {
    copy->second.original = original;
    place(copy->second, *original);
  }
  return copy->second.shown;
}

layer::LayerPtr EditedLayers::shown_if_copied(const layer::LayerPtr& original) const {
  const auto copy = original == nullptr ? copies_.end() : copies_.find(original->identifier());
  return copy == copies_.end() ? original : copy->second.shown;
}

layer::LayerPtr EditedLayers::find(const std::string& identifier) const {
  const auto copy = copies_.find(identifier);
  return copy == copies_.end() ? nullptr : copy->second.layer;
}

bool EditedLayers::is_edited(const std::string& identifier) const {
  const auto copy = copies_.find(identifier);
  return copy != copies_.end() && copy->second.edited;
}

compose::LayerOpener EditedLayers::opener(const std::shared_ptr<EditedLayers>& layers,
                                          compose::LayerOpener inner) {
  // A scene may open a layer much later, for value clips: it then gets none that was edited since.
  auto known = std::make_shared<std::map<std::string, layer::LayerPtr>>();
  for (const auto& [identifier, copy] : layers->copies_) {
    known->emplace(identifier, copy.shown);
  }
  return [layers, inner = std::move(inner), known](
             const std::string& asset_path, const layer::Layer& anchor) -> Result<layer::LayerPtr> {
    if (const auto named = known->find(asset_path); named != known->end()) {
      return named->second;
    }
    TENON_TRY(const layer::LayerPtr opened, inner(asset_path, anchor));
    const auto [at, first] = known->try_emplace(opened->identifier(), opened);
    if (first) {
      at->second = layers->is_edited(opened->identifier())
                       ? layers->copies_.at(opened->identifier()).original
                       : layers->shown(opened);
    }
    return at->second;
  };
}

void EditedLayers::keep() {
  for (auto& [identifier, copy] : copies_) {
    copy.kept = true;
  }
}

void EditedLayers::add(layer::Layer layer) {
  Copy copy;
  copy.edited = true;
  copy.original = std::make_shared<layer::Layer>(layer);
  place(copy, std::move(layer));
  ++revision_;
  added_ = ++composition_;
  copies_.insert_or_assign(copy.original->identifier(), std::move(copy));
}

void EditedLayers::copy(const layer::LayerPtr& original) {
  if (find(original->identifier()) == nullptr) {
    shown(original);
    note_place(original->identifier());
  }
}

/// The copy, which nobody else holds; there must be one.
layer::Layer& EditedLayers::writable(const std::string& identifier) {
  constexpr long kOwners = 2;  // of a copy: itself, and what is shown of it
  Copy& copy = copies_.at(identifier);
  if (copy.kept || copy.layer.use_count() > kOwners) {
    place(copy, *copy.layer);
    note_place(identifier);
  }
  copy.edited = true;
  return *copy.layer;
}

void EditedLayers::note_place(const std::string& identifier) {
  copies_.at(identifier).placed = ++composition_;
}

bool EditedLayers::are_in_place_since(std::size_t composition,
                                      const std::vector<layer::LayerPtr>& layers) const {
  return added_ <= composition &&
         std::all_of(layers.begin(), layers.end(), [&](const layer::LayerPtr& layer) {
           const auto copy = copies_.find(layer->identifier());
           return copy == copies_.end() || copy->second.placed <= composition;
         });
}

std::vector<LayerChange> EditedLayers::changes() const {
  std::vector<LayerChange> all;
  for (const auto& [identifier, copy] : copies_) {
    LayerChange change;
    if (copy.edited) {
      change = difference(*copy.original, *copy.layer);
    }
    if (!change.empty()) {
      all.push_back(std::move(change));
    }
  }
  return all;
}

// History

Result<void> EditedLayers::edit(const std::string& identifier, const Edit& work) {
  LayerEditor editor(writable(identifier));
  Result<void> done = work(editor);
  if (!done) {
    if (changes_composition(editor.roll_back())) {
      note_place(identifier);  // what looked at the layer meanwhile saw specs that are gone
    }
    return done;
  }
  LayerChange change = editor.take_change();
  if (change.empty()) {
    return done;
  }
  note(change);
  undone_.clear();
  if (open_step_ != nullptr) {
    open_step_->push_back(std::move(change));
  } else {
    done_.push_back({std::move(change)});
  }
  return done;
}

void EditedLayers::note(LayerChange change) {
  ++revision_;
  composition_ += changes_composition(change) ? 1 : 0;
  log_.push_back(std::move(change));
}

void EditedLayers::apply_step(const Step& step) {
  for (const LayerChange& change : step) {
    edit::apply(change, writable(change.layer));
    note(change);
  }
}

EditedLayers::Step EditedLayers::backwards(const Step& step) {
  Step result;
  for (auto change = step.rbegin(); change != step.rend(); ++change) {
    result.push_back(inverse(*change));
  }
  return result;
}

bool EditedLayers::undo() {
  if (done_.empty() || open_step_ != nullptr) {
    return false;
  }
  apply_step(backwards(done_.back()));
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  return true;
}

bool EditedLayers::redo() {
  if (undone_.empty() || open_step_ != nullptr) {
    return false;
  }
  apply_step(undone_.back());
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  return true;
}

Result<void> EditedLayers::as_one_step(const Function<Result<void>()>& work) {
  if (open_step_ != nullptr) {
    return work();  // part of the step around it
  }
  Step step;
  open_step_ = &step;
  Result<void> result = work();
  open_step_ = nullptr;
  if (!result) {
    apply_step(backwards(step));
  } else if (!step.empty()) {
    done_.push_back(std::move(step));
  }
  return result;
}

}  // namespace tenon::edit
