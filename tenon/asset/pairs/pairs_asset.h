// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/asset/pairs/body_pairs.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// The bodies of an asset, and which pairs of them touch.
struct PairsOfAsset {
  std::unique_ptr<stage::Stage> stage;
  std::unique_ptr<scene::PhysicsScene> scene;
  physics::Provenance provenance;
  BodyPairsOptions options;
  BodyPairs found;
};

/// Without a look for contacts, `found` stays empty. Errors: those of tenon::open. Diagnostics:
/// "pairs.no-bodies".
Result<PairsOfAsset> bodies_of_asset(const std::string& path, const OpenOptions& open,
                                     Diagnostics& diagnostics);
/// Errors: these and those of body_pairs.
Result<PairsOfAsset> pairs_of_asset(const std::string& path, const OpenOptions& open,
                                    const BodyPairsOptions& options, Diagnostics& diagnostics);

}  // namespace tenon
