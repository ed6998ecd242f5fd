// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/physics/provenance.h"
#include "tenon/physics/readings.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_inertia.h"
#include "tenon/scene/shapes/mesh_tools.h"
#include "tenon/stage/stage.h"

namespace tenon::physics {

class MeshCache;

struct ReadOptions {
  /// Stage time at which the simulation starts; NaN: the stage's startTimeCode when it is authored,
  /// else the default time (S-6).
  double start_time_code = kNotANumber;
  /// Which reading counts where the proposal, OpenUSD and engines disagree.
  Readings readings;
  /// Decomposes and simplifies meshes (S-62). Nothing: the library's own, without files of pieces;
  /// empty functions: meshes stay whole, and this is reported.
  std::optional<MeshTools> mesh_tools;
  /// Where not null: meshes that were made in other readings with it are not made again.
  MeshCache* mesh_cache = nullptr;
  /// Integrals of enabled colliders for those who know better (M-20): asked once per collider, in
  /// its rigid frame [m]. They replace what the shape weighs; a prim that is no shape known here
  /// weighs by them, too, and touches nothing. nullopt: the shape's own.
  Function<std::optional<SolidIntegrals>(const stage::Prim& collider)> integrals;
};

/// Reads every physics prim of the stage. Findings about the asset go to `diagnostics` with stable
/// rule ids; faulty parts are skipped, never guessed silently. `provenance`, where not null, gets
/// the decisions made on the way.
PhysicsScene read_physics(const stage::Stage& stage, const ReadOptions& options,
                          Diagnostics& diagnostics, Provenance* provenance = nullptr);

}  // namespace tenon::physics
