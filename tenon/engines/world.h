// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/simulation_values.h"

namespace tenon::engines {

class Sensors;
class Simulation;

/// A simulation as programs and bindings hold it: a value that moves, without virtual functions and
/// type information in sight. Units, frames and errors are those of Simulation (simulation.h),
/// function by function.
class World {
 public:
  explicit World(std::unique_ptr<Simulation> simulation);
  /// With the sensors of the scene, which must outlive it, where Outputs::sensors is on.
  static Result<World> with_sensors(std::unique_ptr<Simulation> simulation,
                                    const scene::PhysicsScene& scene);
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;
  ~World();

  Result<void> step(std::size_t count = 1);  ///< stops at the first step that fails
  Result<void> reset();
  double time() const;
  double time_step() const;

  BodyState body_state(scene::Index body) const;
  JointState joint_state(scene::Index joint) const;
  Vec3d center_of_mass(scene::Index body) const;
  Vec3d gravity(scene::Index scene) const;
  Energy energy() const;
  std::size_t contact_count() const;
  std::size_t dof_count() const;
  const std::vector<NotMapped>& not_mapped() const;
  std::vector<scene::VendorSetting> settings() const;
  const std::vector<Event>& events() const;
  bool can(Ability ability) const;
  EngineObjects engine_objects() const;
  const Outputs& outputs() const;

  Result<void> set_drive_target(scene::Index joint, scene::Index drive, const DriveTarget& target);
  Result<void> set_joint_efforts(scene::Index joint, std::span<const double> efforts);
  Result<void> set_body_wrench(scene::Index body, const Wrench& wrench);
  /// A force [N] at a point [m], both in world axes: the wrench that it is now, until it is set
  /// again.
  Result<void> set_body_force_at(scene::Index body, const Vec3d& force, const Vec3d& point);
  Result<void> move_kinematic(scene::Index body, const Pose& pose);
  Result<void> set_gravity(scene::Index scene, const Vec3d& gravity);
  Result<void> set_parameter(const ParameterKey& key, double value);
  Result<void> set_joint_state(scene::Index joint, const JointState& state);
  Result<void> set_body_state(scene::Index body, const BodyState& state);
  Result<std::string> save_state() const;
  Result<void> restore_state(std::string_view bytes);

  Result<std::vector<Contact>> contacts() const;
  Result<std::vector<double>> drive_efforts(scene::Index joint) const;
  Result<Wrench> joint_reaction(scene::Index joint) const;
  Result<BodyAcceleration> body_acceleration(scene::Index body) const;
  Result<std::vector<double>> joint_acceleration(scene::Index joint) const;
  Result<Work> work() const;
  /// What the sensors of the scene read (sensor_count). Errors: Invalid
  /// (simulation.output-off).
  Result<std::vector<SensorReading>> sensors() const;

  /// What the World holds; it lives as long, also where the World is moved.
  const Simulation& simulation() const { return *simulation_; }

 private:
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Sensors> sensors_;  ///< null: off
};

}  // namespace tenon::engines
