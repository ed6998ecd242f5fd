// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Coordinates are read off the relative poses of joint frames; what they cannot express is reported
// (S-90), and an authored joint position replaces them. Velocities are those that the joints make
// of the bodies' own (fit_velocities), where the coordinates put the bodies. mj_forward then
// derives the rest with the contact filter in force.
#include <cmath>
#include <cstddef>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/coupled_drives.h"
#include "tenon/engines/start_coordinates.h"
#include "tenon/engines/steering.h"
#include "tenon/scene/motion/fit_velocities.h"
#include "tenon/scene/start_coordinate.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;
using scene::PhysicsScene;

void set_coordinates(const PhysicsScene& scene, const scene::Joint& joint, const JointMap& map,
                     Diagnostics& diagnostics, double* qpos) {
  const std::vector<double> coordinates = start_coordinates(scene, joint, map.dofs, diagnostics);
  for (std::size_t i = 0; i < map.qpos.size(); ++i) {
    qpos[map.qpos[i]] = coordinates[i];
  }
  if (map.ball_qpos >= 0) {
    const Pose relative = relative_frames(scene, joint);
    const Quatd turn = map.reversed ? conjugate(relative.orientation) : relative.orientation;
    write_quaternion(qpos + map.ball_qpos,
                     normalized(map.child_frame * turn * conjugate(map.child_frame)));
  }
}

void set_positions(const PhysicsScene& scene, Model& model, Diagnostics& diagnostics) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    if (map.in_tree) {
      set_coordinates(scene, scene.joints[j], map, diagnostics, model.data->qpos);
    }
  }
}

void set_free_velocity(const scene::BodyState& state, const BodyMap& map, mjData* data) {
  write_vector(data->qvel + map.free_dof, state.linear_velocity);
  const Quatd world = state.pose.orientation * map.engine_frame.orientation;
  write_vector(data->qvel + map.free_dof + 3, rotate(conjugate(world), state.angular_velocity));
}

// A ball turns in MuJoCo as its child sees it.
void set_ball_velocity(const scene::Joint& joint, const JointMap& map, const Vec3d& in_frame0,
                       const scene::FittedVelocities& fitted, mjData* data) {
  const Quatd frame0 = (joint.body0 ? fitted.bodies[*joint.body0].pose : Pose{}).orientation *
                       joint.frame0.orientation;
  const std::optional<Index>& child = map.reversed ? joint.body0 : joint.body1;
  Quatd child_world = child ? fitted.bodies[*child].pose.orientation : kIdentityRotation;
  if (map.auxiliary) {
    child_world = child_world * joint.frame1.orientation;
  }
  const Vec3d turn = rotate(frame0, map.reversed ? -in_frame0 : in_frame0);
  write_vector(data->qvel + map.ball_dof, rotate(conjugate(child_world), turn));
}

void stop_locked_axes(const scene::Body& body, const BodyMap& map, mjData* data) {
  for (int axis = 0; axis < 3; ++axis) {
    if ((body.settings.locked_translation >> axis & 1) != 0) {
      data->qvel[map.free_dof + axis] = 0;
    }
    if ((body.settings.locked_rotation >> axis & 1) != 0) {
      data->qvel[map.free_dof + 3 + axis] = 0;
    }
  }
}

void write_velocities(const PhysicsScene& scene, const scene::FittedVelocities& fitted,
                      Model& model) {
  mjData* d = model.data.get();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (model.plan.bases[b] == BodyBase::Free) {
      set_free_velocity(fitted.bodies[b], model.bodies[b], d);
      stop_locked_axes(scene.bodies[b], model.bodies[b], d);
    }
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointMap& map = model.joints[j];
    const std::vector<double>& speeds = fitted.joints[j];
    for (std::size_t i = 0; map.in_tree && i < map.dof.size(); ++i) {
      d->qvel[map.dof[i]] = speeds[i];
    }
    if (map.in_tree && map.ball_dof >= 0) {
      const Vec3d turn{
          {speeds[map.dof.size()], speeds[map.dof.size() + 1], speeds[map.dof.size() + 2]}};
      set_ball_velocity(scene.joints[j], map, turn, fitted, d);
    }
  }
}

