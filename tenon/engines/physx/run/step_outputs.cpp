// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Work is force times mean velocity of the point it acts on, so that of all forces on a body adds
// up to the change of its kinetic energy. What joints do that is neither their drives' nor set from
// outside, is that of their limits, friction and mimics.
#include "tenon/engines/physx/run/step_outputs.h"

#include <algorithm>

#include "tenon/engines/physx/run/drives.h"
#include "tenon/engines/steered_simulation.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

double power_of(const Wrench& wrench, const Vec3d& velocity, const Vec3d& turn) {
  return dot(wrench.force, velocity) + dot(wrench.torque, turn);
}

double mean(double a, double b) { return (a + b) / 2; }

/// What drives exerted along one coordinate after the other. The spring is that of the beginning of
/// the step, the damper that of its end, and at least k dt (drives.h). By acceleration the law is
/// one of accelerations, and the rest of the joint's own torque is the drive's.
std::vector<double> drive_efforts(const scene::Joint& joint, const StepMotion& step, Index index,
                                  double left_over) {
  const scene::JointDofs& dofs = step.model.joints[index].dofs;
  const std::vector<double>& from = step.before.joints[index].position;
  const std::vector<double>& speed = step.after.joints[index].velocity;
  std::vector<double> efforts(joint.drives.size(), 0);
  for (Index d = 0; d < joint.drives.size(); ++d) {
    const scene::Drive& drive = joint.drives[d];
    for (std::size_t i = 0; i < dofs.free.size() && i < from.size(); ++i) {
      if (dofs.free[i].dof != drive.dof || (drive.stiffness == 0 && drive.damping == 0)) {
        continue;
      }
      efforts[d] = drive_effort(joint, step.model.joints[index], drive, from[i], speed[i],
                                step.model.time_step)
                       .value_or(std::clamp(left_over, -drive.max_force, drive.max_force));
    }
  }
  return efforts;
}

/// The torque or force along the one coordinate of a joint.
double along_coordinate(const StepMotion& step, Index index, const Wrench& reaction) {
  const scene::Joint& joint = step.scene.joints[index];
  const scene::JointDofs& dofs = step.model.joints[index].dofs;
  if (dofs.free.size() != 1) {
    return 0;
  }
  const Pose body = joint.body0 ? step.before.bodies[*joint.body0].pose : Pose{};
  const Vec3d axis = rotate((body * joint.frame0).orientation, dofs.free.front().axis0);
  return dot(axis, is_angular(dofs.free.front().dof) ? reaction.torque : reaction.force);
}

/// What a joint's own numbers do along its coordinate: its spring and its damper [J].
struct PassiveWork {
  double spring = 0;
  double damping = 0;
  bool in_potential = false;  ///< Energy::potential has the spring
};

PassiveWork passive_work(const StepMotion& step, Index index) {
  const scene::Joint& joint = step.scene.joints[index];
  const JointState& from = step.before.joints[index];
  const JointState& to = step.after.joints[index];
  PassiveWork work;
  if (from.position.size() != 1 || to.position.size() != 1) {
    return work;
  }
  const auto energy = [&](double q) {
    const double stretch = q - joint.spring_reference;
    return joint.stiffness * stretch * stretch / 2;
  };
  const double speed = mean(from.velocity[0], to.velocity[0]);
  work.spring = energy(from.position[0]) - energy(to.position[0]);
  work.damping = -joint.damping * speed * speed * step.model.time_step;
  work.in_potential = step.model.joints[index].role == JointRole::Reduced;
  return work;
}

double rotor_work(const StepMotion& step, Index index) {
  const double armature = step.scene.joints[index].armature;
  const JointState& from = step.before.joints[index];
  const JointState& to = step.after.joints[index];
  const bool has_rotor = armature != 0 && from.velocity.size() == 1 &&
                         step.model.joints[index].role == JointRole::Reduced;
  return has_rotor ? armature *
                         (to.velocity[0] * to.velocity[0] - from.velocity[0] * from.velocity[0]) / 2
                   : 0;
}

}  // namespace

void StepOutputs::begin(const scene::PhysicsScene& scene, const Model& model) {
  before_ = read_motion(scene, model);
}

