// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/nesting.h"
#include "tenon/engines/simulation.h"

namespace tenon::engines::mujoco {

/// Steps one model. Reading the state brings MuJoCo's derived poses up to date on first use after a
/// step, so one object belongs to one thread at a time.
class MujocoSimulation final : public Simulation {
 public:
  /// `scene` must outlive the simulation. Errors are those of build_model.
  static Result<std::unique_ptr<MujocoSimulation>> make(const physics::PhysicsScene& scene,
                                                        const SimulationOptions& options,
                                                        Diagnostics& diagnostics);

  Result<void> step() override;
  double time() const override;
  double time_step() const override;
  BodyState body_state(physics::Index body) const override;
  JointState joint_state(physics::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return not_mapped_; }
  const std::vector<Event>& events() const override { return events_; }

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

  struct SwitchState {
    const physics::SwitchTrack* track = nullptr;
    bool on = false;
  };
  /// Joint limits and tendons that a bounds track moves.
  struct TrackedBounds {
    const physics::BoundsTrack* track = nullptr;
    int tendon_max = -1;
    int tendon_min = -1;
    int tendon_cone = -1;
    double cone_reach = 0;  ///< tendon length of a cone = reach sin(angle / 2)
  };
  /// Something holds or carries a force that may break it.
  struct Breakable {
    physics::Index joint = 0;
    int child = -1;  ///< MuJoCo body that hangs on it in the tree, else -1
    std::vector<int> equalities;
    std::vector<int> tendons;
    int cone = -1;   ///< tendon that bounds the tilt
    double arm = 0;  ///< [m] of the two points of a loop hinge, and of the tips of a cone
  };

  MujocoSimulation(const physics::PhysicsScene& scene, std::unique_ptr<physics::PhysicsScene> own,
                   BodyNesting nesting, Model model);
  void connect();
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
  // Changes of the scene itself; nothing in most scenes.
  void collect_changes();
  Result<void> follow_changes();
  bool follow_switches();
  bool follow_groups();
  bool follow_bounds();
  bool follow_shapes();
  void follow_gravity();
  bool set_bounds(const TrackedBounds& tracked);
  void set_switch(const physics::SwitchTrack& track, bool on);
  Result<void> rebuild();
  void keep_state();
  void restore_joints(Model& next) const;
  void collect_breakable();
  Result<void> break_joints();
  void load_on(const Breakable& breakable, Vec3d& force, Vec3d& torque) const;
  void load_of_cone(const Breakable& breakable, Vec3d& force, Vec3d& torque) const;
  Result<void> check() const;
  Error unstable(int warning) const;

  void bring_up_to_date() const;
  Pose frame_in_world(const std::optional<physics::Index>& body, const Pose& frame) const;
  JointState tree_joint_state(physics::Index joint) const;
  JointState loop_joint_state(physics::Index joint) const;
  void velocity_of(const std::optional<physics::Index>& body, const Vec3d& point, Vec3d& linear,
                   Vec3d& angular) const;

  const physics::PhysicsScene* scene_;          ///< as it is now: `own_`, or what was given
  std::unique_ptr<physics::PhysicsScene> own_;  ///< where something may change, else null
  BodyNesting nesting_;
  Model model_;
  std::vector<NotMapped> not_mapped_;  ///< of the first model
  std::vector<Event> events_;
  std::vector<SwitchState> switches_;
  std::vector<TrackedBounds> tracked_bounds_;
  std::vector<Breakable> breakable_;
  std::vector<char> broken_;     ///< (joint_count)
  std::size_t group_state_ = 0;  ///< into scene_->group_states, plus one; 0: as at the start
  std::vector<std::size_t> shape_states_;  ///< sample in force (shapes_track_count)
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
