// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A layer is copied before its first edit, and again before an edit when somebody else holds the
// copy, so that what was handed out stays as it was. Otherwise the copy changes where it is. Prim
// indices point to prim specs of layers: they hold until a spec of a prim, a variant or the root
// comes, goes or changes in more than its list of properties, or until a copy takes the place of
// another layer. `composition_` counts these events, `revision_` all changes.
#include "tenon/edit/edited_layers.h"

#include <algorithm>
#include <utility>

#include "tenon/edit/layer_editor.h"
#include "tenon/layer/fields.h"

namespace tenon::edit {
namespace {

/// All fields but the list of properties are equal.
bool composes_alike(const layer::Spec& a, const layer::Spec& b) {
  const auto covers = [](const layer::Spec& one, const layer::Spec& other) {
    return std::all_of(one.fields().begin(), one.fields().end(), [&](const layer::Field& field) {
      const layer::Value* value = other.find(field.name);
      return field.name == layer::fields::properties || (value != nullptr && *value == field.value);
    });
  };
  return a.kind == b.kind && covers(a, b) && covers(b, a);
}

bool is_in_property(Path path) {
  while (!path.empty() && !path.is_property() && !path.is_prim_or_variant()) {
    path = path.parent();
  }
  return path.is_property();
}

bool changes_composition(const LayerChange& change) {
  return std::any_of(change.specs.begin(), change.specs.end(), [](const SpecChange& spec) {
    return !is_in_property(spec.path) &&
           !(spec.before && spec.after && composes_alike(*spec.before, *spec.after));
  });
}

compose::LayerOpener opener_of(std::map<std::string, layer::LayerPtr> known,
                               compose::LayerOpener inner) {
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

/// A pointer that does not keep the layer.
layer::LayerPtr lent_pointer(const layer::Layer& layer) { return {layer::LayerPtr(), &layer}; }

}  // namespace

// Layers

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
  return opener_of(std::move(known), std::move(inner));
}

layer::LayerPtr EditedLayers::lent(const layer::LayerPtr& original) const {
  const layer::LayerPtr copy = original == nullptr ? nullptr : find(original->identifier());
  return copy == nullptr ? original : lent_pointer(*copy);
}

compose::LayerOpener EditedLayers::lending_opener(compose::LayerOpener inner) const {
  std::map<std::string, layer::LayerPtr> known;
  for (const auto& [identifier, copy] : copies_) {
    known.emplace(identifier, lent_pointer(*copy.layer));
  }
  return opener_of(std::move(known), std::move(inner));
}

void EditedLayers::add(layer::Layer layer) {
  const std::string identifier = layer.identifier();
  auto added = std::make_shared<layer::Layer>(std::move(layer));
  copies_.insert_or_assign(identifier, Copy{added, std::make_shared<layer::Layer>(*added)});
  ++revision_;
  ++composition_;
}

void EditedLayers::copy(const layer::LayerPtr& original) {
  if (find(original->identifier()) == nullptr) {
    copies_.emplace(original->identifier(),
                    Copy{std::make_shared<layer::Layer>(*original), original});
    ++composition_;
  }
}

/// The copy, which nobody else holds; there must be one.
layer::Layer& EditedLayers::writable(const std::string& identifier) {
  Copy& copy = copies_.at(identifier);
  if (copy.layer.use_count() > 1) {
    copy.layer = std::make_shared<layer::Layer>(*copy.layer);
    ++composition_;
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

// History

Result<void> EditedLayers::edit(const std::string& identifier, const Edit& work) {
  LayerEditor editor(writable(identifier));
  Result<void> done = work(editor);
  if (!done) {
    // What looked at the layer meanwhile saw specs that are gone.
    composition_ += changes_composition(editor.roll_back()) ? 1 : 0;
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
