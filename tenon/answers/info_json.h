// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// What an asset is: {"stage": {"layers", "defaultPrim", "upAxis", "metersPerUnit",
/// "kilogramsPerUnit", "timeCodesPerSecond", "primCount"}, "variants": rows of `variants_json`,
/// "physics": how much there is of each kind, "mass_kg" of what moves freely [kg], "joints": counts
/// by type, "missing": [{"layer", "prim", "arc", "path"}]}. Layers are named as seen from the
/// folder of the root layer. `scene` is what physics made of the stage.
Json info_json(const stage::Stage& stage, const scene::PhysicsScene& scene);

}  // namespace tenon::answers
