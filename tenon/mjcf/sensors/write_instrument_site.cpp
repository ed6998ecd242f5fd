// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/sensors/write_instrument_site.h"

#include <cmath>

#include "tenon/mjcf/write_elements.h"

namespace tenon::mjcf {

using scene::Sensor;
using scene::SensorKind;

Pose instrument_pose(const engines::mujoco::Model& model, const Sensor& sensor) {
  Pose pose = inverse(model.bodies[*sensor.body].engine_frame) * sensor.pose;
  if (sensor.kind == SensorKind::Rays && sensor.ray_directions.size() == 1) {
    const Vec3d up{{0, 0, 1}};
    const Vec3d ray = sensor.ray_directions[0];
    const Vec3d axis = cross(up, ray);
    const double angle = std::atan2(length(axis), dot(up, ray));
    pose = pose * Pose{sensor.ray_origins[0], rotation_about(normalized(axis, {{1, 0, 0}}), angle)};
  }
  return pose;
}

std::string instrument_site(const scene::PhysicsScene& scene, const engines::mujoco::Model& model,
                            mjSpec& spec, const Sensor& sensor) {
  std::string name = sensor.path.str();
  if (mjs_findElement(&spec, mjOBJ_SITE, name.c_str()) != nullptr) {
    return name;
  }
  const std::string body = scene.bodies[*sensor.body].path.str();
  mjsSite& made =
      named_site(spec, mjs_findBody(&spec, body.c_str()), name, instrument_pose(model, sensor));
  if (sensor.kind == SensorKind::Contact) {
    made.type = mjGEOM_SPHERE;
    made.size[0] = sensor.radius;
  }
  return name;
}

}  // namespace tenon::mjcf
