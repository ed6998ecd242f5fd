// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/world.h"

#include <utility>

#include "tenon/engines/sensors.h"
#include "tenon/engines/simulation.h"

namespace tenon::engines {

World::World(std::unique_ptr<Simulation> simulation) : simulation_(std::move(simulation)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

Result<World> World::with_sensors(std::unique_ptr<Simulation> simulation,
                                  const scene::PhysicsScene& scene) {
  World world(std::move(simulation));
  if (world.outputs().sensors) {
    world.sensors_ = std::make_unique<Sensors>(scene, *world.simulation_);
    TENON_CHECK(world.sensors_->restart());
  }
  return world;
}

Result<void> World::step(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    TENON_CHECK(simulation_->step());
    if (sensors_) {
      TENON_CHECK(sensors_->after_step());
    }
  }
  return {};
}
Result<void> World::reset() {
  TENON_CHECK(simulation_->reset());
  return sensors_ ? sensors_->restart() : Result<void>();
}
double World::time() const { return simulation_->time(); }
double World::time_step() const { return simulation_->time_step(); }

BodyState World::body_state(scene::Index body) const { return simulation_->body_state(body); }
JointState World::joint_state(scene::Index joint) const { return simulation_->joint_state(joint); }
Vec3d World::center_of_mass(scene::Index body) const { return simulation_->center_of_mass(body); }
Vec3d World::gravity(scene::Index scene) const { return simulation_->gravity(scene); }
Energy World::energy() const { return simulation_->energy(); }
std::size_t World::contact_count() const { return simulation_->contact_count(); }
std::size_t World::dof_count() const { return simulation_->dof_count(); }
const std::vector<NotMapped>& World::not_mapped() const { return simulation_->not_mapped(); }
std::vector<scene::VendorSetting> World::settings() const { return simulation_->settings(); }
const std::vector<Event>& World::events() const { return simulation_->events(); }
bool World::can(Ability ability) const { return simulation_->can(ability); }
EngineObjects World::engine_objects() const { return simulation_->engine_objects(); }
const Outputs& World::outputs() const { return simulation_->outputs(); }

Result<void> World::set_drive_target(scene::Index joint, scene::Index drive,
                                     const DriveTarget& target) {
  return simulation_->set_drive_target(joint, drive, target);
}
Result<void> World::set_joint_efforts(scene::Index joint, std::span<const double> efforts) {
  return simulation_->set_joint_efforts(joint, efforts);
}
Result<void> World::set_body_wrench(scene::Index body, const Wrench& wrench) {
  return simulation_->set_body_wrench(body, wrench);
}
Result<void> World::set_body_force_at(scene::Index body, const Vec3d& force, const Vec3d& point) {
  return simulation_->set_body_wrench(body,
                                      wrench_at(force, point, simulation_->center_of_mass(body)));
}
Result<void> World::move_kinematic(scene::Index body, const Pose& pose) {
  return simulation_->move_kinematic(body, pose);
}
Result<void> World::set_gravity(scene::Index scene, const Vec3d& gravity) {
  return simulation_->set_gravity(scene, gravity);
}
Result<void> World::set_parameter(const ParameterKey& key, double value) {
  return simulation_->set_parameter(key, value);
}
Result<void> World::set_joint_state(scene::Index joint, const JointState& state) {
  TENON_CHECK(simulation_->set_joint_state(joint, state));
  if (sensors_) {
    sensors_->look_again();
  }
  return {};
}
Result<void> World::set_body_state(scene::Index body, const BodyState& state) {
  TENON_CHECK(simulation_->set_body_state(body, state));
  if (sensors_) {
    sensors_->look_again();
  }
  return {};
}
Result<std::string> World::save_state() const { return simulation_->save_state(); }
Result<void> World::restore_state(std::string_view bytes) {
  TENON_CHECK(simulation_->restore_state(bytes));
  return sensors_ ? sensors_->restart() : Result<void>();
}

Result<std::vector<Contact>> World::contacts() const { return simulation_->contacts(); }
Result<std::vector<double>> World::drive_efforts(scene::Index joint) const {
  return simulation_->drive_efforts(joint);
}
Result<Wrench> World::joint_reaction(scene::Index joint) const {
  return simulation_->joint_reaction(joint);
}
Result<BodyAcceleration> World::body_acceleration(scene::Index body) const {
  return simulation_->body_acceleration(body);
}
Result<std::vector<double>> World::joint_acceleration(scene::Index joint) const {
  return simulation_->joint_acceleration(joint);
}
Result<Work> World::work() const { return simulation_->work(); }
Result<std::vector<SensorReading>> World::sensors() const {
  if (!sensors_) {
    return output_off("sensors");
  }
  return sensors_->readings();
}

}  // namespace tenon::engines
