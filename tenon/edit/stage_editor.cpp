// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers, edit target and composition; the edits themselves are in *_edits.cpp, the history in
// edited_layers.cpp. There are two looks at the composed scene, at the edited layers where they
// are. `view()` composes the prims that an edit asks for and no others, and serves until prims may
// be composed otherwise, so that many values can be set in a row. `working_stage()` composes
// everything, and likewise serves as long as it can. `stage()` hands it out to stay as it is: the
// next edit of one of its layers changes a copy.
#include "tenon/edit/stage_editor.h"

#include "tenon/compose/prim_index.h"
#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/edit/working_stage.h"

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
    : sources_(std::make_unique<SceneSources>(SceneSources{std::move(root), std::move(session),
                                                           std::move(opener), std::move(options)})),
      layers_(std::make_shared<EditedLayers>()),
      working_(std::make_unique<WorkingStage>()) {
  target_.layer = sources_->root->identifier();
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

StageEditor StageEditor::under_session(layer::LayerPtr session) const {
  StageEditor other(sources_->root, std::move(session), sources_->opener, sources_->options);
  other.layers_ = layers_;
  return other;
}

// Composition

ComposedView& StageEditor::view() {
  if (view_ == nullptr || view_composition_ != layers_->composition()) {
    view_ = std::make_unique<ComposedView>(
        layers_->shown(sources_->root), layers_->shown_if_copied(sources_->session),
        EditedLayers::opener(layers_, sources_->opener), sources_->options.compose);
    view_composition_ = layers_->composition();
  }
  return *view_;
}

Result<std::shared_ptr<const stage::Stage>> StageEditor::stage() {
  TENON_TRY(auto composed, working_stage());
  layers_->keep();
  if (stage_ == nullptr || stage_revision_ != layers_->revision()) {
    earlier_ = std::move(stage_);
    earlier_changes_ = stage_changes_;
  }
  stage_ = std::move(composed);
  stage_revision_ = layers_->revision();
  stage_changes_ = layers_->log().size();
  return stage_;
}

Result<std::shared_ptr<const stage::Stage>> StageEditor::working_stage() {
  return working_->get(layers_, *sources_);
}

const ChangeNotice& StageEditor::notice() {
  if (earlier_ != nullptr) {
    const std::vector<LayerChange>& log = layers_->log();
    const auto begin = log.begin();
    notice_ = compare_stages(*earlier_, *stage_,
                             {begin + static_cast<std::ptrdiff_t>(earlier_changes_),
                              begin + static_cast<std::ptrdiff_t>(stage_changes_)});
    earlier_.reset();
  }
  return notice_;
}

// Layers

layer::LayerPtr StageEditor::layer(const std::string& identifier) {
  if (layers_->is_edited(identifier)) {
    return layers_->find(identifier);
  }
  for (const layer::LayerPtr& known : {sources_->root, sources_->session, target_layer_}) {
    if (known != nullptr && known->identifier() == identifier) {
      return known;
    }
  }
  layer::LayerPtr found = view().layer(identifier);
  if (found == nullptr) {
    found = working_->layer(identifier);
  }
  // What scenes hold changes with edits; what is handed out does not.
  const layer::LayerPtr copy = found == nullptr ? nullptr : layers_->find(identifier);
  return copy == nullptr ? found : copy;
}

void StageEditor::add_layer(layer::Layer layer) { layers_->add(std::move(layer)); }

std::map<std::string, layer::LayerPtr> StageEditor::edited_layers() const {
  std::map<std::string, layer::LayerPtr> edited;
  for (const LayerChange& change : changes()) {
    edited.emplace(change.layer, layers_->find(change.layer));
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
  if (layers_->find(target.layer) == nullptr) {
    target_layer_ = found;
  }
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
  for (std::uint32_t id = 0; id < found.index->nodes().size(); ++id) {
    const compose::Node& node = found.index->nodes()[id];
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

// Edits

Result<void> StageEditor::edit(const Function<Result<void>(LayerEditor&)>& work) {
  return edit_layer(target_.layer, work);
}

Result<void> StageEditor::edit_layer(const std::string& identifier,
                                     const Function<Result<void>(LayerEditor&)>& work) {
  if (!layers_->is_edited(identifier)) {
    const layer::LayerPtr original = layer(identifier);
    if (original == nullptr) {
      return unknown_layer(identifier);
    }
    layers_->copy(original);
  }
  return layers_->edit(identifier, work);
}

}  // namespace tenon::edit
