// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/mujoco_simulation.h"

// Read-back in the words of the neutral scene. MuJoCo's poses are those before its last step until
// the kinematics are run again; that is done once, when something is read.
namespace tenon::engines::mujoco {

void MujocoSimulation::bring_up_to_date() const {
  if (!stale_) {
    return;
  }
  const mjModel* m = model_.model.get();
  mjData* d = model_.data.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_comVel(m, d);
  stale_ = false;
}

double MujocoSimulation::time() const { return model_.data->time; }
double MujocoSimulation::time_step() const { return model_.model->opt.timestep; }
std::size_t MujocoSimulation::dof_count() const {
  return static_cast<std::size_t>(model_.model->nv);
}

BodyState MujocoSimulation::body_state(physics::Index body) const {
  bring_up_to_date();
  const mjData* d = model_.data.get();
  const BodyMap& map = model_.bodies[body];
  const Pose engine{read_vector(d->xpos + 3 * map.id), read_quaternion(d->xquat + 4 * map.id)};
  BodyState state;
  state.pose = engine * inverse(map.engine_frame);
  state.pose.orientation = normalized(state.pose.orientation);
  velocity_of(body, transform_point(state.pose, scene_->bodies[body].center_of_mass),
              state.linear_velocity, state.angular_velocity);
  return state;
}

void MujocoSimulation::velocity_of(const std::optional<physics::Index>& body, const Vec3d& point,
                                   Vec3d& linear, Vec3d& angular) const {
  linear = {};
  angular = {};
  if (!body.has_value()) {
    return;
  }
  const int id = model_.bodies[*body].id;
  double velocity[6];
  mj_objectVelocity(model_.model.get(), model_.data.get(), mjOBJ_BODY, id, velocity, 0);
  angular = read_vector(velocity);
  linear =
      read_vector(velocity + 3) + cross(angular, point - read_vector(model_.data->xipos + 3 * id));
}

Pose MujocoSimulation::frame_in_world(const std::optional<physics::Index>& body,
                                      const Pose& frame) const {
  if (!body.has_value()) {
    return frame;
  }
  const mjData* d = model_.data.get();
  const BodyMap& map = model_.bodies[*body];
  const Pose engine{read_vector(d->xpos + 3 * map.id), read_quaternion(d->xquat + 4 * map.id)};
  return engine * inverse(map.engine_frame) * frame;
}

JointState MujocoSimulation::joint_state(physics::Index joint) const {
  return model_.joints[joint].in_tree ? tree_joint_state(joint) : loop_joint_state(joint);
}

JointState MujocoSimulation::tree_joint_state(physics::Index joint) const {
  const JointMap& map = model_.joints[joint];
  const mjData* d = model_.data.get();
  JointState state;
  for (std::size_t i = 0; i < map.qpos.size(); ++i) {
    state.position.push_back(d->qpos[map.qpos[i]]);
    state.velocity.push_back(d->qvel[map.dof[i]]);
  }
  if (map.ball_qpos >= 0) {
    const Quatd back = conjugate(map.child_frame);
    Quatd turn = back * read_quaternion(d->qpos + map.ball_qpos) * map.child_frame;
    Vec3d velocity =
        rotate(back, read_vector(d->qvel + map.ball_dof));  // in the child's joint frame
    if (map.reversed) {
      turn = conjugate(turn);
      velocity = -velocity;
    } else {
      velocity = rotate(turn, velocity);
    }
    const Vec3d position = rotation_vector(turn);
    state.position.insert(state.position.end(), position.v.begin(), position.v.end());
    state.velocity.insert(state.velocity.end(), velocity.v.begin(), velocity.v.end());
  }
  return state;
}

// Joints outside the tree have their coordinates in the relative pose: angles within one turn.
JointState MujocoSimulation::loop_joint_state(physics::Index joint) const {
  bring_up_to_date();
  const physics::Joint& source = scene_->joints[joint];
  const Pose frame0 = frame_in_world(source.body0, source.frame0);
  const Pose frame1 = frame_in_world(source.body1, source.frame1);
  JointState state;
  Vec3d v0;
  Vec3d w0;
  Vec3d v1;
  Vec3d w1;
  velocity_of(source.body0, frame1.position, v0, w0);
  velocity_of(source.body1, frame1.position, v1, w1);
  if (source.kind == physics::JointKind::Distance) {
    Vec3d anchor0;
    velocity_of(source.body0, frame0.position, anchor0, w0);
    const Vec3d apart = frame1.position - frame0.position;
    return {{length(apart)}, {dot(normalized(apart), v1 - anchor0)}};
  }
  const JointDofs& dofs = model_.joints[joint].dofs;
  state.position = coordinates_at(dofs, inverse(frame0) * frame1);
  for (const FreeDof& dof : dofs.free) {
    const Vec3d axis = rotate(frame0.orientation, dof.axis0);
    state.velocity.push_back(is_angular(dof.dof) ? dot(axis, w1 - w0) : dot(axis, v1 - v0));
  }
  if (dofs.ball) {
    const Vec3d turn = rotate(conjugate(frame0.orientation), w1 - w0);
    state.velocity.insert(state.velocity.end(), turn.v.begin(), turn.v.end());
  }
  return state;
}

// Kinetic energy of bodies and armatures; potential of gravity (zero at the world's origin) and of
// passive springs. Kinematic bodies and drives are left out.
Energy MujocoSimulation::energy() const {
  bring_up_to_date();
  const mjModel* m = model_.model.get();
  const mjData* d = model_.data.get();
  Energy energy;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const physics::Body& body = scene_->bodies[b];
    if (body.kinematic) {
      continue;
    }
    const BodyMap& map = model_.bodies[b];
    double v[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, map.id, v, 1);
    energy.kinetic += map.mass * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]) / 2;
    for (int i = 0; i < 3; ++i) {
      energy.kinetic += m->body_inertia[3 * map.id + i] * v[i] * v[i] / 2;
    }
    const Vec3d gravity = scene_->scenes[body.scene].gravity * body.gravity_scale;
    energy.potential -= map.mass * dot(gravity, read_vector(d->xipos + 3 * map.id));
  }
  for (int i = 0; i < m->nv; ++i) {
    energy.kinetic += m->dof_armature[i] * d->qvel[i] * d->qvel[i] / 2;
  }
  for (int j = 0; j < m->njnt; ++j) {
    if (m->jnt_stiffness[j] != 0 &&
        (m->jnt_type[j] == mjJNT_HINGE || m->jnt_type[j] == mjJNT_SLIDE)) {
      const int q = m->jnt_qposadr[j];
      const double stretch = d->qpos[q] - m->qpos_spring[q];
      energy.potential += m->jnt_stiffness[j] * stretch * stretch / 2;
    }
  }
  return energy;
}

std::size_t MujocoSimulation::contact_count() const {
  std::size_t count = 0;
  for (int i = 0; i < model_.data->ncon; ++i) {
    count += model_.data->contact[i].efc_address >= 0 ? 1 : 0;
  }
  return count;
}

}  // namespace tenon::engines::mujoco
