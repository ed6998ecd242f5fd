// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Gravity of further scenes and wrenches share MuJoCo's forces on bodies, so both are written
// together. Efforts of single coordinates are generalized forces. Those of a ball are turned from
// frame 0 into the child, whose axes MuJoCo uses; those of a joint outside the tree become opposite
// forces on both bodies at the origin of frame 1. A mass or an armature changes what MuJoCo derives
// from it at the start, which is derived again; weights that compile() has set itself are put back.
#include "tenon/engines/mujoco/run/control.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tenon/engines/mujoco/build/build.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/read_state.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;
using scene::PhysicsScene;

Error not_here(const Path& prim, const std::string& why) {
  return Error(ErrorCode::Unsupported, why)
      .with_rule("mujoco.not-steerable")
      .with_prim(prim.empty() ? "" : prim.str());
}

// Force and torque on one body of a joint at a point; the world takes everything.
void push(Model& model, const std::optional<Index>& body, const Vec3d& force, const Vec3d& torque,
          const Vec3d& point) {
  if (body.has_value()) {
    mj_applyFT(model.model.get(), model.data.get(), force.v.data(), torque.v.data(), point.v.data(),
               model.bodies[*body].id, model.data->qfrc_applied);
  }
}

void write_loop_efforts(const PhysicsScene& scene, Index index, std::span<const double> efforts,
                        Model& model) {
  const scene::Joint& joint = scene.joints[index];
  const Pose frame0 = frame_in_world(model, joint.body0, joint.frame0);
  const Pose frame1 = frame_in_world(model, joint.body1, joint.frame1);
  if (joint.kind == scene::JointKind::Distance) {
    const Vec3d apart = frame1.position - frame0.position;
    const Vec3d force = length(apart) > 0 ? normalized(apart) * efforts[0] : Vec3d{};
    push(model, joint.body1, force, {}, frame1.position);
    push(model, joint.body0, -force, {}, frame0.position);
    return;
  }
  const scene::JointDofs& dofs = model.joints[index].dofs;
  Vec3d force;
  Vec3d torque;
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    const Vec3d axis = rotate(frame0.orientation, dofs.free[i].axis0) * efforts[i];
    (is_angular(dofs.free[i].dof) ? torque : force) += axis;
  }
  if (dofs.ball) {
    const std::size_t i = dofs.free.size();
    torque += rotate(frame0.orientation, {{efforts[i], efforts[i + 1], efforts[i + 2]}});
  }
  push(model, joint.body1, force, torque, frame1.position);
  push(model, joint.body0, -force, -torque, frame1.position);
}

void write_tree_efforts(const JointMap& map, std::span<const double> efforts, mjData& d) {
  for (std::size_t i = 0; i < map.dof.size(); ++i) {
    d.qfrc_applied[map.dof[i]] += efforts[i];
  }
  if (map.ball_dof < 0) {
    return;
  }
  const std::size_t first = map.dof.size();
  Vec3d torque{{efforts[first], efforts[first + 1], efforts[first + 2]}};
  if (map.reversed) {
    torque = -torque;
  } else {
    const Quatd turn =
        conjugate(map.child_frame) * read_quaternion(d.qpos + map.ball_qpos) * map.child_frame;
    torque = rotate(conjugate(turn), torque);
  }
  torque = rotate(map.child_frame, torque);
  for (std::size_t i = 0; i < 3; ++i) {
    d.qfrc_applied[map.ball_dof + static_cast<int>(i)] += torque[i];
  }
}

