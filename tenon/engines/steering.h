// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/simulation_values.h"

/// What the user of a simulation has set: the same for every engine, checked in one place.
namespace tenon::engines {

struct Steering {
  /// By joint and drive.
  std::map<std::pair<scene::Index, scene::Index>, DriveTarget> targets;
  std::map<scene::Index, std::vector<double>> efforts;  ///< by joint, as Simulation has them
  std::map<scene::Index, Wrench> wrenches;              ///< by body, at the centre of mass
  std::map<scene::Index, Pose> poses;                   ///< by kinematic body
  std::map<scene::Index, Vec3d> gravity;                ///< by scene
  std::map<ParameterKey, double> parameters;

  bool empty() const {
    return targets.empty() && efforts.empty() && wrenches.empty() && poses.empty() &&
           gravity.empty() && parameters.empty();
  }
  /// Gravity of all scenes as it is now [m/s^2] (scene_count).
  std::vector<Vec3d> gravity_of(const scene::PhysicsScene& scene) const;
};

// Whether arguments can be used. Errors: Invalid (rule simulation.argument).

Result<void> check_body(const scene::PhysicsScene& scene, scene::Index body);
Result<void> check_joint(const scene::PhysicsScene& scene, scene::Index joint);
Result<void> check_target(const scene::PhysicsScene& scene, scene::Index joint, scene::Index drive,
                          const DriveTarget& target);
/// `dof_count` is how many the joint has.
Result<void> check_efforts(const scene::PhysicsScene& scene, scene::Index joint,
                           std::span<const double> efforts, std::size_t dof_count);
Result<void> check_wrench(const scene::PhysicsScene& scene, scene::Index body,
                          const Wrench& wrench);
Result<void> check_pose(const scene::PhysicsScene& scene, scene::Index body, const Pose& pose);
Result<void> check_gravity(const scene::PhysicsScene& scene, scene::Index index,
                           const Vec3d& gravity);
Result<void> check_parameter(const scene::PhysicsScene& scene, const ParameterKey& key,
                             double value);
Result<void> check_joint_state(const scene::PhysicsScene& scene, scene::Index joint,
                               const JointState& state, std::size_t dof_count);
Result<void> check_body_state(const scene::PhysicsScene& scene, scene::Index body,
                              const BodyState& state);
/// All of it; `dof_counts` by joint.
Result<void> check_steering(const scene::PhysicsScene& scene, const Steering& steering,
                            std::span<const std::size_t> dof_counts);

/// Finite, with an orientation that is not zero.
bool is_usable(const Pose& pose);

/// Invalid (rule simulation.argument).
Error bad_argument(std::string message);

}  // namespace tenon::engines
