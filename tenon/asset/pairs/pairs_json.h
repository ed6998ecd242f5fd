// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/asset/pairs/pairs_asset.h"

namespace tenon {

/// {"postures", "skipped", "seed", "coordinates", "environment", "bodies", "pairCount", "never",
/// "pairs": [{"bodyA", "bodyB", "colliderA", "colliderB", "adjacent", "startDepth" [m], "touching":
/// postures, "share", "class", "depth" [m], "posture": {"number", "joints": [{"joint", "values" [m
/// or rad]}]}, "filtered": "no", "partly" or "yes", "filters": [{"rule", "why", "prim",
/// "property"}], "overFiltered"}], "shapes": [{"prim", "property", "why"}]}. "colliderA" and the
/// next are those of the deepest contact. Null: "startDepth" of bodies that do not touch at the
/// start, "share" and "class" where no posture was drawn, "posture" and "depth" of bodies that
/// never touch, "number" of the start. Listed are pairs that touch and those that are
/// over-filtered, with `options.all` every pair.
answers::Json pairs_json(const PairsOfAsset& pairs);

}  // namespace tenon
