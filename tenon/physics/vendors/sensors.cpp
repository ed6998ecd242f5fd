// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sensors are the prims of Isaac's sensor schema that measure bodies, and prims that name their
// kind in tenon:sensor: no published schema defines force-torque sensors and those of joints. A
// sensor belongs to the nearest enabled body at or above its prim and keeps its place in it. One
// that has nothing to measure is skipped with a finding. Light and radar are not simulated, and are
// listed under what is not read.
#include <algorithm>
#include <cmath>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/world_pose.h"
#include "tenon/scene/joint_forest.h"

namespace tenon::physics {
namespace {

struct SensorTokens {
  Token enabled{"enabled"};
  Token period{"sensorPeriod"};
  Token radius{"radius"};
  Token threshold{"threshold"};
  Token acceleration_width{"linearAccelerationFilterWidth"};
  Token velocity_width{"angularVelocityFilterWidth"};
  Token orientation_width{"orientationFilterWidth"};
  Token max_range{"maxRange"};
  Token min_range{"minRange"};
  Token ray_count{"numRays"};
  Token ray_directions{"rayDirections"};
  Token ray_origins{"rayOrigins"};
};

bool is_typed_sensor(PrimKind kind) {
  return kind >= PrimKind::ContactSensor && kind <= PrimKind::RaycastSensor;
}

class SensorReader {
 public:
  explicit SensorReader(ReadState& state) : state_(state) {}

  void run() {
    for (const PhysicsPrim& found : state_.walk.prims) {
      if (is_typed_sensor(found.roles.kind)) {
        read_typed(found);
      } else if (found.roles.kind == PrimKind::MujocoSensor) {
        note_kept(found.prim);
      } else if (found.roles.marked_sensor) {
        read_marked(found);
      }
    }
    for (const stage::Prim& prim : state_.walk.vendor_prims) {
      note_rays(prim);
    }
    find_holding_joints();
    std::vector<Sensor>& sensors = state_.scene.sensors;
    std::stable_sort(sensors.begin(), sensors.end(),
                     [](const Sensor& a, const Sensor& b) { return a.path < b.path; });
  }

 private:
  void refuse(const PhysicsPrim& found, const char* rule, const Message& message, std::string fix) {
    state_.report(found.prim, Severity::Warning, rule, message + "; it reads nothing",
                  std::move(fix));
  }

  /// A number of the asset's that cannot be used.
  void refuse_setting(const PhysicsPrim& found, Token name, const std::string& what) {
    state_.report(found.prim, name, Severity::Warning, "sensor.setting", name.str() + " " + what,
                  "author a value that can be used, or none");
  }

  void read_typed(const PhysicsPrim& found) {
    const bool contact = found.roles.kind == PrimKind::ContactSensor;
    if (found.roles.marked_sensor) {
      refuse_setting(found, state_.tokens.sensor,
                     "is ignored: the prim's type defines its quantity");
    }
    const bool rays = found.roles.kind == PrimKind::RaycastSensor;
    Sensor sensor;
    sensor.kind = contact ? SensorKind::Contact : rays ? SensorKind::Rays : SensorKind::Imu;
    if (!place(found, sensor) || (rays && !read_rays(found, sensor))) {
      return;
    }
    sensor.enabled = state_.values.flag(found.prim, tokens_.enabled, true);
    sensor.period = std::max(0.0, number(found, tokens_.period, 0));
    if (contact) {
      read_contact(found, sensor);
    } else if (!rays) {
      sensor.acceleration_width = width(found, tokens_.acceleration_width);
      sensor.velocity_width = width(found, tokens_.velocity_width);
      sensor.orientation_width = width(found, tokens_.orientation_width);
    }
    state_.scene.sensors.push_back(sensor);
  }

  double number(const PhysicsPrim& found, Token name, double fallback) {
    const double value = state_.values.authored_number(found.prim, name).value_or(fallback);
    if (std::isfinite(value)) {
      return value;
    }
    refuse_setting(found, name, "is not finite; " + shortest(fallback) + " counts");
    return fallback;
  }

