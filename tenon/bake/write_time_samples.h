// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/bake/pose_recording.h"
#include "tenon/base/diagnostics.h"
#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::bake {

struct BakeOptions {
  std::string asset_path;  ///< how the overlay names the asset: written into its subLayers
  /// Variant selections that were in force through the session layer, set and variant by prim; the
  /// overlay repeats them, so that it plays what was simulated.
  std::map<Path, std::map<std::string, std::string>> variant_selections;
  /// Instances that bodies lie in become ordinary prims in the overlay: `instanceable = false`
  /// (S-123).
  bool uninstance = false;
};

/// An overlay layer: sublayers the asset and gives every simulated body time samples of its
/// xformOps, so that composed world poses equal the recording (S-25, S-35). Authored scale is kept;
/// the asset is not touched. Bodies inside instances cannot be overridden (S-123): an error names
/// them (bake.instanced-body), unless `uninstance` is on. Kinematic bodies keep their
/// authored animation (S-27).
layer::Layer write_time_samples(const stage::Stage& stage, const scene::PhysicsScene& scene,
                                const PoseRecording& recording, const BakeOptions& options,
                                Diagnostics& diagnostics);

}  // namespace tenon::bake
