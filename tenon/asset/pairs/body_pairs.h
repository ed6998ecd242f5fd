// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/physics/provenance.h"
#include "tenon/scene/physics_scene.h"

/// Which bodies of a scene touch, at the start and over drawn postures of its joints.
namespace tenon {

/// How often two bodies touch in the drawn postures.
enum class PairClass : std::uint8_t {
  Always,     ///< in each
  Often,      ///< in at least half of them
  Sometimes,  ///< in fewer
  Never,
};

/// "always", "often", "sometimes", "never".
std::string_view pair_class_name(PairClass which);

/// Whether filters of the asset keep two bodies apart.
enum class PairFiltered : std::uint8_t {
  No,
  Partly,  ///< some of their colliders
  Yes,     ///< all of them
};

/// "no", "partly", "yes".
std::string_view pair_filtered_name(PairFiltered which);

/// Two bodies, or a body and a static collider.
struct BodyPair {
  Path a;  ///< the lower path; of static colliders the collider itself
  Path b;
  scene::Index collider_a = 0;  ///< into PhysicsScene::colliders, of the deepest contact, else any
  scene::Index collider_b = 0;
  bool adjacent = false;              ///< a joint connects them
  std::optional<double> start_depth;  ///< [m] where they touch at the start
  std::size_t touching = 0;           ///< drawn postures in which they touch
  std::optional<PairClass> often;     ///< none where no posture was drawn
  double depth = 0;                   ///< the greatest, the start included [m]
  /// The drawn posture of it; none: the start.
  std::optional<std::uint64_t> posture;
  PairFiltered filtered = PairFiltered::No;
  std::vector<physics::PairReason> filters;  ///< of the colliders above
  /// Filtered pairs of the asset alone keep them apart, and they touch neither at the start nor in
  /// half of the postures: they are let through each other there.
  bool over_filtered = false;

  bool touches() const { return start_depth.has_value() || touching > 0; }
};

struct BodyPairsOptions {
  std::size_t samples = 1000;  ///< postures; limits::kPairPostures at most
  std::uint64_t seed = 0;
  bool environment = false;  ///< static colliders, too
  bool all = false;          ///< pairs that never touch, too
  std::size_t threads = 0;   ///< 0: as many as this process may use
  /// Called now and then with how many postures are done.
  Function<void(std::size_t done, std::size_t of)> progress;
  /// Asked at each posture, by all threads; true ends the search. Empty: it goes on to its end.
  Function<bool()> is_over;
};

struct BodyPairs {
  std::size_t postures = 0;     ///< that were drawn; 1, the start, where nothing can be drawn
  std::size_t skipped = 0;      ///< of them, in which loops do not close
  std::size_t coordinates = 0;  ///< that were drawn
  std::size_t bodies = 0;       ///< with colliders, static colliders that count among them
  std::size_t pair_count = 0;   ///< of them, of the same scene
  std::size_t never = 0;        ///< of these, not seen to touch
  /// By paths: those that touch, that a joint connects, and that filtered pairs of the asset name;
  /// with `all` every one.
  std::vector<BodyPair> pairs;
  std::vector<engines::NotMapped> shapes;  ///< that are not exactly those of the asset

  std::size_t counted() const { return postures - skipped; }
};

/// Depths below this are no contact [m].
inline constexpr double kTouchingDepth = 1e-6;
/// On MuJoCo's shapes (engines/mujoco/overlap/penetrations.h); the same for any number of threads.
/// Errors: Missing (engine.missing) without MuJoCo, those of Penetrations, Limit (pairs.too-many),
/// Invalid (pairs.ended) where `is_over` says so.
Result<BodyPairs> body_pairs(const scene::PhysicsScene& scene,
                             const physics::Provenance& provenance, const BodyPairsOptions& options,
                             Diagnostics& diagnostics);

/// Of drawn postures, or of the start, the coordinates as in dynamics::Posture::joints.
using JointCoordinates = std::vector<std::vector<double>>;
std::vector<JointCoordinates> posture_joints(
    const scene::PhysicsScene& scene, std::uint64_t seed,
    const std::vector<std::optional<std::uint64_t>>& postures);

}  // namespace tenon