// In the middle of a run every link has the velocity that it has, kinematic bodies too.
Result<void> set_velocities(const PhysicsScene& scene, Begin begin, Model& model,
                            Diagnostics& diagnostics) {
  mjModel* m = model.model.get();
  mjData* d = model.data.get();
  std::vector<scene::BodyState> states = scene::states_at_start(scene, m->opt.timestep);
  for (std::size_t b = 0; begin == Begin::Middle && b < states.size(); ++b) {
    states[b].linear_velocity = scene.bodies[b].linear_velocity;
    states[b].angular_velocity = scene.bodies[b].angular_velocity;
  }
  if (!scene::anything_moves(scene, states)) {
    return {};
  }
  TENON_CHECK(guarded([&] { mj_kinematics(m, d); }));
  std::vector<scene::JointDofs> dofs;
  for (const JointMap& map : model.joints) {
    dofs.push_back(map.dofs);
  }
  for (std::size_t b = 0; b < states.size(); ++b) {
    const BodyMap& map = model.bodies[b];
    if (model.plan.bases[b] != BodyBase::Jointed) {
      continue;  // is where the scene says
    }
    states[b].pose = Pose{read_vector(d->xpos + std::ptrdiff_t{3} * map.id),
                          read_quaternion(d->xquat + std::ptrdiff_t{4} * map.id)} *
                     inverse(map.engine_frame);
  }
  const scene::FittedVelocities fitted = scene::fit_velocities(
      scene, model.plan.forest, dofs, states,
      begin == Begin::Start ? scene::LinkVelocities::OfJoints : scene::LinkVelocities::Own);
  report_lost_energy(scene, fitted, diagnostics);
  write_velocities(scene, fitted, model);
  return {};
}

void set_controls(const PhysicsScene& scene, Model& model) {
  for (const DriveMap& map : model.drives) {
    if (map.actuator >= 0) {
      const scene::Drive& drive = scene.joints[map.joint].drives[map.drive];
      mjtNum* const controls = model.data->ctrl;
      if (map.is_plain) {
        controls[map.control] =
            drive.stiffness != 0 ? drive.target_position : drive.target_velocity;
        if (map.velocity_control >= 0) {
          controls[map.velocity_control] = drive.target_velocity;
        }
        continue;
      }
      controls[map.control] = drive.target_position;
      controls[map.control + 1] = drive.target_velocity;
    }
  }
}

// Bodies of further scenes carry the difference as a constant force at their centre of mass.
void set_other_gravities(const PhysicsScene& scene, Model& model) {
  const std::vector<Vec3d> gravity = Steering{}.gravity_of(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].scene != 0 && !scene.bodies[b].kinematic) {
      write_vector(model.data->xfrc_applied + std::ptrdiff_t{6} * model.bodies[b].id,
                   other_gravity(scene.bodies[b], model.bodies[b].mass, gravity));
    }
  }
}

}  // namespace

Vec3d other_gravity(const scene::Body& body, double mass, std::span<const Vec3d> gravity) {
  return body.scene == 0 ? Vec3d{}
                         : (gravity[body.scene] - gravity.front()) * (mass * body.gravity_scale);
}

Result<void> set_initial_state(const PhysicsScene& scene, Begin begin, Model& model,
                               Diagnostics& diagnostics) {
  set_positions(scene, model, diagnostics);
  TENON_CHECK(set_velocities(scene, begin, model, diagnostics));
  set_controls(scene, model);
  set_other_gravities(scene, model);
  const FilterScope filter(model.filter);
  return guarded([&] { forward(model); });
}

}  // namespace tenon::engines::mujoco