  int width(const PhysicsPrim& found, Token name) {
    const double value = number(found, name, 1);
    const auto most = static_cast<double>(limits::kSensorWidth);
    const double usable = std::clamp(std::floor(value), 1.0, most);
    if (usable != value) {
      refuse_setting(found, name, "is " + shortest(value) + "; " + shortest(usable) + " counts");
    }
    return static_cast<int>(usable);
  }

  void read_contact(const PhysicsPrim& found, Sensor& sensor) {
    const double radius = number(found, tokens_.radius, -1);
    if (radius > 0) {
      sensor.radius = radius * state_.units.length;
    }
    const std::optional<Vec2f> bounds = state_.values.get<Vec2f>(found.prim, tokens_.threshold);
    if (!bounds) {
      return;
    }
    const double least = static_cast<double>((*bounds)[0]);
    const double most = unlimited_or(static_cast<double>((*bounds)[1]));
    if (!std::isfinite(least) || least < 0 || !(most >= least)) {
      refuse_setting(found, tokens_.threshold,
                     "is not a range of forces that begins at 0 or above; all forces count");
      return;
    }
    sensor.min_force = least * state_.units.force();
    sensor.max_force = most * state_.units.force();
  }

  /// Those that have a direction; false with a finding where none has.
  bool read_rays(const PhysicsPrim& found, Sensor& sensor) {
    using Vectors = layer::Array<Vec3f>;
    const Vectors directions =
        state_.values.get<Vectors>(found.prim, tokens_.ray_directions).value_or(Vectors());
    const Vectors origins =
        state_.values.get<Vectors>(found.prim, tokens_.ray_origins).value_or(Vectors());
    const auto said = static_cast<double>(directions.size());
    const double most = state_.values.authored_number(found.prim, tokens_.ray_count).value_or(said);
    const auto count = static_cast<std::size_t>(most > 0 ? std::min(most, said) : 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d direction = normalized(to_double(directions[i]));
      const Vec3d origin = i < origins.size() ? to_double(origins[i]) : Vec3d{};
      if (dot(direction, direction) > 0 && is_finite(origin)) {
        sensor.ray_directions.push_back(direction);
        sensor.ray_origins.push_back(origin * state_.units.length);
      }
    }
    if (sensor.ray_directions.empty()) {
      refuse(found, "sensor.setting", "no ray of the sensor has a direction",
             "author rayDirections");
      return false;
    }
    if (sensor.ray_directions.size() < count) {
      refuse_setting(found, tokens_.ray_directions,
                     "has rays without a direction or a finite origin; the others count");
    }
    sensor.min_range = std::max(0.0, number(found, tokens_.min_range, 0)) * state_.units.length;
    const double farthest =
        unlimited_or(state_.values.authored_number(found.prim, tokens_.max_range).value_or(-1));
    sensor.max_range = farthest > 0 ? farthest * state_.units.length : kInfinity;
    return true;
  }

  void read_marked(const PhysicsPrim& found) {
    const Token kind = state_.values.get<Token>(found.prim, state_.tokens.sensor).value_or(Token());
    if (kind == "joint") {
      read_joint(found);
    } else if (kind == "forceTorque") {
      read_placed(found, SensorKind::ForceTorque, "force-torque sensor");
    } else if (kind == "frame") {
      read_placed(found, SensorKind::Frame, "sensor of a frame");
    } else if (!kind.empty()) {
      state_.report(found.prim, state_.tokens.sensor, Severity::Warning, "sensor.setting",
                    "there is no sensor \"" + kind.str() + "\"; it reads nothing",
                    "write \"forceTorque\", \"frame\" or \"joint\"");
    }
  }

  void read_joint(const PhysicsPrim& found) {
    const std::uint32_t joint = state_.joint_at(found.path);
    if (joint == kNone) {
      refuse(found, "sensor.no-joint", "the sensor of a joint is on no joint that is simulated",
             "author it on a joint that holds bodies");
      return;
    }
    Sensor sensor;
    sensor.path = found.path;
    sensor.kind = SensorKind::Joint;
    sensor.joint = joint;
    state_.scene.sensors.push_back(sensor);
  }

  void read_placed(const PhysicsPrim& found, SensorKind kind, const char* what) {
    Sensor sensor;
    sensor.kind = kind;
    if (!found.roles.xformable) {
      refuse(found, "sensor.no-body",
             std::string("the ") + what + " has no transform, so it has no frame",
             "author it on an Xform below the body that it is fixed to");
    } else if (place(found, sensor)) {
      state_.scene.sensors.push_back(sensor);
    }
  }

