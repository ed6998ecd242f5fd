// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation.h"

namespace tenon::engines::mujoco {

/// Steps one model. Reading the state brings MuJoCo's derived poses up to date on first use after a
/// step, so one object belongs to one thread at a time.
class MujocoSimulation final : public Simulation {
 public:
  MujocoSimulation(const physics::PhysicsScene& scene, Model model);

  Result<void> step() override;
  double time() const override;
  double time_step() const override;
  BodyState body_state(physics::Index body) const override;
  JointState joint_state(physics::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return model_.not_mapped; }

  /// The engine's own objects, for tests and benchmarks.
  const mjModel& engine_model() const { return *model_.model; }
  const mjData& engine_data() const { return *model_.data; }

 private:
  struct TrackedDrive {
    const physics::ScalarTrack* track = nullptr;
    const DriveMap* drive = nullptr;
  };
  struct DrivenBody {
    const physics::PoseTrack* track = nullptr;
    const BodyMap* body = nullptr;
    Pose next;
    Vec3d linear_velocity;   // over the step that is under way, world axes
    Vec3d angular_velocity;  // own axes
  };
  struct MovedCollider {
    const physics::PoseTrack* track = nullptr;
    int mocap = -1;
  };
  struct DampedBody {
    const BodyMap* body = nullptr;
    double linear = 0;
    double angular = 0;
    Vec3d constant_force;
  };

  void collect_tracks();
  void collect_damped_bodies();
  void start_driven_bodies();
  // What must be written before a step; nothing in most scenes.
  void follow_drive_tracks();
  void scale_acceleration_drives();
  void push_driven_bodies();
  void place_driven_bodies();
  void move_colliders();
  void damp_bodies();
  void advance();
  Result<void> check() const;
  Error unstable(int warning) const;

  void bring_up_to_date() const;
  Pose frame_in_world(const std::optional<physics::Index>& body, const Pose& frame) const;
  JointState tree_joint_state(physics::Index joint) const;
  JointState loop_joint_state(physics::Index joint) const;
  void velocity_of(const std::optional<physics::Index>& body, const Vec3d& point, Vec3d& linear,
                   Vec3d& angular) const;

  const physics::PhysicsScene& scene_;
  Model model_;
  std::vector<TrackedDrive> tracked_drives_;
  std::vector<DrivenBody> driven_bodies_;
  std::vector<MovedCollider> moved_colliders_;
  std::vector<DampedBody> damped_bodies_;
  std::vector<physics::Drive> drives_;            ///< in force now, as model_.drives
  std::vector<std::size_t> acceleration_drives_;  ///< into model_.drives
  std::vector<double> unit_;                      ///< scratch (dof_count)
  std::vector<double> response_;                  ///< scratch (dof_count)
  bool writes_before_step_ = false;
  mutable bool stale_ = true;
};

}  // namespace tenon::engines::mujoco
