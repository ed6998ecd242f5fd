// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Tracks are read first, since they may change the gains that are scaled after them. Scaling and
// damping use inertias and velocities from before the step; damping is capped where it stops a body
// within one step, so that a large rate cannot reverse the motion. A driven body is pushed to its
// next pose by force, so that contacts feel it, and is then set to that pose exactly, so that
// errors do not add up.
#include "tenon/engines/mujoco/run/step_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tenon/engines/mujoco/run/body_forces.h"

namespace tenon::engines::mujoco {

StepInputs::StepInputs(const scene::PhysicsScene& scene, Model& model)
    : unit_(static_cast<std::size_t>(model.model->nv), 0), response_(unit_) {
  collect_drives(scene, model);
  collect_tracks(scene, model);
  collect_pushed_bodies(scene, model);
  start_driven_bodies(model);
  empty_ = has_none();
}

bool StepInputs::has_none() const {
  return tracked_drives_.empty() && driven_bodies_.empty() && moved_colliders_.empty() &&
         pushed_bodies_.empty() && acceleration_drives_.empty() && bounded_drives_.empty();
}

void StepInputs::write(Model& model) {
  follow_drive_tracks(model);
  scale_acceleration_drives(model);
  move_colliders(model);
  bound_efforts(model);
  push_bodies(model);
  push_driven_bodies(model);
}

void StepInputs::take_constant_forces(const Model& model) {
  for (PushedBody& pushed : pushed_bodies_) {
    const double* force = model.data->xfrc_applied + std::ptrdiff_t{6} * pushed.map.id;
    pushed.constant_force = read_vector(force);
    pushed.constant_torque = read_vector(force + 3);
  }
}

void StepInputs::collect_drives(const scene::PhysicsScene& scene, const Model& model) {
  for (std::size_t i = 0; i < model.drives.size(); ++i) {
    const DriveMap& map = model.drives[i];
    drives_.push_back(scene.joints[map.joint].drives[map.drive]);
    if (map.actuator >= 0 && drives_.back().acceleration) {
      acceleration_drives_.push_back(i);
    }
    const scene::DriveEnvelope& envelope = drives_.back().envelope;
    if (map.actuator >= 0 &&
        (envelope.max_velocity < scene::kUnlimited || envelope.velocity_resistance > 0)) {
      bounded_drives_.push_back(i);
    }
  }
}

void StepInputs::collect_tracks(const scene::PhysicsScene& scene, const Model& model) {
  for (const scene::ScalarTrack& track : scene.scalar_tracks) {
    for (std::size_t i = 0; i < model.drives.size(); ++i) {
      const DriveMap& map = model.drives[i];
      if (map.joint == track.joint && map.drive == track.drive && map.actuator >= 0 &&
          !track.times.empty()) {
        tracked_drives_.push_back({&track, i});
      }
    }
  }
  for (const scene::PoseTrack& track : scene.pose_tracks) {
    if (track.times.empty()) {
      continue;
    }
    if (track.body.has_value() && model.plan.bases[*track.body] == BodyBase::Driven) {
      DrivenBody driven;
      driven.track = &track;
      driven.index = *track.body;
      driven.body = model.bodies[*track.body];
      driven_bodies_.push_back(driven);
    } else if (track.collider.has_value() && model.mocap_of_collider[*track.collider] >= 0) {
      moved_colliders_.push_back({&track, model.mocap_of_collider[*track.collider]});
    }
  }
}

void StepInputs::collect_pushed_bodies(const scene::PhysicsScene& scene, const Model& model) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    const BodyBase base = model.plan.bases[b];
    PushedBody pushed{&body, model.bodies[b], 0, 0, {}, {}};
    if (base == BodyBase::Jointed) {
      pushed.linear = body.linear_damping;
    }
    if (base == BodyBase::Jointed || body.settings.locked_rotation != 0) {
      pushed.angular = body.angular_damping;
    }
    const bool pushes = pushed.linear > 0 || pushed.angular > 0 || !body.settings.forces.empty() ||
                        !body.settings.gyroscopic;
    if (pushes && !body.kinematic && (base == BodyBase::Jointed || base == BodyBase::Free)) {
      pushed_bodies_.push_back(pushed);
    }
  }
  take_constant_forces(model);
}

void StepInputs::follow_drive_tracks(Model& model) {
  const double now = model.data->time;
  for (const TrackedDrive& tracked : tracked_drives_) {
    if (!tracked.overruled) {
      write_gain(tracked.drive, tracked.track->what, tracked.track->at(now), model);
    }
  }
}

