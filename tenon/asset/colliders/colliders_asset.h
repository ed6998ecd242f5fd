// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/colliders/collider_figures.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/scene/physics_scene.h"

/// The colliders of an asset as engines have them (`tenon colliders`).
namespace tenon {

/// What is chosen among for colliders that are meshes.
struct ColliderBudget {
  std::size_t cost = 0;       ///< ColliderFigures::cost at most
  std::optional<double> gap;  ///< [m]; none: kGapShare of the size of the mesh
};
inline constexpr double kGapShare = 0.02;

struct CollidersOptions {
  OpenOptions open;
  /// "mujoco", "physx", "jolt", "all"; empty: as choose_engine() decides. Each has the variant of
  /// "Physics" that is its own, where `open` selects none.
  std::string engine;
  std::vector<std::string> colliders;           ///< patterns of names or paths; empty: all
  std::optional<scene::Approximation> instead;  ///< of all meshes that were asked for
  std::optional<ColliderBudget> budget;         ///< of one engine; not with `instead`
  Function<void(std::size_t done, std::size_t of)> progress;
};

/// One collider.
struct ColliderRow {
  Path path;
  Path body;  ///< empty: static
  bool is_mesh = false;
  bool moves = false;                         ///< forces move its body
  std::optional<scene::Approximation> asked;  ///< of meshes: by the asset
  std::optional<scene::Approximation> as;     ///< of meshes: what the figures are of
  ColliderFigures figures;
  double size = 0;  ///< diagonal of the box around the mesh [m]; 0: no mesh
  /// How deep it is in colliders of other bodies at the start that no filter keeps apart, by
  /// MuJoCo's shapes [m]; none: MuJoCo is not there, or refuses the shapes.
  std::optional<double> penetration;
  Path penetrated;  ///< the collider of the deepest
  /// With a budget: nothing keeps to it, so `as` is what was asked.
  bool over_budget = false;

  bool changes() const;
};

struct CollidersOfEngine {
  std::string engine;
  std::string version;
  std::string variant;  ///< of "Physics"; empty: none is selected
  std::vector<ColliderRow> rows;
};

struct CollidersOfAsset {
  std::vector<CollidersOfEngine> engines;
  std::optional<ColliderBudget> budget;
};

/// The words of `instead`: the schema's tokens, and short ones ("hull", "box").
std::optional<scene::Approximation> approximation_named(const std::string& name);
std::vector<std::string> approximation_words();

/// Errors: those of tenon::open; Missing (engine.missing); NotFound (colliders.none) for a pattern
/// that means no collider; Invalid (colliders.engines) for a budget of several engines.
Result<CollidersOfAsset> colliders_of_asset(const std::string& path,
                                            const CollidersOptions& options,
                                            Diagnostics& diagnostics);

/// What makes meshes collide as a budget chose: as `EditRequest::collider` has it.
std::vector<std::string> collider_requests(const CollidersOfAsset& found);

}  // namespace tenon
