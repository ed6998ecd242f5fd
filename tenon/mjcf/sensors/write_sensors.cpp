// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each quantity that a sensor reads is a sensor of MuJoCo's, at a site that is named after the
// prim, so that a model has them where an asset has one instrument.
#include "tenon/mjcf/sensors/write_sensors.h"

#include <cmath>
#include <string>
#include <utility>

#include "tenon/mjcf/sensors/write_instrument_site.h"
#include "tenon/mjcf/write_actuators.h"
#include "tenon/mjcf/write_elements.h"

namespace tenon::mjcf {
namespace {

using scene::Sensor;
using scene::SensorKind;

class SensorWriter {
 public:
  SensorWriter(const scene::PhysicsScene& scene, const engines::mujoco::Model& model, mjSpec& spec,
               Diagnostics& diagnostics)
      : scene_(scene), model_(model), spec_(spec), diagnostics_(diagnostics) {}

  void write(const Sensor& sensor) {
    if (!sensor.enabled) {
      return leave_out(sensor, "the sensor is off");
    }
    if (sensor.period > 0) {
      leave_out(sensor, "the period of the sensor");
    }
    switch (sensor.kind) {
      case SensorKind::Contact:
        return write_touch(sensor);
      case SensorKind::Imu:
        return write_imu(sensor);
      case SensorKind::ForceTorque:
        add(mjSENS_FORCE, sensor, ".force", mjOBJ_SITE, site(sensor));
        add(mjSENS_TORQUE, sensor, ".torque", mjOBJ_SITE, site(sensor));
        return;
      case SensorKind::Frame:
        add(mjSENS_FRAMEPOS, sensor, ".position", mjOBJ_SITE, site(sensor));
        add(mjSENS_FRAMEQUAT, sensor, ".orientation", mjOBJ_SITE, site(sensor));
        add(mjSENS_FRAMELINVEL, sensor, ".velocity", mjOBJ_SITE, site(sensor));
        add(mjSENS_FRAMEANGVEL, sensor, ".angularVelocity", mjOBJ_SITE, site(sensor));
        return;
      case SensorKind::Rays:
        return write_ray(sensor);
      case SensorKind::Joint:
        return write_joint(sensor);
    }
  }

 private:
  void leave_out(const Sensor& sensor, const std::string& what) {
    report_left_out(diagnostics_, sensor.path, "", what + "; it is skipped");
  }

  mjsSensor* add(mjtSensor type, const Sensor& sensor, const char* suffix, mjtObj kind,
                 const std::string& object) {
    mjsSensor* made = mjs_addSensor(&spec_);
    made->type = type;
    made->objtype = kind;
    mjs_setString(made->objname, object.c_str());
    mjs_setName(made->element, (sensor.path.str() + suffix).c_str());
    return made;
  }

  std::string site(const Sensor& sensor) { return instrument_site(scene_, model_, spec_, sensor); }

  /// A site whose z is the ray.
  void write_ray(const Sensor& sensor) {
    if (sensor.ray_directions.size() != 1) {
      return leave_out(sensor, "MuJoCo's range finders have one ray, this sensor has " +
                                   std::to_string(sensor.ray_directions.size()));
    }
    mjsSensor* made = add(mjSENS_RANGEFINDER, sensor, ".range", mjOBJ_SITE, site(sensor));
    made->intprm[0] = 1 << mjRAYDATA_DIST;
    if (sensor.min_range > 0 || std::isfinite(sensor.max_range)) {
      leave_out(sensor, "the ranges of the sensor");
    }
  }

  void write_touch(const Sensor& sensor) {
    if (!std::isfinite(sensor.radius)) {
      return leave_out(sensor, "MuJoCo's touch sensors have a volume, this one is of a whole body");
    }
    add(mjSENS_TOUCH, sensor, ".touch", mjOBJ_SITE, site(sensor));
    if (sensor.min_force > 0 || std::isfinite(sensor.max_force)) {
      leave_out(sensor, "the threshold of the sensor");
    }
  }

  void write_imu(const Sensor& sensor) {
    add(mjSENS_ACCELEROMETER, sensor, ".acceleration", mjOBJ_SITE, site(sensor));
    add(mjSENS_GYRO, sensor, ".gyro", mjOBJ_SITE, site(sensor));
    add(mjSENS_FRAMEQUAT, sensor, ".orientation", mjOBJ_SITE, site(sensor));
    if (sensor.acceleration_width > 1 || sensor.velocity_width > 1 ||
        sensor.orientation_width > 1) {
      leave_out(sensor, "the mean that the sensor takes");
    }
  }

  void write_joint(const Sensor& sensor) {
    const scene::Joint& joint = scene_.joints[*sensor.joint];
    const bool reversed = model_.joints[*sensor.joint].reversed;
    const std::string name = reversed ? std::string() : joint_element(spec_, joint);
    if (!name.empty() && joint.kind == scene::JointKind::Spherical) {
      add(mjSENS_BALLQUAT, sensor, ".position", mjOBJ_JOINT, name);
      add(mjSENS_BALLANGVEL, sensor, ".velocity", mjOBJ_JOINT, name);
      return;
    }
    if (name.empty()) {
      return leave_out(sensor,
                       "the joint is neither of one axis nor a ball, or runs from child to parent");
    }
    add(mjSENS_JOINTPOS, sensor, ".position", mjOBJ_JOINT, name);
    add(mjSENS_JOINTVEL, sensor, ".velocity", mjOBJ_JOINT, name);
    if (!joint.drives.empty()) {
      add(mjSENS_JOINTACTFRC, sensor, ".effort", mjOBJ_JOINT, name);
    }
  }

  const scene::PhysicsScene& scene_;
  const engines::mujoco::Model& model_;
  mjSpec& spec_;
  Diagnostics& diagnostics_;
};

}  // namespace

void write_sensors(const scene::PhysicsScene& scene, const std::set<Path>& written,
                   const engines::mujoco::Model& model, mjSpec& spec, Diagnostics& diagnostics) {
  SensorWriter writer(scene, model, spec, diagnostics);
  for (const Sensor& sensor : scene.sensors) {
    if (!written.contains(sensor.path)) {
      writer.write(sensor);
    }
  }
}

}  // namespace tenon::mjcf
