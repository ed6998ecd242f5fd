// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/mujoco_simulation.h"

// What changes from step to step by the asset's own time samples, and forces that MuJoCo does not
// know: acceleration drives and the damping of bodies on joints.
namespace tenon::engines::mujoco {

void MujocoSimulation::collect_tracks() {
  for (const physics::ScalarTrack& track : scene_->scalar_tracks) {
    for (const DriveMap& map : model_.drives) {
      if (map.joint == track.joint && map.drive == track.drive && map.actuator >= 0 &&
          !track.times.empty()) {
        tracked_drives_.push_back({&track, &map});
      }
    }
  }
  for (const physics::PoseTrack& track : scene_->pose_tracks) {
    if (track.times.empty()) {
      continue;
    }
    if (track.body.has_value() && model_.plan.bodies[*track.body].base == BodyBase::Driven) {
      DrivenBody driven;
      driven.track = &track;
      driven.body = &model_.bodies[*track.body];
      driven_bodies_.push_back(driven);
    } else if (track.collider.has_value() && model_.mocap_of_collider[*track.collider] >= 0) {
      moved_colliders_.push_back({&track, model_.mocap_of_collider[*track.collider]});
    }
  }
}

void MujocoSimulation::collect_damped_bodies() {
  for (std::size_t b = 0; b < scene_->bodies.size(); ++b) {
    const physics::Body& body = scene_->bodies[b];
    const bool damped = body.linear_damping > 0 || body.angular_damping > 0;
    if (damped && !body.kinematic && model_.plan.bodies[b].base == BodyBase::Jointed) {
      const BodyMap& map = model_.bodies[b];
      const double* force = model_.data->xfrc_applied + 6 * map.id;
      damped_bodies_.push_back(
          {&map, body.linear_damping, body.angular_damping, read_vector(force)});
    }
  }
}

void MujocoSimulation::follow_drive_tracks() {
  const double now = model_.data->time;
  for (const TrackedDrive& tracked : tracked_drives_) {
    const double value = tracked.track->at(now);
    const DriveMap& map = *tracked.drive;
    physics::Drive& drive = drives_[static_cast<std::size_t>(tracked.drive - model_.drives.data())];
    switch (tracked.track->what) {
      case physics::Animated::DriveTargetPosition:
        model_.data->ctrl[map.control] = value;
        break;
      case physics::Animated::DriveTargetVelocity:
        model_.data->ctrl[map.control + 1] = value;
        break;
      case physics::Animated::DriveStiffness:
        drive.stiffness = value;
        model_.model->actuator_biasprm[mjNBIAS * map.actuator + 1] = -value;
        break;
      case physics::Animated::DriveDamping:
        drive.damping = value;
        model_.model->actuator_biasprm[mjNBIAS * map.actuator + 2] = -value;
        break;
      case physics::Animated::DriveMaxForce:
        model_.model->actuator_forcelimited[map.actuator] = value < physics::kUnlimited ? 1 : 0;
        model_.model->actuator_forcerange[2 * map.actuator] = -value;
        model_.model->actuator_forcerange[2 * map.actuator + 1] = value;
        break;
    }
  }
}

// Effective inertia of a coordinate: what a unit force on it meets, 1 / (e M^-1 e). M is factored
// in every step; here that of the pose one step ago is used.
void MujocoSimulation::scale_acceleration_drives() {
  mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  for (const std::size_t i : acceleration_drives_) {
    const DriveMap& map = model_.drives[i];
    const auto dof = static_cast<std::size_t>(map.dof);
    unit_[dof] = 1;
    mj_solveM(m, d, response_.data(), unit_.data(), 1);
    unit_[dof] = 0;
    const double inertia = 1 / response_[dof];
    m->actuator_biasprm[mjNBIAS * map.actuator + 1] = -drives_[i].stiffness * inertia;
    m->actuator_biasprm[mjNBIAS * map.actuator + 2] = -drives_[i].damping * inertia;
  }
}

void MujocoSimulation::move_colliders() {
  mjData* d = model_.data.get();
  for (const MovedCollider& moved : moved_colliders_) {
    const Pose pose = moved.track->at(d->time);
    write_vector(d->mocap_pos + 3 * moved.mocap, pose.position);
    write_quaternion(d->mocap_quat + 4 * moved.mocap, normalized(pose.orientation));
  }
}

// F = -m c v and T = -I c w at the centre of mass; a rate above 1 / dt stops within one step.
void MujocoSimulation::damp_bodies() {
  if (damped_bodies_.empty()) {
    return;
  }
  bring_up_to_date();
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  const double most = 1 / m->opt.timestep;
  for (const DampedBody& damped : damped_bodies_) {
    const int id = damped.body->id;
    double velocity[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, id, velocity, 1);
    const Quatd principal = read_quaternion(d->xiquat + 4 * id);
    Vec3d force = read_vector(velocity + 3) * (-m->body_mass[id] * std::min(damped.linear, most));
    Vec3d torque;
    for (std::size_t i = 0; i < 3; ++i) {
      torque[i] = -m->body_inertia[3 * static_cast<std::size_t>(id) + i] * velocity[i] *
                  std::min(damped.angular, most);
    }
    force = rotate(principal, force) + damped.constant_force;
    write_vector(d->xfrc_applied + 6 * id, force);
    write_vector(d->xfrc_applied + 6 * id + 3, rotate(principal, torque));
  }
}

// The force that brings a driven body's velocity to (next pose - pose) / dt within this step; the
// inertia of what hangs on it is a millionth of its own.
void MujocoSimulation::push_driven_bodies() {
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  const double dt = m->opt.timestep;
  for (DrivenBody& driven : driven_bodies_) {
    const BodyMap& body = *driven.body;
    const Vec3d position = read_vector(d->qpos + body.free_qpos);
    const Quatd orientation = read_quaternion(d->qpos + body.free_qpos + 3);
    driven.next = driven.track->at(d->time + dt);
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

void MujocoSimulation::place_driven_bodies() {
  mjData* d = model_.data.get();
  for (const DrivenBody& driven : driven_bodies_) {
    write_vector(d->qpos + driven.body->free_qpos, driven.next.position);
    write_quaternion(d->qpos + driven.body->free_qpos + 3, driven.next.orientation);
    write_vector(d->qvel + driven.body->free_dof, driven.linear_velocity);
    write_vector(d->qvel + driven.body->free_dof + 3, driven.angular_velocity);
  }
}

void MujocoSimulation::start_driven_bodies() {
  if (driven_bodies_.empty()) {
    return;
  }
  mjData* d = model_.data.get();
  for (DrivenBody& driven : driven_bodies_) {
    const Pose start = driven.track->at(d->time);
    write_vector(d->qpos + driven.body->free_qpos, start.position);
    write_quaternion(d->qpos + driven.body->free_qpos + 3, normalized(start.orientation));
  }
  push_driven_bodies();
  for (const DrivenBody& driven : driven_bodies_) {
    write_vector(d->qvel + driven.body->free_dof, driven.linear_velocity);
    write_vector(d->qvel + driven.body->free_dof + 3, driven.angular_velocity);
  }
}

}  // namespace tenon::engines::mujoco
