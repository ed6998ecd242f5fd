// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/scene/physics_scene.h"

/// What the motors of an asset can do, and what they need.
namespace tenon {

/// Limits that a driven degree of freedom is to have. [N m or N, rad/s or m/s]
struct WantedLimits {
  Path joint;
  scene::Dof dof = scene::Dof::RotX;
  std::optional<double> effort;  ///< not given: as is
  std::optional<double> speed;
};

struct DrivesOptions {
  OpenOptions open;
  std::size_t samples = 0;  ///< postures drawn within the limits of the joints, beside the start
  std::uint64_t seed = 0;
  std::string specs;                 ///< a file of motor_specs.h; empty: none
  std::vector<WantedLimits> limits;  ///< count over those of `specs`
  /// Called after each posture with how many are done; false ends the search. May be empty.
  Function<bool(std::size_t done, std::size_t of)> go_on;
  std::string
      mimic;  ///< "rigid", or "FREQUENCY,RATIO" as PhysxMimicJointAPI has them; empty: as is
};

/// One driven degree of freedom. Efforts in N m or N, speeds in rad/s or m/s.
struct DriveDemand {
  Path joint;
  scene::Dof dof = scene::Dof::RotX;
  bool acceleration = false;
  double stiffness = 0;    ///< SI
  double damping = 0;      ///< SI
  double max_effort = 0;   ///< infinite: unlimited
  double speed_limit = 0;  ///< infinite: unlimited
  /// The largest weight that it has to hold over the postures, followers and loops moving along;
  /// not finite where that is not known.
  double weight = 0;
  double weight_at = 0;      ///< its own coordinate there [rad or m]
  double least_inertia = 0;  ///< of EffectiveInertia::held over the postures [kg m^2 or kg]
  double most_inertia = 0;
  std::vector<Path> followers;
  std::optional<double> new_effort;  ///< that the file of specs gives
  std::optional<double> new_speed;

  /// It cannot hold that weight, with what it is to have.
  bool is_too_weak() const;
};

/// A joint that follows another.
struct FollowerOfDrive {
  Path joint;
  Path leader;
  double multiplier = 1;
  double frequency = 0;  ///< of its compliance [rad/s]; with ratio 0: rigid
  double ratio = 0;
};

struct DrivesOfAsset {
  std::unique_ptr<scene::PhysicsScene> scene;
  std::vector<DriveDemand> drives;  ///< in the order of the joints
  std::vector<FollowerOfDrive> followers;
  std::size_t postures = 0;      ///< that were looked at, the start among them
  std::vector<AssetEdit> edits;  ///< what writes the efforts, speeds and mimics that were asked for
};

/// Opens the asset and looks. Errors: those of tenon::open and read_motor_specs; NotFound
/// (drives.no-joint) for a pattern that means no driven joint, with its line, and (drives.no-tip)
/// for a tip that is no prim; Invalid (drives.specs) where keys contradict each other or do not fit
/// the joint, (drives.ended) where `go_on` ends it; NotFound (drives.no-joint) for limits of a
/// joint that is not driven so.
Result<DrivesOfAsset> drives_of_asset(const std::string& path, const DrivesOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace tenon
