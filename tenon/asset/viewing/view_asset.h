// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/bake/pose_recording.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"
#include "tenon/view/view_scene.h"

/// The visuals of an asset, and files that show it.
namespace tenon {

/// The visuals of the asset at `path`, which is open as `stage` by `open` and read as `scene`.
/// Images come from folders that may go into outputs (tenon/asset_policy.h). Colliders are included
/// only on request.
view::ViewScene view_of_asset(const stage::Stage& stage, const scene::PhysicsScene& scene,
                              const std::string& path, const OpenOptions& open, bool colliders);

/// The asset at `path` as a run of it would begin: the stage and the scene alone, no simulation.
/// Errors: those of tenon::open.
Result<SimulatedAsset> asset_at_start(const std::string& path, const SimulateAssetOptions& options,
                                      Diagnostics& diagnostics);

/// What could not be shown, as findings "view.left-out"; of each kind the first one and their
/// number.
void report_notes(const view::ViewScene& view, Diagnostics& diagnostics);

/// The drawn parts of an asset, and its run.
struct DrawnAsset {
  view::ViewScene view;
  std::size_t triangles = 0;   ///< that are drawn
  bake::PoseRecording motion;  ///< without frames where nothing was simulated
  bool moves = false;          ///< it was simulated

  /// For GlbOptions::motion.
  const bake::PoseRecording* played() const { return moves ? &motion : nullptr; }
};

/// Of the asset at `path`, simplified to about `triangles` (0: all); what could not be shown is
/// reported (report_notes).
DrawnAsset drawn_asset(const SimulatedAsset& asset, const std::string& path,
                       const OpenOptions& open, bool colliders, std::size_t triangles,
                       Diagnostics& diagnostics);

struct ViewFileOptions {
  std::size_t triangles = 0;  ///< that are drawn at most, about; 0: all
  bool compressed = false;    ///< GlbOptions::compressed
  bool colliders = false;
};

/// A GLB of the asset at `path` that plays its run. Errors: those of glb::write_glb.
Result<std::string> motion_glb(const SimulatedAsset& simulated, const std::string& path,
                               const OpenOptions& open, const ViewFileOptions& options,
                               Diagnostics& diagnostics);

}  // namespace tenon