void StepInputs::write_gain(std::size_t at, scene::Animated what, double value, Model& model) {
  const DriveMap& map = model.drives[at];
  scene::Drive& drive = drives_[at];
  switch (what) {
    case scene::Animated::DriveTargetPosition:
      model.data->ctrl[map.control] = value;
      break;
    case scene::Animated::DriveTargetVelocity:
      model.data->ctrl[map.control + 1] = value;
      break;
    case scene::Animated::DriveStiffness:
      drive.stiffness = value;
      own_model(model).actuator_biasprm[mjNBIAS * map.actuator + 1] = -value;
      break;
    case scene::Animated::DriveDamping:
      drive.damping = value;
      own_model(model).actuator_biasprm[mjNBIAS * map.actuator + 2] = -value;
      break;
    case scene::Animated::DriveMaxForce: {
      mjModel& m = own_model(model);
      m.actuator_forcelimited[map.actuator] = value < scene::kUnlimited ? 1 : 0;
      m.actuator_forcerange[std::ptrdiff_t{2} * map.actuator] = -value;
      m.actuator_forcerange[2 * map.actuator + 1] = value;
      break;
    }
  }
}

void StepInputs::overrule(std::size_t drive, scene::Animated what) {
  for (TrackedDrive& tracked : tracked_drives_) {
    if (tracked.drive == drive && tracked.track->what == what) {
      tracked.overruled = true;
    }
  }
}

void StepInputs::set_target(std::size_t drive, const DriveTarget& target, Model& model) {
  overrule(drive, scene::Animated::DriveTargetPosition);
  overrule(drive, scene::Animated::DriveTargetVelocity);
  write_gain(drive, scene::Animated::DriveTargetPosition, target.position, model);
  write_gain(drive, scene::Animated::DriveTargetVelocity, target.velocity, model);
}

void StepInputs::set_gain(std::size_t drive, Parameter what, double value, Model& model) {
  const scene::Animated number = what == Parameter::DriveStiffness ? scene::Animated::DriveStiffness
                                 : what == Parameter::DriveDamping ? scene::Animated::DriveDamping
                                                                   : scene::Animated::DriveMaxForce;
  overrule(drive, number);
  write_gain(drive, number, value, model);
}

bool StepInputs::set_pose(scene::Index body, const Pose& pose) {
  for (DrivenBody& driven : driven_bodies_) {
    if (driven.index == body) {
      driven.wanted = pose;
      return true;
    }
  }
  return false;
}

// Effective inertia of a coordinate: what a unit force on it meets, 1 / (e M^-1 e). M is factored
// in every step; here that of the pose one step ago is used.
void StepInputs::scale_acceleration_drives(Model& model) {
  if (acceleration_drives_.empty()) {
    return;
  }
  mjModel* m = &own_model(model);
  mjData* d = model.data.get();
  for (const std::size_t i : acceleration_drives_) {
    const DriveMap& map = model.drives[i];
    const auto dof = static_cast<std::size_t>(map.dof);
    unit_[dof] = 1;
    mj_solveM(m, d, response_.data(), unit_.data(), 1);
    unit_[dof] = 0;
    const double inertia = 1 / response_[dof];
    m->actuator_biasprm[mjNBIAS * map.actuator + 1] = -drives_[i].stiffness * inertia;
    m->actuator_biasprm[mjNBIAS * map.actuator + 2] = -drives_[i].damping * inertia;
  }
}

void StepInputs::move_colliders(Model& model) const {
  mjData* d = model.data.get();
  for (const MovedCollider& moved : moved_colliders_) {
    const Pose pose = moved.track->at(d->time);
    write_vector(d->mocap_pos + std::ptrdiff_t{3} * moved.mocap, pose.position);
    write_quaternion(d->mocap_quat + std::ptrdiff_t{4} * moved.mocap, normalized(pose.orientation));
  }
}

// What a drive can exert at the speed that it has.
void StepInputs::bound_efforts(Model& model) const {
  if (bounded_drives_.empty()) {
    return;
  }
  mjModel& m = own_model(model);
  for (const std::size_t i : bounded_drives_) {
    const scene::DriveEnvelope& envelope = drives_[i].envelope;
    const DriveMap& map = model.drives[i];
    const double speed = std::fabs(model.data->qvel[map.dof]);
    double most = drives_[i].max_force - envelope.velocity_resistance * speed;
    if (speed >= envelope.max_velocity) {
      most = 0;
    } else if (envelope.speed_effort_gradient > 0) {
      most = std::min(most, (envelope.max_velocity - speed) / envelope.speed_effort_gradient);
    }
    most = std::max(most, 0.0);
    m.actuator_forcelimited[map.actuator] = most < scene::kUnlimited ? 1 : 0;
    m.actuator_forcerange[std::ptrdiff_t{2} * map.actuator] = -most;
    m.actuator_forcerange[2 * map.actuator + 1] = most;
  }
}

