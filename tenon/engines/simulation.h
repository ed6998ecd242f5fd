// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/physics_scene.h"

/// What every engine offers: a model made from a PhysicsScene that can be steered, stepped and
/// read. Programs hold it as a World (tenon/engines/world.h), which has no virtual functions.
namespace tenon::engines {

/// Unsupported: the engine has no such ability.
Error no_ability(Ability ability);
/// Invalid: the output was not switched on.
Error output_off(std::string_view output);

/// Indices are those of the scene. Errors of all functions that return a Result: Unsupported (rule
/// engine.no-ability) where the engine has no such ability, Invalid (rule simulation.argument)
/// where an index, a count or a number cannot be used. Values that are set hold until they are set
/// again or until reset(), and win over time samples of the asset.
class Simulation {  // all functions inline: derived classes need no type information of the library
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  /// One time step; an Error with code Unstable when the state leaves the finite numbers, or when
  /// the energy grew and no drive, contact, force or moved body has given it.
  virtual Result<void> step() = 0;
  virtual double time() const = 0;       ///< [s] since the start
  virtual double time_step() const = 0;  ///< [s]

  virtual BodyState body_state(scene::Index body) const = 0;
  virtual JointState joint_state(scene::Index joint) const = 0;
  virtual Energy energy() const = 0;
  virtual std::size_t contact_count() const = 0;
  /// Degrees of freedom that the engine simulates.
  virtual std::size_t dof_count() const = 0;
  virtual const std::vector<NotMapped>& not_mapped() const = 0;
  /// What steps are made with: integrator, solver, iterations, distances and thresholds [m, s,
  /// m/s], each a number or a word, under the names of docs/simulation.md.
  virtual std::vector<scene::VendorSetting> settings() const = 0;
  /// Joints that broke (S-93) and fast bodies that passed through others so far, in time order.
  virtual const std::vector<Event>& events() const = 0;
  /// The centre of mass of a body, world [m].
  virtual Vec3d center_of_mass(scene::Index body) const = 0;

  /// Gravity of one scene as it is now, world axes [m/s^2].
  virtual Vec3d gravity(scene::Index scene) const = 0;

  /// The optional abilities of the engine.
  virtual bool can(Ability ability) const = 0;
  virtual EngineObjects engine_objects() const = 0;
  /// The outputs that were switched on when the simulation was made.
  virtual const Outputs& outputs() const = 0;

  // ---- control

  /// Target of drive `drive` (into Joint::drives) of a joint.
  virtual Result<void> set_drive_target(scene::Index /*joint*/, scene::Index /*drive*/,
                                        const DriveTarget& /*target*/) {
    return no_ability(Ability::DriveTargets);
  }
  /// Forces and torques along the free degrees of freedom of a joint, in the order of joint_state()
  /// [N, N m]: on body 1, the opposite on body 0. They come on top of drives. A ball has three, a
  /// torque in the axes of frame 0.
  virtual Result<void> set_joint_efforts(scene::Index /*joint*/,
                                         std::span<const double> /*efforts*/) {
    return no_ability(Ability::JointEfforts);
  }
  /// A force [N] and a torque [N m] at the centre of mass, world axes; wrench_at() makes them of a
  /// force at a point.
  virtual Result<void> set_body_wrench(scene::Index /*body*/, const Wrench& /*wrench*/) {
    return no_ability(Ability::BodyWrenches);
  }
  /// Moves a kinematic body to a pose X_WB [m] within the next step, with the velocity that this
  /// takes; it then stays there.
  virtual Result<void> move_kinematic(scene::Index /*body*/, const Pose& /*pose*/) {
    return no_ability(Ability::KinematicPoses);
  }
  /// Gravity of one scene, world axes [m/s^2].
  virtual Result<void> set_gravity(scene::Index /*scene*/, const Vec3d& /*gravity*/) {
    return no_ability(Ability::Gravity);
  }
  virtual Result<void> set_parameter(const ParameterKey& /*key*/, double /*value*/) {
    return no_ability(Ability::Parameters);
  }
  /// Coordinates and velocities of a joint, as joint_state() gives them [m, rad, m/s, rad/s]: the
  /// bodies behind the joint move along.
  virtual Result<void> set_joint_state(scene::Index /*joint*/, const JointState& /*state*/) {
    return no_ability(Ability::States);
  }
  /// Pose and velocity of a body that moves freely: one on no joint, or a root.
  virtual Result<void> set_body_state(scene::Index /*body*/, const BodyState& /*state*/) {
    return no_ability(Ability::States);
  }
  /// Back to the start, as if the simulation had just been made; everything that was set is gone.
  virtual Result<void> reset() = 0;
  /// Everything that the future of the run depends on, for restore_state() of a simulation of the
  /// same scene, options, engine and version, in this or another process.
  virtual Result<std::string> save_state() const { return no_ability(Ability::SavedStates); }
  /// Continues where save_state() was called; the steps that follow are those bit for bit. Errors:
  /// Corrupt, or Unsupported where the bytes are of another version, engine, scene or time step;
  /// the simulation then is as it was.
  virtual Result<void> restore_state(std::string_view /*bytes*/) {
    return no_ability(Ability::SavedStates);
  }

  // ---- outputs of the last step, or of the start; Invalid (rule simulation.output-off) where
  // SimulationOptions::outputs does not have them

  /// Where colliders touched at the beginning of the step and what they exerted during it.
  virtual Result<std::vector<Contact>> contacts() const { return no_ability(Ability::Contacts); }
  /// Mean forces [N, N m] that a joint's drives exerted during the step (drive_count).
  virtual Result<std::vector<double>> drive_efforts(scene::Index /*joint*/) const {
    return no_ability(Ability::DriveEfforts);
  }
  /// What body 0 exerts on body 1 through the joint, drives, limits and friction included: force
  /// and torque about the origin of frame 1, world axes. Zero where the joint is disabled or broke.
  virtual Result<Wrench> joint_reaction(scene::Index /*joint*/) const {
    return no_ability(Ability::JointReactions);
  }
  virtual Result<BodyAcceleration> body_acceleration(scene::Index /*body*/) const {
    return no_ability(Ability::Accelerations);
  }
  /// Change of the velocities that joint_state() has, by time [m/s^2, rad/s^2]; a ball's are in the
  /// axes of frame 0.
  virtual Result<std::vector<double>> joint_acceleration(scene::Index /*joint*/) const {
    return no_ability(Ability::Accelerations);
  }
  /// Since the start.
  virtual Result<Work> work() const { return no_ability(Ability::Work); }

 protected:
  Simulation(Simulation&&) = default;
  Simulation& operator=(Simulation&&) = default;
};

}  // namespace tenon::engines
