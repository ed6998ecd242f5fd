// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Contacts, reactions and accelerations of a step are those that act where bodies are at its
// beginning, so the states before it are kept until it is over. A sensor's origin moves with its
// body: a = a_c + w' x r + w x (w x r), where r leads from the centre of mass to it. Gravity is
// taken off, because an accelerometer feels what holds it, not what pulls all of it alike.
// A reaction is known about the origin of joint frame 1 and on body 1; its torque is moved to the
// sensor, and its sign turned where the sensor is on body 0.
// Measurements fall on multiples of the period; a reading stays until the next one.
#include "tenon/engines/sensors.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/simulation.h"
#include "tenon/scene/shapes/ray_hit.h"

namespace tenon::engines {
namespace {

using scene::Index;
using scene::Sensor;
using scene::SensorKind;

template <class T>
void keep_last(std::deque<T>& values, const T& value, int count) {
  values.push_back(value);
  while (values.size() > static_cast<std::size_t>(std::max(count, 1))) {
    values.pop_front();
  }
}

Vec3d mean(const std::deque<Vec3d>& values) {
  Vec3d sum;
  for (const Vec3d& value : values) {
    sum += value;
  }
  return sum * (1 / static_cast<double>(values.size()));
}

/// Of turns that lie close to each other; q and -q are one.
Quatd mean(const std::deque<Quatd>& values) {
  if (values.size() == 1) {
    return values.front();
  }
  Quatd sum{0, 0, 0, 0};
  for (const Quatd& q : values) {
    const double sign = dot(values.front(), q) < 0 ? -1 : 1;
    sum = {sum.x + sign * q.x, sum.y + sign * q.y, sum.z + sign * q.z, sum.w + sign * q.w};
  }
  return normalized(sum);
}

}  // namespace

Outputs with_needs_of_sensors(const Outputs& outputs, const scene::PhysicsScene& scene) {
  Outputs all = outputs;
  for (const Sensor& sensor : scene.sensors) {
    if (outputs.sensors && sensor.enabled) {
      all.contacts = all.contacts || sensor.kind == SensorKind::Contact;
      all.accelerations = all.accelerations || sensor.kind == SensorKind::Imu;
      all.reactions = all.reactions || sensor.kind == SensorKind::ForceTorque;
      all.efforts = all.efforts || sensor.kind == SensorKind::Joint;
    }
  }
  return all;
}

Sensors::Sensors(const scene::PhysicsScene& scene, const Simulation& simulation)
    : scene_(scene), simulation_(simulation), at_begin_(scene.bodies.size()) {
  for (const Sensor& sensor : scene.sensors) {
    if (sensor.body && sensor.enabled) {
      bodies_.push_back(*sensor.body);
    }
    if (sensor.kind == SensorKind::ForceTorque && scene.joints[*sensor.joint].body1) {
      bodies_.push_back(*scene.joints[*sensor.joint].body1);
    }
    if (sensor.kind == SensorKind::Contact && sensor.enabled) {
      touches_.resize(scene.bodies.size());
    }
  }
  const auto casts = [](const Sensor& s) { return s.kind == SensorKind::Rays && s.enabled; };
  if (std::any_of(scene.sensors.begin(), scene.sensors.end(), casts)) {
    for (const scene::Collider& collider : scene.colliders) {
      ball_radii_.push_back(scene::bounding_radius(collider.shape, scene.meshes));
    }
  }
  std::sort(bodies_.begin(), bodies_.end());
  bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
}

Result<void> Sensors::restart() {
  const std::size_t count = scene_.sensors.size();
  readings_.assign(count, {});
  histories_.assign(count, {});
  periods_done_.assign(count, -kInfinity);
  keep_states();
  return measure_all();
}

void Sensors::look_again() {
  keep_states();
  moved_ = true;
}

const std::vector<SensorReading>& Sensors::readings() {
  for (Index i = 0; moved_ && i < readings_.size(); ++i) {
    if (scene_.sensors[i].enabled && readings_[i].time == simulation_.time()) {
      measure_states(i);
    }
  }
  moved_ = false;
  return readings_;
}

void Sensors::measure_states(Index i) {
  const Sensor& sensor = scene_.sensors[i];
  if (sensor.kind == SensorKind::Frame) {
    measure_frame(sensor, readings_[i]);
  } else if (sensor.kind == SensorKind::Rays) {
    measure_rays(sensor, readings_[i]);
  } else if (sensor.kind == SensorKind::Imu) {
    measure_turn(sensor, histories_[i], readings_[i]);
  } else if (sensor.kind == SensorKind::Joint) {
    readings_[i].joint = simulation_.joint_state(*sensor.joint);
  }
}

void Sensors::keep_states() {
  for (const Index body : bodies_) {
    at_begin_[body] = simulation_.body_state(body);
  }
}

Result<void> Sensors::after_step() {
  TENON_CHECK(measure_all());
  keep_states();
  return {};
}

Result<void> Sensors::measure_all() {
  bool found_touches = false;
  moved_ = false;
  for (Index i = 0; i < scene_.sensors.size(); ++i) {
    const Sensor& sensor = scene_.sensors[i];
    if (!sensor.enabled || !is_due(i)) {
      continue;
    }
    if (sensor.kind == SensorKind::Contact && !found_touches) {
      TENON_CHECK(find_touches());
      found_touches = true;
    }
    TENON_CHECK(measure(i));
  }
  return {};
}

bool Sensors::is_due(Index sensor) {
  const double period = scene_.sensors[sensor].period;
  if (!(period > simulation_.time_step())) {
    return true;
  }
  const double done = std::floor(simulation_.time() / period + 1e-9);
  const bool is_due = done > periods_done_[sensor];
  periods_done_[sensor] = done;
  return is_due;
}

Result<void> Sensors::measure(Index i) {
  const Sensor& sensor = scene_.sensors[i];
  SensorReading& reading = readings_[i];
  reading.time = simulation_.time();
  switch (sensor.kind) {
    case SensorKind::Contact:
      measure_contact(sensor, reading);
      return {};
    case SensorKind::Imu:
      return measure_imu(sensor, histories_[i], reading);
    case SensorKind::ForceTorque:
      return measure_wrench(sensor, reading);
    case SensorKind::Frame:
      measure_frame(sensor, reading);
      return {};
    case SensorKind::Rays:
      measure_rays(sensor, reading);
      return {};
    case SensorKind::Joint:
      break;
  }
  return measure_joint(sensor, reading);
}

Result<void> Sensors::find_touches() {
  for (std::vector<Touch>& touches : touches_) {
    touches.clear();
  }
  TENON_TRY(const std::vector<Contact> contacts, simulation_.contacts());
  for (const Contact& contact : contacts) {
    for (const std::optional<Index>& body : {contact.body0, contact.body1}) {
      if (body && *body < touches_.size()) {
        touches_[*body].push_back({contact.point, contact.normal_force});
      }
    }
  }
  return {};
}

void Sensors::measure_contact(const Sensor& sensor, SensorReading& reading) const {
  const Vec3d origin = transform_point(at_begin_[*sensor.body].pose, sensor.pose.position);
  double force = 0;
  for (const Touch& touch : touches_[*sensor.body]) {
    force += length(touch.point - origin) <= sensor.radius ? touch.force : 0;
  }
  reading.in_contact = force > 0 && force >= sensor.min_force;
  reading.normal_force = reading.in_contact ? std::min(force, sensor.max_force) : 0;
}

Result<void> Sensors::measure_imu(const Sensor& sensor, History& history, SensorReading& reading) {
  const Index body = *sensor.body;
  TENON_TRY(const BodyAcceleration moved, simulation_.body_acceleration(body));
  const BodyState& begin = at_begin_[body];
  const BodyState now = simulation_.body_state(body);
  const Vec3d center = transform_point(inverse(now.pose), simulation_.center_of_mass(body));
  const Vec3d arm = rotate(begin.pose.orientation, sensor.pose.position - center);
  const Vec3d spin = begin.angular_velocity;
  const Vec3d acceleration = moved.linear + cross(moved.angular, arm) +
                             cross(spin, cross(spin, arm)) -
                             simulation_.gravity(scene_.bodies[body].scene);
  const Quatd at_begin = begin.pose.orientation * sensor.pose.orientation;
  keep_last(history.accelerations, rotate(conjugate(at_begin), acceleration),
            sensor.acceleration_width);
  keep_last(history.velocities, {}, sensor.velocity_width);
  keep_last(history.orientations, {}, sensor.orientation_width);
  reading.linear_acceleration = mean(history.accelerations);
  measure_turn(sensor, history, reading);
  return {};
}

// In place of the last of both.
void Sensors::measure_turn(const Sensor& sensor, History& history, SensorReading& reading) const {
  const BodyState now = simulation_.body_state(*sensor.body);
  history.orientations.back() = now.pose.orientation * sensor.pose.orientation;
  history.velocities.back() = rotate(conjugate(history.orientations.back()), now.angular_velocity);
  reading.angular_velocity = mean(history.velocities);
  reading.orientation = mean(history.orientations);
}

void Sensors::measure_frame(const Sensor& sensor, SensorReading& reading) const {
  const BodyState now = simulation_.body_state(*sensor.body);
  const Pose frame = now.pose * sensor.pose;
  const Vec3d arm = frame.position - simulation_.center_of_mass(*sensor.body);
  reading.position = frame.position;
  reading.orientation = frame.orientation;
  reading.linear_velocity = now.linear_velocity + cross(now.angular_velocity, arm);
  reading.angular_velocity = now.angular_velocity;
}

void Sensors::measure_rays(const Sensor& sensor, SensorReading& reading) const {
  const Pose frame = simulation_.body_state(*sensor.body).pose * sensor.pose;
  const std::size_t count = sensor.ray_directions.size();
  std::vector<Vec3d> origins;
  std::vector<Vec3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    origins.push_back(transform_point(frame, sensor.ray_origins[i]));
    directions.push_back(rotate(frame.orientation, sensor.ray_directions[i]));
  }
  reading.distances.assign(count, kInfinity);
  for (std::size_t c = 0; c < scene_.colliders.size(); ++c) {
    const scene::Collider& collider = scene_.colliders[c];
    if (!collider.enabled || collider.body == sensor.body || collider.settings.trigger) {
      continue;
    }
    const Pose place =
        collider.body ? simulation_.body_state(*collider.body).pose * collider.pose : collider.pose;
    const Pose to_collider = inverse(place);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d origin = transform_point(to_collider, origins[i]);
      const Vec3d direction = rotate(to_collider.orientation, directions[i]);
      const double passes = length(cross(origin, direction));  // how near to its origin
      if (passes <= ball_radii_[c] && length(origin) - ball_radii_[c] <= reading.distances[i]) {
        const double found = scene::ray_distance(collider.shape, scene_.meshes, origin, direction);
        reading.distances[i] = std::min(reading.distances[i], found);
      }
    }
  }
  for (double& distance : reading.distances) {
    distance =
        distance >= sensor.min_range && distance <= sensor.max_range && std::isfinite(distance)
            ? distance
            : -1;
  }
}

Result<void> Sensors::measure_wrench(const Sensor& sensor, SensorReading& reading) const {
  const scene::Joint& joint = scene_.joints[*sensor.joint];
  TENON_TRY(const Wrench reaction, simulation_.joint_reaction(*sensor.joint));
  const Pose side1 = joint.body1 ? at_begin_[*joint.body1].pose : Pose{};
  const Pose frame = at_begin_[*sensor.body].pose * sensor.pose;
  const Vec3d arm = transform_point(side1, joint.frame1.position) - frame.position;
  const double sign = joint.body1 == sensor.body ? 1 : -1;
  const Quatd to_sensor = conjugate(frame.orientation);
  reading.wrench.force = rotate(to_sensor, reaction.force * sign);
  reading.wrench.torque = rotate(to_sensor, (reaction.torque + cross(arm, reaction.force)) * sign);
  return {};
}

Result<void> Sensors::measure_joint(const Sensor& sensor, SensorReading& reading) const {
  reading.joint = simulation_.joint_state(*sensor.joint);
  TENON_TRY(reading.efforts, simulation_.drive_efforts(*sensor.joint));
  return {};
}

}  // namespace tenon::engines