// What MuJoCo derives from masses and armatures at the start, except weights that compile() has
// set itself.
Result<void> derive_again(Model& model) {
  mjModel& m = own_model(model);
  const std::vector<mjtNum> body_weights(m.body_invweight0, m.body_invweight0 + 2 * m.nbody);
  const std::vector<mjtNum> dof_weights(m.dof_invweight0, m.dof_invweight0 + m.nv);
  const double mean_inertia = m.stat.meaninertia;
  const bool driven = std::find(model.plan.bases.begin(), model.plan.bases.end(),
                                BodyBase::Driven) != model.plan.bases.end();
  mjData* scratch = nullptr;
  TENON_CHECK(guarded([&] { scratch = mj_makeData(&m); }));
  const DataPtr owner(scratch);
  TENON_CHECK(guarded([&] { mj_setConst(&m, scratch); }));
  for (const int id : model.auxiliary_bodies) {
    std::copy_n(body_weights.begin() + std::ptrdiff_t{2} * id, 2,
                m.body_invweight0 + std::ptrdiff_t{2} * id);
    std::copy_n(dof_weights.begin() + m.body_dofadr[id], m.body_dofnum[id],
                m.dof_invweight0 + m.body_dofadr[id]);
  }
  if (driven) {
    m.stat.meaninertia = mean_inertia;
  }
  return {};
}

Result<void> write_mass(Index body, double mass, Model& model) {
  BodyMap& map = model.bodies[body];
  if (!(map.mass > 0)) {
    return not_here({}, "the mass of a kinematic body moves nothing");
  }
  mjModel& m = own_model(model);
  const double ratio = mass / m.body_mass[map.id];
  m.body_mass[map.id] = mass;
  map.mass = mass;
  for (int i = 0; i < 3; ++i) {
    m.body_inertia[3 * map.id + i] *= ratio;
  }
  for (int i = 0; map.free_dof >= 0 && i < 6; ++i) {
    m.dof_damping[map.free_dof + i] *= ratio;
  }
  return derive_again(model);
}

// The surface of one collider becomes a kind of its own where there is none like it.
void write_friction(Index collider, double friction, Model& model) {
  mjModel& m = own_model(model);
  Surfaces& surfaces = model.surfaces;
  for (const int geom : model.geoms_of_collider[collider]) {
    int& number = surfaces.geom_surface[static_cast<std::size_t>(geom)];
    m.geom_friction[std::ptrdiff_t{3} * geom] = friction;
    if (number < 0) {
      continue;
    }
    SurfaceKind kind = surfaces.kinds[static_cast<std::size_t>(number)];
    kind.friction = friction;
    const auto same = std::find(surfaces.kinds.begin(), surfaces.kinds.end(), kind);
    number = static_cast<int>(same - surfaces.kinds.begin());
    m.geom_friction[std::ptrdiff_t{3} * geom] =
        scene::combine(friction, kind.friction_combine, friction, kind.friction_combine);
    if (same == surfaces.kinds.end()) {
      surfaces.kinds.push_back(kind);
    }
  }
}

Result<void> write_dofs(const PhysicsScene& scene, const ParameterKey& key, double value,
                        Model& model) {
  const JointMap& map = model.joints[key.object];
  std::vector<int> dofs = map.dof;
  for (int i = 0; map.ball_dof >= 0 && i < 3; ++i) {
    dofs.push_back(map.ball_dof + i);
  }
  if (dofs.empty()) {
    return not_here(scene.joints[key.object].path, "the joint has no coordinate on MuJoCo here");
  }
  mjModel& m = own_model(model);
  for (const int dof : dofs) {
    if (key.what == Parameter::JointFriction) {
      harden_friction(m.opt.timestep, scene.joints[key.object].parts.mujoco,
                      m.dof_solref + std::ptrdiff_t{mjNREF} * dof,
                      m.dof_solimp + std::ptrdiff_t{mjNIMP} * dof);
    }
    (key.what == Parameter::JointDamping    ? m.dof_damping
     : key.what == Parameter::JointFriction ? m.dof_frictionloss
                                            : m.dof_armature)[dof] = value;
  }
  // How soon friction of the joint holds follows from its inertia.
  return key.what == Parameter::JointArmature ? derive_again(model) : Result<void>();
}

}  // namespace

