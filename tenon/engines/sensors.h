// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/physics_scene.h"

/// The readings of a scene's sensors, computed from what every engine gives, so that no engine
/// needs to know sensors.
namespace tenon::engines {

class Simulation;

/// The outputs that were asked for and, where sensors are among them, those that sensors are worked
/// out from.
Outputs with_needs_of_sensors(const Outputs& outputs, const scene::PhysicsScene& scene);

/// The sensors of one simulation. Both, and the scene, must outlive it and stay where they are. The
/// simulation was made with what with_needs_of_sensors() says. Errors of what measures: those of
/// the simulation's outputs.
class Sensors {
 public:
  Sensors(const scene::PhysicsScene& scene, const Simulation& simulation);

  /// Starts again without the former measurements: at the start, and where the simulation was reset
  /// or restored.
  Result<void> restart();
  /// Bodies were put elsewhere between two steps: what was measured at this time and is of states
  /// is measured again; forces and accelerations stay those of the step.
  void look_again();
  /// After each step.
  Result<void> after_step();

  /// (sensor_count); of one that is not enabled all is zero.
  const std::vector<SensorReading>& readings();

 private:
  /// The last measurements of an IMU.
  struct History {
    std::deque<Vec3d> accelerations;
    std::deque<Vec3d> velocities;
    std::deque<Quatd> orientations;
  };
  struct Touch {
    Vec3d point;
    double force = 0;
  };

  Result<void> measure_all();
  Result<void> measure(scene::Index sensor);
  Result<void> find_touches();
  void measure_contact(const scene::Sensor& sensor, SensorReading& reading) const;
  Result<void> measure_imu(const scene::Sensor& sensor, History& history, SensorReading& reading);
  void measure_states(scene::Index sensor);
  void measure_turn(const scene::Sensor& sensor, History& history, SensorReading& reading) const;
  void keep_states();
  void measure_frame(const scene::Sensor& sensor, SensorReading& reading) const;
  void measure_rays(const scene::Sensor& sensor, SensorReading& reading) const;
  Result<void> measure_wrench(const scene::Sensor& sensor, SensorReading& reading) const;
  Result<void> measure_joint(const scene::Sensor& sensor, SensorReading& reading) const;
  bool is_due(scene::Index sensor);

  const scene::PhysicsScene& scene_;
  const Simulation& simulation_;
  std::vector<SensorReading> readings_;
  std::vector<History> histories_;
  std::vector<double> periods_done_;  ///< (sensor_count), counted from time 0
  std::vector<scene::Index> bodies_;  ///< whose states are looked at
  std::vector<BodyState> at_begin_;   ///< (body_count), of these, at the beginning of the step
  bool moved_ = false;                ///< since the last measurement, other than by a step
  std::vector<double> ball_radii_;    ///< (collider_count), about their origins, where rays are
  std::vector<std::vector<Touch>> touches_;  ///< (body_count), of bodies with contact sensors
};

}  // namespace tenon::engines
