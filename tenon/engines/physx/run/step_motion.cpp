// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX 5.1 tells what constraints exert, and nothing of the joints of articulations. But of each
// body it is known how it moved, its weight, its contacts and what was applied; the rest is what
// its joints exert. The joint by which a body hangs on its tree carries the rest of all bodies
// behind it (Newton and Euler, from the leaves to the root); joints that close loops, and those of
// kinematic bodies, are asked.
#include "tenon/engines/physx/run/step_motion.h"

#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/run/read_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

/// Turns the angular velocities of a body into its angular momenta, in world axes.
struct Inertia {
  Vec3d moments;
  Quatd axes = kIdentityRotation;  ///< world <- principal
  Vec3d times(const Vec3d& turn) const {
    Vec3d own = rotate(conjugate(axes), turn);
    for (std::size_t i = 0; i < 3; ++i) {
      own[i] *= moments[i];
    }
    return rotate(axes, own);
  }
};

Inertia inertia_at(const px::PxRigidBody& actor, const Pose& pose) {
  return {from_px(actor.getMassSpaceInertiaTensor()),
          pose.orientation * from_px(actor.getCMassLocalPose().q)};
}

void add(Wrench& sum, const Wrench& wrench, double sign = 1) {
  sum.force += wrench.force * sign;
  sum.torque += wrench.torque * sign;
}

/// A wrench about `point` as one about the origin of the world, and back with the opposite point.
Wrench about_origin(const Wrench& wrench, const Vec3d& point) {
  return {wrench.force, wrench.torque + cross(point, wrench.force)};
}

bool rests_asleep(const px::PxRigidBody& actor) {
  if (actor.getType() == px::PxActorType::eARTICULATION_LINK) {
    return static_cast<const px::PxArticulationLink&>(actor).getArticulation().isSleeping();
  }
  return static_cast<const px::PxRigidDynamic&>(actor).isSleeping();
}

/// Mass times acceleration less weight and damping, about the centre of mass.
Wrench needed_wrench(const StepMotion& step, Index index) {
  const px::PxRigidBody& actor = *step.model.bodies[index];
  const scene::Body& body = step.scene.bodies[index];
  const BodyState& from = step.before.bodies[index];
  const BodyState& to = step.after.bodies[index];
  const double mass = actor.getMass();
  const double rate = 1 / step.model.time_step;
  const Vec3d acceleration = (to.linear_velocity - from.linear_velocity) * rate;
  const Inertia inertia = inertia_at(actor, from.pose);
  Vec3d torque = inertia.times((to.angular_velocity - from.angular_velocity) * rate);
  if (body.settings.gyroscopic) {
    torque += cross(from.angular_velocity, inertia.times(from.angular_velocity));
  }
  const Wrench damping = damping_wrench(step, index);
  const Vec3d weight = step.gravity[body.scene] * (mass * body.gravity_scale);
  return {acceleration * mass - weight - damping.force, torque - damping.torque};
}

bool is_tree_joint(const StepMotion& step, Index joint) {
  const std::optional<Index> child = step.model.child_of_joint[joint];
  return child.has_value() && step.moves_freely(*child);
}

/// The constraint pushed in the last step: where it did not, because nothing is locked and all is
/// within its bounds, PhysX keeps reporting the force of an earlier step.
bool acted(const StepMotion& step, Index index) {
  const scene::Joint& joint = step.scene.joints[index];
  const std::vector<double>& at = step.before.joints[index].position;
  if (joint.kind == scene::JointKind::Distance) {
    const scene::Limit bounds = distance_limit(joint);
    return at.empty() || at[0] > bounds.upper || at[0] < bounds.lower;
  }
  const std::vector<scene::FreeDof>& free = step.model.joints[index].dofs.free;
  bool beyond = free.size() < 6;
  for (std::size_t i = 0; i < free.size() && i < at.size(); ++i) {
    beyond = beyond || at[i] >= free[i].upper || at[i] <= free[i].lower;
  }
  return beyond;
}

/// What a constraint says of itself, with the efforts that were put on it.
Wrench told_reaction(const StepMotion& step, Index joint) {
  const px::PxJoint* made = step.model.joints[joint].constraint;
  if (made == nullptr) {
    return {};
  }
  const Wrench& pushed = step.joint_pushes[joint];
  px::PxVec3 force(0);
  px::PxVec3 torque(0);
  if (acted(step, joint)) {
    made->getConstraint()->getForce(force, torque);
  }
  return {pushed.force - from_px(force), pushed.torque - from_px(torque)};
}

}  // namespace