int find_drive(const Model& model, Index joint, Index drive) {
  for (std::size_t i = 0; i < model.drives.size(); ++i) {
    const DriveMap& map = model.drives[i];
    if (map.joint == joint && map.drive == drive && map.actuator >= 0) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void write_gravity(const PhysicsScene& scene, const Steering& steering, Model& model) {
  const std::vector<Vec3d> gravity = steering.gravity_of(scene);
  double now[3];
  write_vector(now, gravity.front());
  if (!std::equal(now, now + 3, model.model->opt.gravity)) {
    write_vector(own_model(model).opt.gravity, gravity.front());
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (body.kinematic) {
      continue;
    }
    Wrench wrench{other_gravity(body, model.bodies[b].mass, gravity), {}};
    const auto set = steering.wrenches.find(static_cast<Index>(b));
    if (set != steering.wrenches.end()) {
      wrench.force += set->second.force;
      wrench.torque += set->second.torque;
    }
    write_vector(model.data->xfrc_applied + std::ptrdiff_t{6} * model.bodies[b].id, wrench.force);
    write_vector(model.data->xfrc_applied + std::ptrdiff_t{6} * model.bodies[b].id + 3,
                 wrench.torque);
  }
}

void write_efforts(const PhysicsScene& scene, const Steering& steering, Model& model) {
  std::fill_n(model.data->qfrc_applied, model.model->nv, 0.0);
  for (const auto& [joint, efforts] : steering.efforts) {
    if (!scene.joints[joint].enabled) {
      continue;
    }
    if (model.joints[joint].in_tree) {
      write_tree_efforts(model.joints[joint], efforts, *model.data);
    } else {
      write_loop_efforts(scene, joint, efforts, model);
    }
  }
}

Result<void> write_parameter(const PhysicsScene& scene, const ParameterKey& key, double value,
                             Model& model) {
  switch (key.what) {
    case Parameter::BodyMass:
      return write_mass(key.object, value, model);
    case Parameter::ColliderFriction:
      write_friction(key.object, value, model);
      return {};
    default:
      return write_dofs(scene, key, value, model);
  }
}

Result<void> write_joint_state(const PhysicsScene& scene, Index joint, const JointState& state,
                               Model& model) {
  const JointMap& map = model.joints[joint];
  if (!map.in_tree) {
    return not_here(scene.joints[joint].path,
                    "the joint closes a loop: its coordinates follow from the poses of its bodies");
  }
  mjData* d = model.data.get();
  for (std::size_t i = 0; i < map.qpos.size(); ++i) {
    d->qpos[map.qpos[i]] = state.position[i];
    d->qvel[map.dof[i]] = state.velocity[i];
  }
  if (map.ball_qpos >= 0) {
    const std::size_t first = map.qpos.size();
    const Vec3d vector{
        {state.position[first], state.position[first + 1], state.position[first + 2]}};
    const double angle = length(vector);
    Quatd turn = angle > 0 ? rotation_about(vector * (1 / angle), angle) : kIdentityRotation;
    Vec3d velocity{{state.velocity[first], state.velocity[first + 1], state.velocity[first + 2]}};
    if (map.reversed) {
      turn = conjugate(turn);
      velocity = -velocity;
    } else {
      velocity = rotate(conjugate(turn), velocity);
    }
    write_quaternion(d->qpos + map.ball_qpos,
                     normalized(map.child_frame * turn * conjugate(map.child_frame)));
    write_vector(d->qvel + map.ball_dof, rotate(map.child_frame, velocity));
  }
  return {};
}

Result<void> write_body_state(const PhysicsScene& scene, Index body, const BodyState& state,
                              Model& model) {
  const BodyMap& map = model.bodies[body];
  if (model.plan.bases[body] != BodyBase::Free) {
    return not_here(scene.bodies[body].path,
                    "the body hangs on a joint or is kinematic: set its joint or move it");
  }
  mjData* d = model.data.get();
  const Pose pose{state.pose.position, normalized(state.pose.orientation)};
  const Pose engine = pose * map.engine_frame;
  write_vector(d->qpos + map.free_qpos, engine.position);
  write_quaternion(d->qpos + map.free_qpos + 3, normalized(engine.orientation));
  write_vector(d->qvel + map.free_dof, state.linear_velocity);
  write_vector(d->qvel + map.free_dof + 3,
               rotate(conjugate(engine.orientation), state.angular_velocity));
  return {};
}

}  // namespace tenon::engines::mujoco
