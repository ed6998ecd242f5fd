// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// The inputs of a model before every step: drives, bodies and colliders that follow the asset's
/// time samples, and forces that MuJoCo does not know, which are acceleration drives, drives whose
/// maximum depends on the speed, the damping of bodies on joints and constant forces. Nothing in
/// most scenes.
class StepInputs {
 public:
  StepInputs() = default;
  /// Also gives driven bodies their poses and velocities of now. Both must stay where they are.
  StepInputs(const scene::PhysicsScene& scene, Model& model);

  /// Velocities are asked for, so that derive_motion() must have run.
  bool needs_motion() const { return !pushed_bodies_.empty(); }
  /// Whether the inputs include forces on bodies.
  bool has_forces() const { return !pushed_bodies_.empty() || !driven_bodies_.empty(); }
  void before_step(Model& model) {
    if (!empty_) {
      write(model);
    }
  }
  void after_step(Model& model) const;
  /// The constant forces of the model are other ones.
  void take_constant_forces(const Model& model);
  /// Takes the word of a user in place of the asset's samples. False: the body is not driven.
  bool set_pose(scene::Index body, const Pose& pose);
  void set_target(std::size_t drive, const DriveTarget& target, Model& model);
  /// The number of a drive, into Model::drives, is another one.
  void set_gain(std::size_t drive, Parameter what, double value, Model& model);
  bool has_acceleration_drives() const { return !acceleration_drives_.empty(); }

 private:
  struct TrackedDrive {
    const scene::ScalarTrack* track = nullptr;
    std::size_t drive = 0;   ///< into Model::drives
    bool overruled = false;  ///< the user has set it
  };
  struct DrivenBody {
    const scene::PoseTrack* track = nullptr;
    scene::Index index = 0;      ///< into the scene's bodies
    std::optional<Pose> wanted;  ///< set by the user, in place of the track
    BodyMap body;
    Pose next;
    Vec3d linear_velocity;   ///< over the step that is under way, world axes
    Vec3d angular_velocity;  ///< own axes
  };
  struct MovedCollider {
    const scene::PoseTrack* track = nullptr;
    int mocap = -1;
  };
  /// Damped, under constant forces, or without gyroscopic torque.
  struct PushedBody {
    const scene::Body* body = nullptr;
    BodyMap map;
    double linear = 0;   ///< damping [1/s]
    double angular = 0;  ///< damping [1/s]
    Vec3d constant_force;
    Vec3d constant_torque;
  };
  bool has_none() const;
  void write(Model& model);
  void collect_drives(const scene::PhysicsScene& scene, const Model& model);
  void collect_tracks(const scene::PhysicsScene& scene, const Model& model);
  void collect_pushed_bodies(const scene::PhysicsScene& scene, const Model& model);
  void start_driven_bodies(Model& model);
  void follow_drive_tracks(Model& model);
  void write_gain(std::size_t drive, scene::Animated what, double value, Model& model);
  void overrule(std::size_t drive, scene::Animated what);
  void scale_acceleration_drives(Model& model);
  void move_colliders(Model& model) const;
  void push_bodies(Model& model) const;
  void bound_efforts(Model& model) const;
  void push_driven_bodies(Model& model);

  std::vector<TrackedDrive> tracked_drives_;
  std::vector<DrivenBody> driven_bodies_;
  std::vector<MovedCollider> moved_colliders_;
  std::vector<PushedBody> pushed_bodies_;
  std::vector<scene::Drive> drives_;              ///< in force now, as Model::drives
  std::vector<std::size_t> acceleration_drives_;  ///< into Model::drives
  std::vector<std::size_t> bounded_drives_;       ///< into Model::drives: those with an envelope
  bool empty_ = true;                             ///< nothing is written before a step
  std::vector<double> unit_;                      ///< scratch (dof_count)
  std::vector<double> response_;                  ///< scratch (dof_count)
};

}  // namespace tenon::engines::mujoco
