// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One table says what sensors of each kind read. A series has an object for each sensor of the
// scene; those that read something else have no numbers in it.
#include "tenon/bake/sensor_series.h"

#include <string>
#include <utility>

#include "tenon/bake/drive_names.h"
#include "tenon/bake/stage_values.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

using engines::SensorReading;
using scene::PhysicsScene;
using scene::Sensor;
using scene::SensorKind;
using Numbers = std::vector<double>;
using Labels = std::vector<std::string>;

/// What one sensor reads, in the units of logs.
using Read = void (*)(const SensorReading& reading, const Sensor& sensor, const PhysicsScene& scene,
                      Numbers& values);
using LabelsOf = Labels (*)(const Sensor& sensor, const PhysicsScene& scene,
                            const engines::Simulation& simulation);

Labels one(const Sensor&, const PhysicsScene&, const engines::Simulation&) { return {""}; }
Labels three(const Sensor&, const PhysicsScene&, const engines::Simulation&) {
  return {".x", ".y", ".z"};
}
Labels four(const Sensor&, const PhysicsScene&, const engines::Simulation&) {
  return {".w", ".x", ".y", ".z"};
}
Labels rays(const Sensor& sensor, const PhysicsScene&, const engines::Simulation&) {
  const std::size_t count = sensor.ray_directions.size();
  Labels labels;
  for (std::size_t k = 0; k < count; ++k) {
    labels.push_back(part_label(k, count));
  }
  return labels;
}
Labels axes(const Sensor& sensor, const PhysicsScene&, const engines::Simulation& simulation) {
  const std::size_t count = simulation.joint_state(*sensor.joint).position.size();
  Labels labels;
  for (std::size_t k = 0; k < count; ++k) {
    labels.push_back(part_label(k, count));
  }
  return labels;
}
Labels drives(const Sensor& sensor, const PhysicsScene& scene, const engines::Simulation&) {
  const scene::Joint& joint = scene.joints[*sensor.joint];
  Labels labels;
  for (std::size_t k = 0; k < joint.drives.size(); ++k) {
    labels.push_back(drive_label(joint, k));
  }
  return labels;
}

struct SensorQuantity {
  SensorKind kind;
  const char* key;
  const char* array;
  LabelsOf labels;
  Read read;
};

void add_all(Numbers& values, const Numbers& more) {
  values.insert(values.end(), more.begin(), more.end());
}

constexpr SensorQuantity kQuantities[] = {
    {SensorKind::Contact, "inContact", "sensor_in_contact", one,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       values.push_back(r.in_contact ? 1 : 0);
     }},
    {SensorKind::Contact, "normalForce", "sensor_normal_force", one,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       values.push_back(r.normal_force);
     }},
    {SensorKind::Imu, "linearAcceleration", "sensor_linear_acceleration", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene& scene, Numbers& values) {
       append(values, r.linear_acceleration * (1 / scene.meters_per_unit));
     }},
    {SensorKind::Imu, "angularVelocity", "sensor_angular_velocity", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       append(values, r.angular_velocity * kDegreesPerRadian);
     }},
    {SensorKind::Imu, "orientation", "sensor_orientation", four,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       const Quatd& q = r.orientation;
       values.insert(values.end(), {q.w, q.x, q.y, q.z});
     }},
    {SensorKind::Frame, "framePosition", "sensor_frame_position", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene& scene, Numbers& values) {
       append(values, r.position * (1 / scene.meters_per_unit));
     }},
    {SensorKind::Frame, "frameOrientation", "sensor_frame_orientation", four,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       const Quatd& q = r.orientation;
       values.insert(values.end(), {q.w, q.x, q.y, q.z});
     }},
    {SensorKind::Frame, "frameLinearVelocity", "sensor_frame_linear_velocity", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene& scene, Numbers& values) {
       append(values, r.linear_velocity * (1 / scene.meters_per_unit));
     }},
    {SensorKind::Frame, "frameAngularVelocity", "sensor_frame_angular_velocity", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       append(values, r.angular_velocity * kDegreesPerRadian);
     }},
    {SensorKind::Rays, "distance", "sensor_distance", rays,
     [](const SensorReading& r, const Sensor&, const PhysicsScene& scene, Numbers& values) {
       for (const double distance : r.distances) {
         values.push_back(distance < 0 ? distance : distance / scene.meters_per_unit);
       }
     }},
    {SensorKind::ForceTorque, "force", "sensor_force", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       append(values, r.wrench.force);
     }},
    {SensorKind::ForceTorque, "torque", "sensor_torque", three,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       append(values, r.wrench.torque);
     }},
    {SensorKind::Joint, "sensorPosition", "sensor_position", axes,
     [](const SensorReading& r, const Sensor& s, const PhysicsScene& scene, Numbers& values) {
       add_all(values, in_stage_units(r.joint, scene.joints[*s.joint], scene).position);
     }},
    {SensorKind::Joint, "sensorVelocity", "sensor_velocity", axes,
     [](const SensorReading& r, const Sensor& s, const PhysicsScene& scene, Numbers& values) {
       add_all(values, in_stage_units(r.joint, scene.joints[*s.joint], scene).velocity);
     }},
    {SensorKind::Joint, "sensorEffort", "sensor_effort", drives,
     [](const SensorReading& r, const Sensor&, const PhysicsScene&, Numbers& values) {
       add_all(values, r.efforts);
     }},
};

bool reads(const Sensor& sensor, SensorKind kind) { return sensor.enabled && sensor.kind == kind; }

}  // namespace

std::vector<SensorSeries> sensor_series(const PhysicsScene& scene,
                                        const engines::Simulation& simulation) {
  std::vector<SensorSeries> all;
  for (const SensorQuantity& quantity : kQuantities) {
    SensorSeries one_series;
    OutputSeries& series = one_series.series;
    series.of = SeriesOf::Sensors;
    series.key = quantity.key;
    series.array = quantity.array;
    series.offsets = {0};
    for (const Sensor& sensor : scene.sensors) {
      if (reads(sensor, quantity.kind)) {
        const Labels labels = quantity.labels(sensor, scene, simulation);
        series.labels.insert(series.labels.end(), labels.begin(), labels.end());
      }
      series.offsets.push_back(series.width());
    }
    if (series.width() == 0) {
      continue;
    }
    one_series.read = [&scene, &quantity](const std::vector<SensorReading>& readings,
                                          Numbers& values) {
      for (std::size_t i = 0; i < scene.sensors.size(); ++i) {
        if (reads(scene.sensors[i], quantity.kind)) {
          quantity.read(readings[i], scene.sensors[i], scene, values);
        }
      }
    };
    all.push_back(std::move(one_series));
  }
  return all;
}

}  // namespace tenon::bake
