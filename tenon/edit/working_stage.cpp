// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/working_stage.h"

#include <utility>
#include <vector>

#include "tenon/edit/composed_change.h"

namespace tenon::edit {

Result<std::shared_ptr<const stage::Stage>> WorkingStage::get(
    const std::shared_ptr<EditedLayers>& layers, const SceneSources& sources) {
  if (stage_ == nullptr || !stands(*layers) || !follow(*layers)) {
    TENON_TRY(
        stage::Stage composed,
        stage::Stage::open(layers->shown(sources.root), layers->shown_if_copied(sources.session),
                           EditedLayers::opener(layers, sources.opener), sources.options));
    stage_ = std::make_shared<stage::Stage>(std::move(composed));
    follower_.emplace(*stage_);
  }
  composition_ = layers->composition();
  revision_ = layers->revision();
  changes_ = layers->log().size();
  return std::shared_ptr<const stage::Stage>(stage_);
}

layer::LayerPtr WorkingStage::layer(const std::string& identifier) const {
  layer::LayerPtr found;
  if (stage_ != nullptr) {
    for (const layer::LayerPtr& used : stage_->used_layers()) {
      found = used->identifier() == identifier ? used : found;
    }
  }
  return found;
}

/// False when it has to be composed again, whatever the changes are.
bool WorkingStage::stands(const EditedLayers& layers) const {
  if (composition_ == layers.composition() && revision_ == layers.revision()) {
    return true;
  }
  return follower_->can_follow() &&
         (composition_ == layers.composition() ||
          layers.are_in_place_since(composition_, stage_->used_layers()));
}

/// Takes over what changed since it was looked at last. False when it has to be composed again.
bool WorkingStage::follow(const EditedLayers& layers) {
  std::vector<stage::SpecNews> news;
  for (std::size_t i = changes_; i < layers.log().size(); ++i) {
    const LayerChange& change = layers.log()[i];
    if (!add_news(change, *layers.find(change.layer), news) && layer(change.layer) != nullptr) {
      return false;
    }
  }
  return news.empty() || follower_->follow(news);
}

}  // namespace tenon::edit
