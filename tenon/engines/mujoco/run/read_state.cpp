// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's state in the words of the scene. A body's pose is freed of the engine frame that it was
// given, and a velocity is moved from the inertial frame to the point that is asked for (v + w x
// r). Joints of the tree have coordinates, which know full turns. Loop joints without an auxiliary
// body have only the relative pose of their frames, so their angles lie within a turn. The turn and
// velocity of a ball are stored in the child's frame and are brought to those of frame 1 as frame 0
// sees them.
#include "tenon/engines/mujoco/run/read_state.h"

#include <cstddef>

#include "tenon/engines/joint_readings.h"

namespace tenon::engines::mujoco {
namespace {

Pose body_pose(const Model& model, scene::Index body) {
  const BodyMap& map = model.bodies[body];
  const Pose engine{read_vector(model.data->xpos + std::ptrdiff_t{3} * map.id),
                    read_quaternion(model.data->xquat + std::ptrdiff_t{4} * map.id)};
  return engine * inverse(map.engine_frame);
}

/// About its centre of mass; the world stands still.
RigidMotion motion_of(const Model& model, const std::optional<scene::Index>& body) {
  if (!body.has_value()) {
    return {};
  }
  const int id = model.bodies[*body].id;
  double velocity[6];
  mj_objectVelocity(model.model.get(), model.data.get(), mjOBJ_BODY, id, velocity, 0);
  return {read_vector(model.data->xipos + std::ptrdiff_t{3} * id), read_vector(velocity + 3),
          read_vector(velocity)};
}

JointState tree_joint_state(const Model& model, scene::Index joint) {
  const JointMap& map = model.joints[joint];
  const mjData* d = model.data.get();
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

// Joints outside the tree have their coordinates in the relative pose.
JointState loop_joint_state(const scene::PhysicsScene& scene, const Model& model,
                            scene::Index joint) {
  const scene::Joint& source = scene.joints[joint];
  return joint_state_between(
      source, model.joints[joint].dofs,
      {frame_in_world(model, source.body0, source.frame0), motion_of(model, source.body0)},
      {frame_in_world(model, source.body1, source.frame1), motion_of(model, source.body1)});
}

}  // namespace

void derive_motion(const Model& model) {
  mj_kinematics(model.model.get(), model.data.get());
  mj_comPos(model.model.get(), model.data.get());
  mj_comVel(model.model.get(), model.data.get());
}

BodyState read_body_state(const scene::PhysicsScene& scene, const Model& model, scene::Index body) {
  BodyState state;
  state.pose = body_pose(model, body);
  state.pose.orientation = normalized(state.pose.orientation);
  const RigidMotion motion = motion_of(model, body);
  state.linear_velocity =
      motion.velocity_at(transform_point(state.pose, scene.bodies[body].center_of_mass));
  state.angular_velocity = motion.angular;
  return state;
}

JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model,
                            scene::Index joint) {
  return model.joints[joint].in_tree ? tree_joint_state(model, joint)
                                     : loop_joint_state(scene, model, joint);
}

Vec3d read_center_of_mass(const Model& model, scene::Index body) {
  return read_vector(model.data->xipos + std::ptrdiff_t{3} * model.bodies[body].id);
}

Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity) {
  const mjModel* m = model.model.get();
  const mjData* d = model.data.get();
  Energy energy;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (body.kinematic) {
      continue;
    }
    const BodyMap& map = model.bodies[b];
    double v[6];
    mj_objectVelocity(m, d, mjOBJ_BODY, map.id, v, 1);
    energy.kinetic += map.mass * (v[3] * v[3] + v[4] * v[4] + v[5] * v[5]) / 2;
    for (int i = 0; i < 3; ++i) {
      energy.kinetic += m->body_inertia[3 * map.id + i] * v[i] * v[i] / 2;
    }
    const Vec3d pull = gravity[body.scene] * body.gravity_scale;
    energy.potential -= map.mass * dot(pull, read_vector(d->xipos + std::ptrdiff_t{3} * map.id));
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

std::size_t read_contact_count(const Model& model) {
  std::size_t count = 0;
  for (int i = 0; i < model.data->ncon; ++i) {
    count += model.data->contact[i].efc_address >= 0 ? 1 : 0;
  }
  return count;
}

Pose frame_in_world(const Model& model, const std::optional<scene::Index>& body,
                    const Pose& frame) {
  return body.has_value() ? body_pose(model, *body) * frame : frame;
}

}  // namespace tenon::engines::mujoco
