// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bake/pose_recording.h"
#include "tenon/layer/layer.h"
#include "tenon/physics/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::bake {

struct BakeOptions {
  std::string asset_path;  ///< how the overlay names the asset: written into its subLayers
};

/// An overlay layer: sublayers the asset and gives every simulated body time samples of its
/// xformOps, so that composed world poses equal the recording (S-25, S-35). The rest of the op
/// stack and the authored scale are kept; the asset is not touched. Bodies inside instances cannot
/// be overridden (S-123): a diagnostic names them.
Result<layer::Layer> write_time_samples(const stage::Stage& stage,
                                        const physics::PhysicsScene& scene,
                                        const PoseRecording& recording, const BakeOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace tenon::bake