  /// Body and frame; false with a finding where there is none.
  bool place(const PhysicsPrim& found, Sensor& sensor) {
    const std::uint32_t body = found.body == kNone ? kNone : state_.body_of_prim[found.body];
    if (body == kNone) {
      refuse(found, "sensor.no-body", no_body(found.prim),
             "put it below the rigid body that it is fixed to, and let the body be enabled");
      return false;
    }
    const Pose world = world_pose(found.world, state_.units);
    if (!is_finite(world) || !state_.has_place(body)) {
      refuse(found, "sensor.no-body", "the sensor's transform is not made of finite numbers",
             "author a finite transform");
      return false;
    }
    sensor.path = found.path;
    sensor.body = body;
    sensor.pose = inverse(state_.scene.bodies[body].pose) * world;
    note_motion(found, state_.prim_of_body(body).prim);
    return true;
  }

  static Message no_body(const stage::Prim& sensor) {
    for (stage::Prim prim = sensor; prim.is_valid() && !prim.is_pseudo_root();
         prim = prim.parent()) {
      if (prim.has_api("PhysicsRigidBodyAPI")) {
        return "the body " + named(prim.path(), RelatedRole::Body) + " of the sensor is disabled";
      }
    }
    return "no rigid body is at or above the sensor";
  }

  /// Its place in the body is that of the start.
  void note_motion(const PhysicsPrim& found, const stage::Prim& body) {
    if (!state_.values.stage_is_animated()) {
      return;
    }
    for (stage::Prim prim = found.prim; prim.is_valid() && !(prim.path() == body.path());
         prim = prim.parent()) {
      for (const Token name : prim.authored_property_names()) {
        if (name.view().starts_with("xformOp:") && prim.attribute(name).is_animated()) {
          state_.not_read(found.prim, name.str(),
                          "the time samples of <" + prim.path().str() +
                              "> are not followed: the sensor keeps its place in the body");
        }
      }
    }
  }

  /// The joint between the body of each force-torque sensor and what carries it.
  void find_holding_joints() {
    std::vector<Sensor>& sensors = state_.scene.sensors;
    const auto is_one = [](const Sensor& s) { return s.kind == SensorKind::ForceTorque; };
    if (std::none_of(sensors.begin(), sensors.end(), is_one)) {
      return;
    }
    const scene::JointForest forest = scene::joint_forest(state_.scene);
    std::erase_if(sensors, [&](Sensor& sensor) {
      if (!is_one(sensor)) {
        return false;
      }
      sensor.joint = forest.bodies[*sensor.body].joint;
      if (!sensor.joint) {
        refuse(*state_.walk.find(sensor.path), "sensor.no-joint",
               "no joint holds the body " +
                   named(state_.scene.bodies[*sensor.body].path, RelatedRole::Body) +
                   " of the force-torque sensor",
               "put the sensor below a body that a joint holds to another one or to the world");
      }
      return !sensor.joint;
    });
  }

  /// A sensor of MuJoCo's that has no instrument.
  void note_kept(const stage::Prim& prim) {
    if (prim.relationship("tenon:mujoco:sensor:instrument").targets().empty()) {
      state_.not_read(prim, prim.type_name().str(), "it is a sensor of models of MuJoCo alone");
    }
  }

  void note_rays(const stage::Prim& prim) {
    const Token type = prim.type_name();
    if (prim.is_a("IsaacBaseSensor") && type != "IsaacContactSensor" && type != "IsaacImuSensor" &&
        type != "IsaacRaycastSensor") {
      state_.not_read(prim, type.str(), "beams of light are not simulated");
    }
    for (const char* api : {"IsaacRtxLidarSensorAPI", "IsaacRtxRadarSensorAPI"}) {
      if (prim.has_api(api)) {
        state_.not_read(prim, api, "light and radar are not simulated");
      }
    }
  }

  ReadState& state_;
  SensorTokens tokens_;
};

}  // namespace

void read_sensors(ReadState& state) { SensorReader(state).run(); }

}  // namespace tenon::physics
