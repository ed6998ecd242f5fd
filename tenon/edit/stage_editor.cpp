// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers, edit target, history and composition; the edits themselves stand in *_edits.cpp.
#include "tenon/edit/stage_editor.h"

#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"

namespace tenon::edit {
namespace {

Result<layer::LayerPtr> no_layers(const std::string& asset_path, const layer::Layer& anchor) {
  return Error(ErrorCode::NotFound,
               "cannot find @" + asset_path + "@ named in " + anchor.identifier())
      .with_rule("layer.not-found");
}

}  // namespace

StageEditor::StageEditor(layer::LayerPtr root, layer::LayerPtr session, compose::LayerOpener opener,
                         stage::StageOptions options)
    : root_(std::move(root)),
      session_(std::move(session)),
      opener_(std::move(opener)),
      options_(std::move(options)) {
  target_.layer = root_->identifier();
}

StageEditor::StageEditor(StageEditor&&) noexcept = default;
StageEditor& StageEditor::operator=(StageEditor&&) noexcept = default;
StageEditor::~StageEditor() = default;

StageEditor StageEditor::in_memory(std::string identifier) {
  return StageEditor(std::make_shared<const layer::Layer>(std::move(identifier)), nullptr,
                     no_layers, {});
}

StageEditor StageEditor::over(layer::LayerPtr root, layer::LayerPtr session,
                              compose::LayerOpener opener, stage::StageOptions options) {
  return StageEditor(std::move(root), std::move(session), std::move(opener), std::move(options));
}

// Composition

ComposedView& StageEditor::view() {
  if (view_ == nullptr) {
    view_ = std::make_unique<ComposedView>(layers_.current(root_), layers_.current(session_),
                                           layers_.opener(opener_), options_.compose);
  }
  return *view_;
}

Result<std::shared_ptr<const stage::Stage>> StageEditor::stage() {
  if (stage_ != nullptr && stage_is_current_) {
    return stage_;
  }
  TENON_TRY(stage::Stage composed,
            stage::Stage::open(layers_.current(root_), layers_.current(session_),
                               layers_.opener(opener_), options_));
  auto now = std::make_shared<const stage::Stage>(std::move(composed));
  if (stage_ != nullptr) {
    notice_ = compare_stages(*stage_, *now, unnoticed_);
  }
  unnoticed_.clear();
  stage_ = std::move(now);
  stage_is_current_ = true;
  return stage_;
}

void StageEditor::changed() {
  view_.reset();
  stage_is_current_ = false;
}

// Layers

layer::LayerPtr StageEditor::layer(const std::string& identifier) {
  if (layer::LayerPtr copy = layers_.find(identifier)) {
    return copy;
  }
  for (const layer::LayerPtr& known : {root_, session_, target_layer_}) {
    if (known != nullptr && known->identifier() == identifier) {
      return known;
    }
  }
  layer::LayerPtr found = view().layer(identifier);
  if (found == nullptr && stage_ != nullptr) {
    for (const layer::LayerPtr& used : stage_->used_layers()) {
      found = used->identifier() == identifier ? used : found;
    }
  }
  return found;
}

void StageEditor::add_layer(layer::Layer layer) {
  layers_.add(std::move(layer));
  changed();
}

/// A copy that nobody else holds; nullptr for an unknown layer.
layer::Layer* StageEditor::writable(const std::string& identifier) {
  if (layers_.find(identifier) == nullptr) {
    const layer::LayerPtr original = layer(identifier);
    if (original == nullptr) {
      return nullptr;
    }
    layers_.copy(original);
    changed();
  }
  view_.reset();
  return &layers_.writable(identifier);
}

std::map<std::string, layer::LayerPtr> StageEditor::edited_layers() const {
  std::map<std::string, layer::LayerPtr> edited;
  for (const LayerChange& change : changes()) {
    edited.emplace(change.layer, layers_.find(change.layer));
  }
  return edited;
}

// Edit target

Result<void> StageEditor::set_target(const std::string& identifier) {
  for (const compose::StackedLayer& stacked : view().layer_stack().layers) {
    if (stacked.layer->identifier() == identifier) {
      return set_target(layer_target(view().layer_stack(), identifier));
    }
  }
  return unknown_layer(identifier);
}

Result<void> StageEditor::set_target(EditTarget target) {
  const layer::LayerPtr found = layer(target.layer);
  if (found == nullptr) {
    return unknown_layer(target.layer);
  }
  target_layer_ = found;
  target_ = std::move(target);
  return {};
}

Result<EditTarget> StageEditor::variant_target(Path prim, const std::string& set,
                                               const std::string& variant) {
  TENON_TRY(const FoundPrim found, find_prim(prim));
  TENON_TRY(const Path path, place(prim));
  if (!found || !is_variant_name(set) || !is_variant_name(variant)) {
    return bad_variant(set, variant);
  }
  return edit::variant_target(target_.layer, path.variant_selection(Token(set), Token(variant)));
}

Result<EditTarget> StageEditor::arc_target(Path prim, const std::string& identifier) {
  TENON_TRY(const FoundPrim found, find_prim(prim));
  for (std::uint32_t id = 0; id < found.index->nodes.size(); ++id) {
    const compose::Node& node = found.index->nodes[id];
    for (const compose::StackedLayer& stacked : node.layer_stack->layers) {
      if (id != 0 && node.can_contribute() && stacked.layer->identifier() == identifier) {
        return node_target(*found.index, id, identifier);
      }
    }
  }
  return Error(ErrorCode::NotFound, "no arc brings " + identifier + " to <" + prim.str() + ">")
      .with_prim(prim.str())
      .with_rule("edit.outside-target")
      .with_fix("choose a layer that the prim's opinions come from");
}

// History

Result<void> StageEditor::edit(const std::function<Result<void>(LayerEditor&)>& work) {
  return edit_layer(target_.layer, work);
}

Result<void> StageEditor::edit_layer(const std::string& identifier,
                                     const std::function<Result<void>(LayerEditor&)>& work) {
  layer::Layer* layer = writable(identifier);
  if (layer == nullptr) {
    return unknown_layer(identifier);
  }
  LayerEditor editor(*layer);
  Result<void> done = work(editor);
  if (done) {
    record(editor.take_change());
  } else {
    editor.roll_back();
    view_.reset();
  }
  return done;
}

void StageEditor::record(LayerChange change) {
  view_.reset();
  if (change.empty()) {
    return;
  }
  changed();
  unnoticed_.push_back(change);
  undone_.clear();
  if (open_step_ != nullptr) {
    open_step_->push_back(std::move(change));
  } else {
    done_.push_back({std::move(change)});
  }
}

void StageEditor::apply_step(const Step& step) {
  for (const LayerChange& change : step) {
    edit::apply(change, *writable(change.layer));
    unnoticed_.push_back(change);
  }
  changed();
}

StageEditor::Step StageEditor::backwards(const Step& step) {
  Step result;
  for (auto change = step.rbegin(); change != step.rend(); ++change) {
    result.push_back(inverse(*change));
  }
  return result;
}

bool StageEditor::undo() {
  if (done_.empty() || open_step_ != nullptr) {
    return false;
  }
  apply_step(backwards(done_.back()));
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  return true;
}

bool StageEditor::redo() {
  if (undone_.empty() || open_step_ != nullptr) {
    return false;
  }
  apply_step(undone_.back());
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  return true;
}

Result<void> StageEditor::as_one_step(const std::function<Result<void>()>& work) {
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