Motion read_motion(const scene::PhysicsScene& scene, const Model& model) {
  Motion motion;
  motion.bodies.reserve(model.bodies.size());
  for (Index b = 0; b < model.bodies.size(); ++b) {
    motion.bodies.push_back(read_body_state(model, b));
  }
  motion.joints.reserve(model.joints.size());
  for (Index j = 0; j < model.joints.size(); ++j) {
    motion.joints.push_back(read_joint_state(scene, model, j));
  }
  return motion;
}

Vec3d StepMotion::center(Index body) const {
  return transform_point(before.bodies[body].pose,
                         from_px(model.bodies[body]->getCMassLocalPose().p));
}

Vec3d StepMotion::mean_velocity(const std::optional<Index>& body, const Vec3d& point) const {
  if (!body.has_value()) {
    return {};
  }
  const Vec3d linear =
      (before.bodies[*body].linear_velocity + after.bodies[*body].linear_velocity) * 0.5;
  return linear + cross(mean_turn(body), point - center(*body));
}

Vec3d StepMotion::mean_turn(const std::optional<Index>& body) const {
  if (!body.has_value()) {
    return {};
  }
  return (before.bodies[*body].angular_velocity + after.bodies[*body].angular_velocity) * 0.5;
}

Vec3d StepMotion::joint_origin(Index joint) const {
  const scene::Joint& source = scene.joints[joint];
  const Pose body = source.body1 ? before.bodies[*source.body1].pose : Pose{};
  return transform_point(body, source.frame1.position);
}

Wrench damping_wrench(const StepMotion& step, Index index) {
  const px::PxRigidBody& actor = *step.model.bodies[index];
  const scene::Body& body = step.scene.bodies[index];
  const BodyState& from = step.before.bodies[index];
  const Vec3d fallen = step.gravity[body.scene] * (body.gravity_scale * step.model.time_step);
  const Vec3d momentum = (from.linear_velocity + fallen) * static_cast<double>(actor.getMass());
  return {momentum * -static_cast<double>(actor.getLinearDamping()),
          inertia_at(actor, from.pose).times(from.angular_velocity) *
              -static_cast<double>(actor.getAngularDamping())};
}

std::vector<Wrench> unexplained_wrenches(const StepMotion& step) {
  std::vector<Wrench> rest(step.scene.bodies.size());
  std::vector<char> counts(rest.size(), 0);
  for (Index b = 0; b < rest.size(); ++b) {
    counts[b] = step.moves_freely(b) && !rests_asleep(*step.model.bodies[b]) ? 1 : 0;
    if (counts[b] != 0) {
      Wrench needed = needed_wrench(step, b);
      add(needed, step.applied[b], -1);
      rest[b] = about_origin(needed, step.center(b));
    }
  }
  for (const Contact& contact : step.contacts) {
    const Wrench pushed = about_origin({contact.force(), contact.friction_torque}, contact.point);
    if (contact.body1.has_value() && counts[*contact.body1] != 0) {
      add(rest[*contact.body1], pushed, -1);
    }
    if (contact.body0.has_value() && counts[*contact.body0] != 0) {
      add(rest[*contact.body0], pushed);
    }
  }
  return rest;
}

std::vector<Wrench> joint_reactions(const StepMotion& step) {
  std::vector<Wrench> rest = unexplained_wrenches(step);
  std::vector<Wrench> reactions(step.scene.joints.size());
  for (Index j = 0; j < reactions.size(); ++j) {
    const scene::Joint& joint = step.scene.joints[j];
    if (step.model.joints[j].role == JointRole::None || is_tree_joint(step, j)) {
      continue;
    }
    reactions[j] = told_reaction(step, j);
    const Wrench told = about_origin(reactions[j], step.joint_origin(j));
    if (joint.body1.has_value()) {
      add(rest[*joint.body1], told, -1);
    }
    if (joint.body0.has_value()) {
      add(rest[*joint.body0], told);
    }
  }
  const std::vector<Index>& order = step.model.forest.order;
  for (auto body = order.rbegin(); body != order.rend(); ++body) {
    const scene::ForestBody& place = step.model.forest.bodies[*body];
    if (!place.joint.has_value() || !is_tree_joint(step, *place.joint)) {
      continue;
    }
    if (place.parent.has_value()) {
      add(rest[*place.parent], rest[*body]);
    }
    const Wrench carried = about_origin(rest[*body], -step.joint_origin(*place.joint));
    add(reactions[*place.joint], carried, place.reversed ? -1 : 1);
  }
  return reactions;
}

}  // namespace tenon::engines::physx