void StepOutputs::end(const scene::PhysicsScene& scene, const Model& model,
                      const StepInputs& inputs, const Steering& steering,
                      const std::vector<Contact>& contacts, double now) {
  after_ = read_motion(scene, model);
  has_step_ = true;
  const std::vector<Vec3d> gravity = steering.gravity_of(scene);
  const StepMotion step{
      scene, model, before_, after_, contacts, inputs.applied(), inputs.joint_pushes(), gravity};
  if (!wanted_.reactions && !wanted_.work && !wanted_.efforts) {
    return;
  }
  reactions_ = joint_reactions(step);
  efforts_.resize(scene.joints.size());
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint joint = inputs.joint_now(j, steering, now);
    const double pushed = steering.efforts.contains(j) && !steering.efforts.at(j).empty()
                              ? steering.efforts.at(j).front()
                              : 0;
    efforts_[j] =
        model.joints[j].role == JointRole::None
            ? std::vector<double>(joint.drives.size(), 0)
            : drive_efforts(joint, step, j, along_coordinate(step, j, reactions_[j]) - pushed);
  }
  if (wanted_.work) {
    add_work(step, inputs, steering);
  }
}

void StepOutputs::add_work(const StepMotion& step, const StepInputs& inputs,
                           const Steering& steering) {
  const double dt = step.model.time_step;
  for (Index b = 0; b < step.scene.bodies.size(); ++b) {
    if (!step.moves_freely(b)) {
      continue;
    }
    const Vec3d velocity = step.mean_velocity(b, step.center(b));
    const Vec3d turn = step.mean_turn(b);
    work_.applied += power_of(inputs.applied()[b], velocity, turn) * dt;
    work_.damping += power_of(damping_wrench(step, b), velocity, turn) * dt;
  }
  for (const Contact& contact : step.contacts) {
    const Wrench pushed{contact.force(), contact.friction_torque};
    const auto give = [&](const std::optional<Index>& body, double sign) {
      if (body.has_value() && step.moves_freely(*body)) {
        work_.contacts +=
            sign * dt *
            power_of(pushed, step.mean_velocity(body, contact.point), step.mean_turn(body));
      }
    };
    give(contact.body1, 1);
    give(contact.body0, -1);
  }
  for (Index j = 0; j < step.scene.joints.size(); ++j) {
    if (step.model.joints[j].role != JointRole::None) {
      add_joint_work(step, j, steering);
    }
  }
}

void StepOutputs::add_joint_work(const StepMotion& step, Index j, const Steering& steering) {
  const double dt = step.model.time_step;
  const scene::Joint& joint = step.scene.joints[j];
  const Vec3d origin = step.joint_origin(j);
  double all = rotor_work(step, j);
  const auto give = [&](const std::optional<Index>& body, double sign) {
    if (body.has_value() && step.moves_freely(*body)) {
      all += sign * dt *
             power_of(reactions_[j], step.mean_velocity(body, origin), step.mean_turn(body));
    }
  };
  give(joint.body1, 1);
  give(joint.body0, -1);
  const auto speed = [&](std::size_t i) {
    return mean(step.before.joints[j].velocity[i], step.after.joints[j].velocity[i]);
  };
  const scene::JointDofs& dofs = step.model.joints[j].dofs;
  double drives = 0;
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    for (Index d = 0; d < joint.drives.size(); ++d) {
      drives += joint.drives[d].dof == dofs.free[i].dof ? efforts_[j][d] * speed(i) * dt : 0;
    }
  }
  double applied = 0;
  if (const auto pushed = steering.efforts.find(j); pushed != steering.efforts.end()) {
    for (std::size_t i = 0; i < pushed->second.size(); ++i) {
      applied += pushed->second[i] * speed(i) * dt;
    }
  }
  const PassiveWork passive = passive_work(step, j);
  work_.drives += drives;
  work_.applied += applied;
  work_.damping += passive.damping;
  work_.springs += passive.in_potential ? 0 : passive.spring;
  work_.constraints += all - drives - applied - passive.damping - passive.spring;
}

BodyAcceleration StepOutputs::body_acceleration(Index body, double time_step) const {
  return has_step_ ? mean_acceleration(before_.bodies, body, after_.bodies[body], time_step)
                   : BodyAcceleration{};
}

std::vector<double> StepOutputs::joint_acceleration(Index joint, double time_step) const {
  return mean_acceleration(before_.joints, joint, after_.joints[joint], time_step);
}

}  // namespace tenon::engines::physx