// F = -m c v and T = -I c w at the centre of mass; a rate above 1 / dt stops within one step. What
// turns without gyroscopic torque gets that torque, w x I w, back.
void StepInputs::push_bodies(Model& model) const {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const double most = 1 / m->opt.timestep;
  for (const PushedBody& pushed : pushed_bodies_) {
    const int id = pushed.map.id;
    double velocity[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, id, velocity, 1);
    const Quatd principal = read_quaternion(d->xiquat + std::ptrdiff_t{4} * id);
    const Vec3d spin = read_vector(velocity);
    const Vec3d inertia = read_vector(m->body_inertia + std::ptrdiff_t{3} * id);
    Vec3d force = read_vector(velocity + 3) * (-m->body_mass[id] * std::min(pushed.linear, most));
    Vec3d torque;
    Vec3d momentum;
    for (std::size_t i = 0; i < 3; ++i) {
      momentum[i] = inertia[i] * spin[i];
      torque[i] = -momentum[i] * std::min(pushed.angular, most);
    }
    if (!pushed.body->settings.gyroscopic) {
      torque += cross(spin, momentum);
    }
    const Wrench own = body_forces(*pushed.body, pushed.map, *d);
    force = rotate(principal, force) + pushed.constant_force + own.force;
    write_vector(d->xfrc_applied + std::ptrdiff_t{6} * id, force);
    torque = rotate(principal, torque) + pushed.constant_torque + own.torque;
    write_vector(d->xfrc_applied + std::ptrdiff_t{6} * id + 3, torque);
  }
}

// The force that brings a driven body's velocity to (next pose - pose) / dt within this step; the
// inertia of what hangs on it is a millionth of its own.
void StepInputs::push_driven_bodies(Model& model) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const double dt = m->opt.timestep;
  for (DrivenBody& driven : driven_bodies_) {
    const BodyMap& body = driven.body;
    const Vec3d position = read_vector(d->qpos + body.free_qpos);
    const Quatd orientation = read_quaternion(d->qpos + body.free_qpos + 3);
    driven.next = driven.wanted.has_value() ? *driven.wanted : driven.track->at(d->time + dt);
    driven.next.orientation = normalized(driven.next.orientation);
    driven.linear_velocity = (driven.next.position - position) * (1 / dt);
    driven.angular_velocity =
        rotation_vector(conjugate(orientation) * driven.next.orientation) * (1 / dt);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<int>(i);
      const int dof = body.free_dof + axis;
      d->qfrc_applied[dof] =
          m->body_mass[body.id] * (driven.linear_velocity[i] - d->qvel[dof]) / dt;
      d->qfrc_applied[dof + 3] = m->body_inertia[3 * body.id + axis] *
                                 (driven.angular_velocity[i] - d->qvel[dof + 3]) / dt;
    }
  }
}

void StepInputs::after_step(Model& model) const {
  mjData* d = model.data.get();
  for (const DrivenBody& driven : driven_bodies_) {
    write_vector(d->qpos + driven.body.free_qpos, driven.next.position);
    write_quaternion(d->qpos + driven.body.free_qpos + 3, driven.next.orientation);
    write_vector(d->qvel + driven.body.free_dof, driven.linear_velocity);
    write_vector(d->qvel + driven.body.free_dof + 3, driven.angular_velocity);
  }
}

void StepInputs::start_driven_bodies(Model& model) {
  if (driven_bodies_.empty()) {
    return;
  }
  mjData* d = model.data.get();
  for (DrivenBody& driven : driven_bodies_) {
    const Pose start = driven.track->at(d->time);
    write_vector(d->qpos + driven.body.free_qpos, start.position);
    write_quaternion(d->qpos + driven.body.free_qpos + 3, normalized(start.orientation));
  }
  push_driven_bodies(model);
  for (const DrivenBody& driven : driven_bodies_) {
    write_vector(d->qvel + driven.body.free_dof, driven.linear_velocity);
    write_vector(d->qvel + driven.body.free_dof + 3, driven.angular_velocity);
  }
}

}  // namespace tenon::engines::mujoco
