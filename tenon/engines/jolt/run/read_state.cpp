// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Jolt knows bodies alone. Coordinates of joints are read off how their frames stand; what a joint
// carries is the sum of what its holder and the laws of its coordinates have exerted.
#include "tenon/engines/jolt/run/read_state.h"

#include <cmath>

#include "tenon/engines/jolt/convert.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

RigidMotion motion_of(const Model& model, const std::optional<Index>& body) {
  if (!body.has_value()) {
    return {};
  }
  const JPH::Body& made = *model.bodies[*body];
  return {from_jolt(made.GetCenterOfMassPosition()), from_jolt(made.GetLinearVelocity()),
          from_jolt(made.GetAngularVelocity())};
}

double kinetic(const JPH::Body& body) {
  const JPH::MotionProperties& motion = *body.GetMotionProperties();
  const Vec3d linear = from_jolt(motion.GetLinearVelocity());
  const Quatd axes = from_jolt(body.GetRotation() * motion.GetInertiaRotation());
  const Vec3d turn = rotate(conjugate(axes), from_jolt(motion.GetAngularVelocity()));
  const Vec3d inverse = from_jolt(motion.GetInverseInertiaDiagonal());
  const auto share = [](double inverse_inertia, double speed) {
    return inverse_inertia > 0 ? speed * speed / inverse_inertia / 2 : 0;
  };
  return share(static_cast<double>(motion.GetInverseMass()), length(linear)) +
         share(inverse[0], turn[0]) + share(inverse[1], turn[1]) + share(inverse[2], turn[2]);
}

void add_joint_energy(const scene::Joint& joint, const JointState& state, Energy& energy) {
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    const double stretch = state.position[i] - joint.spring_reference;
    energy.kinetic += joint.armature * state.velocity[i] * state.velocity[i] / 2;
    energy.potential += joint.stiffness * stretch * stretch / 2;
  }
}

Wrench read_holder(const JointMap& joint, double time_step) {
  if (joint.measured == nullptr) {
    return {};
  }
  const Wrench impulse = joint.measured->impulse();
  return {impulse.force * (1 / time_step), impulse.torque * (1 / time_step)};
}

}  // namespace

BodyState read_body_state(const Model& model, Index body) {
  const JPH::Body& made = *model.bodies[body];
  return {pose_of(made), from_jolt(made.GetLinearVelocity()), from_jolt(made.GetAngularVelocity())};
}

JointSide read_side(const Model& model, const std::optional<Index>& body, const Pose& frame) {
  return {body ? pose_of(*model.bodies[*body]) * frame : frame, motion_of(model, body)};
}

JointState read_joint_state(const scene::PhysicsScene& scene, const Model& model, Index joint) {
  const scene::Joint& source = scene.joints[joint];
  const JointMap& map = model.joints[joint];
  JointState state =
      joint_state_between(source, map.dofs, read_side(model, source.body0, source.frame0),
                          read_side(model, source.body1, source.frame1));
  for (std::size_t i = 0; i < map.laws.size() && i < map.dofs.free.size(); ++i) {
    if (map.laws[i] != nullptr && is_angular(map.dofs.free[i].dof)) {
      const double turns = (map.laws[i]->position() - state.position[i]) / (2 * M_PI);
      state.position[i] += 2 * M_PI * std::round(turns);
    }
  }
  return state;
}

Vec3d read_center_of_mass(const Model& model, Index body) {
  return from_jolt(model.bodies[body]->GetCenterOfMassPosition());
}

Energy read_energy(const scene::PhysicsScene& scene, const Model& model,
                   std::span<const Vec3d> gravity) {
  Energy energy;
  for (Index b = 0; b < model.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    const JPH::Body& made = *model.bodies[b];
    if (!made.IsDynamic()) {
      continue;
    }
    energy.kinetic += kinetic(made);
    const double inverse = static_cast<double>(made.GetMotionProperties()->GetInverseMass());
    const double mass = inverse > 0 ? 1 / inverse : body.mass;
    energy.potential -=
        mass * dot(gravity[body.scene] * body.gravity_scale, read_center_of_mass(model, b));
  }
  for (Index j = 0; j < model.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    if (model.joints[j].acts && (joint.armature != 0 || joint.stiffness != 0)) {
      add_joint_energy(joint, read_joint_state(scene, model, j), energy);
    }
  }
  return energy;
}

Wrench read_reaction(const Model& model, Index joint) {
  const JointMap& map = model.joints[joint];
  if (map.tree != nullptr) {
    const Wrench impulse = map.tree->impulse(joint);
    return {impulse.force * (1 / model.time_step), impulse.torque * (1 / model.time_step)};
  }
  Wrench total = read_holder(map, model.time_step);
  for (const JPH::Ref<CoordinateLaw>& law : model.laws) {
    for (std::size_t part = 0; part < law->parts().size(); ++part) {
      if (law->parts()[part].joint == joint) {
        const Wrench impulse = law->impulse(part);
        total.force += impulse.force * (1 / model.time_step);
        total.torque += impulse.torque * (1 / model.time_step);
      }
    }
  }
  return total;
}

}  // namespace tenon::engines::jolt
