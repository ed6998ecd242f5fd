// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tenon/engines/input_log.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/steering.h"

namespace tenon::engines {

/// What every engine does with the values that a user sets and asks for: arguments are checked, the
/// value is remembered (a model that is rebuilt gets it again) and written into the engine, and
/// what depends on it is told. An output is read only where it was switched on.
class SteeredSimulation : public Simulation {
 public:
  const std::vector<Event>& events() const final { return events_; }
  Vec3d gravity(scene::Index scene) const final { return steering_.gravity_of(*scene_)[scene]; }

  Result<void> set_drive_target(scene::Index joint, scene::Index drive,
                                const DriveTarget& target) final;
  Result<void> set_joint_efforts(scene::Index joint, std::span<const double> efforts) final;
  Result<void> set_body_wrench(scene::Index body, const Wrench& wrench) final;
  Result<void> move_kinematic(scene::Index body, const Pose& pose) final;
  Result<void> set_gravity(scene::Index scene, const Vec3d& gravity) final;
  Result<void> set_parameter(const ParameterKey& key, double value) final;
  Result<void> set_joint_state(scene::Index joint, const JointState& state) final;
  Result<void> set_body_state(scene::Index body, const BodyState& state) final;

  Result<std::vector<Contact>> contacts() const final;
  Result<std::vector<double>> drive_efforts(scene::Index joint) const final;
  Result<Wrench> joint_reaction(scene::Index joint) const final;
  Result<BodyAcceleration> body_acceleration(scene::Index body) const final;
  Result<std::vector<double>> joint_acceleration(scene::Index joint) const final;
  Result<Work> work() const final;

 protected:
  explicit SteeredSimulation(const scene::PhysicsScene& scene) : scene_(&scene) {}
  SteeredSimulation(SteeredSimulation&&) = default;
  SteeredSimulation& operator=(SteeredSimulation&&) = default;

  // ---- what an engine does. Arguments were checked, and `steering_` has the value; where an error
  // is returned it has it no longer.

  virtual Result<void> write_target(scene::Index joint, scene::Index drive) = 0;
  virtual Result<void> write_wrench(scene::Index /*body*/) { return {}; }
  virtual Result<void> write_pose(scene::Index /*body*/) { return {}; }
  /// Of all scenes.
  virtual Result<void> write_gravity() = 0;
  virtual Result<void> write_parameter(const ParameterKey& key, double value) = 0;
  virtual Result<void> write_joint_state(scene::Index joint, const JointState& state) = 0;
  virtual Result<void> write_body_state(scene::Index body, const BodyState& state) = 0;
  /// Something was set.
  virtual void note(const Input& /*input*/) {}
  /// Energy [J] came in from outside of steps; called where Outputs::work is on.
  virtual void add_change(double /*energy*/) {}

  // ---- outputs of the last step, or of the start; called where they are on.

  virtual std::vector<Contact> contacts_of_step() const = 0;
  virtual std::vector<double> efforts_of_step(scene::Index joint) const = 0;
  virtual Wrench reaction_of_step(scene::Index joint) const = 0;
  virtual BodyAcceleration body_acceleration_of_step(scene::Index body) const = 0;
  virtual std::vector<double> joint_acceleration_of_step(scene::Index joint) const = 0;
  virtual Work work_of_run() const { return {}; }

  // ---- for engines

  /// Makes a change from outside and accounts for the energy that it brings.
  template <class Call>
  Result<void> accounted(const Call& call) {
    if (!outputs().work) {
      return call();
    }
    const double before = energy().total();
    TENON_CHECK(call());
    add_change(energy().total() - before);
    return {};
  }
  /// Unsupported (rule ENGINE.not-steerable).
  Error not_steerable(const Path& prim, const std::string& why) const;
  /// Writes all values that `steering_` has into a model that knows nothing of them. What no longer
  /// exists there stays remembered. Errors: those of the engine.
  Result<void> write_steering();
  /// "physx.unstable".
  std::string rule(const char* name) const;

  const scene::PhysicsScene* scene_;  ///< as it is now
  Steering steering_;
  std::vector<Event> events_;

 private:
  template <class Values, class Write>
  Result<void> set(Values& values, const typename Values::key_type& key,
                   typename Values::mapped_type value, const Input& input, const Write& write);
};

/// Whether a parameter is one of a drive.
bool is_of_drive(Parameter what);
/// The mass [kg] of a body set to `mass`; its inertia changes by the same ratio.
scene::Body with_mass(scene::Body body, double mass);
/// Mean accelerations of a joint, from its velocities before and after a step of `time_step` [s]; 0
/// where those before are unknown.
std::vector<double> mean_acceleration(const std::vector<JointState>& before, scene::Index joint,
                                      const JointState& now, double time_step);
/// The same of a body.
BodyAcceleration mean_acceleration(const std::vector<BodyState>& before, scene::Index body,
                                   const BodyState& now, double time_step);

}  // namespace tenon::engines
