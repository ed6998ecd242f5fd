// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/diagnostics.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

namespace tenon::bake {

struct MuteCounts {
  std::size_t bodies = 0;
  std::size_t colliders = 0;
  std::size_t joints = 0;
  std::size_t out_of_reach = 0;  ///< inside instances, where no opinion can be placed
};

/// Switches physics off by its enable flags (S-120): an opinion `false` for rigidBodyEnabled,
/// collisionEnabled and jointEnabled in `layer` for every prim of the stage that has the flag on.
/// Nothing is deleted. Samples in the same layer give way. Prims inside instances are reported
/// ("strip.in-instance").
MuteCounts mute_physics(const stage::Stage& stage, layer::Layer& layer, Diagnostics& diagnostics);

}  // namespace tenon::bake
