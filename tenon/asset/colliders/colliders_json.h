// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/asset/colliders/colliders_asset.h"

namespace tenon {

/// {"budget": {"cost", "gap" [m]} or null, "engines": [{"engine", "engineVersion", "variant",
/// "colliders": [{"collider", "body", "asked", "approximation", "used", "pieces", "vertices",
/// "triangles", "cost", "volume" [m^3], "meshVolume" [m^3], "cover": the one by the other,
/// "outside" [m], "inside" [m], "gap": the larger one [m], "gapError" [m], "size": of the mesh [m],
/// "penetration" [m], "penetrated": a collider, "changes", "overBudget", "notes"}]}], "request":
/// [PRIM=APPROXIMATION]}. Null: "budget" without one; "body" of a static collider; "asked",
/// "approximation" and "size" of what is no mesh; volumes, gaps and penetrations that are not
/// known.
answers::Json colliders_json(const CollidersOfAsset& found);

}  // namespace tenon
