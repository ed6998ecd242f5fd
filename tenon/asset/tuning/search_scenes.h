// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/asset/tuning/tune_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

/// Internal to the tuning of assets.
namespace tenon {

std::vector<tuning::DriveRow> drive_rows_of(const scene::PhysicsScene& scene);

/// Searches for the drives of `tuned` that were asked for, on these engines; `stage` is that of
/// TunedAsset::scene. Where poses are drawn the robot does not touch itself. Errors:
/// those of tuning::search_gains and placed_prim; Limit (tune.search-scenes), Invalid
/// (tune.search-poses) where too few drawn poses close the loops, NotFound
/// (tune.nothing-to-search).
Result<TunedSearch> search_drives(const TuneOptions& options, const stage::Stage& stage,
                                  const TunedAsset& tuned, const std::vector<TunedEngine>& engines);

}  // namespace tenon
