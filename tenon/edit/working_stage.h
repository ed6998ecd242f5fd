// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "tenon/base/result.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/edit/edited_layers.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/edited/spec_follower.h"
#include "tenon/stage/stage.h"

/// Internal to this folder.
namespace tenon::edit {

/// What a scene is composed of.
struct SceneSources {
  layer::LayerPtr root;
  layer::LayerPtr session;  ///< may be null
  compose::LayerOpener opener;
  stage::StageOptions options;
};

/// A scene of edited layers, composed as seldom as that can be. Edits of values, properties, types
/// and applied schemas and most new prims change it where it is; after others it is another one.
class WorkingStage {
 public:
  /// With all edits so far. Errors: those of stage::Stage::open.
  Result<std::shared_ptr<const stage::Stage>> get(const std::shared_ptr<EditedLayers>& layers,
                                                  const SceneSources& sources);
  /// A layer that the scene had opened when it was composed last; null: none.
  layer::LayerPtr layer(const std::string& identifier) const;

 private:
  bool stands(const EditedLayers& layers) const;
  bool follow(const EditedLayers& layers);

  std::shared_ptr<stage::Stage> stage_;
  std::optional<stage::SpecFollower> follower_;  // of it
  std::size_t composition_ = 0;                  // EditedLayers::composition() of it
  std::size_t revision_ = 0;                     // EditedLayers::revision() that it shows
  std::size_t changes_ = 0;                      // changes in the log that it shows
};

}  // namespace tenon::edit
