// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How values that the caller sets get into Jolt, and what joints and drives did in a step.
#include <algorithm>
#include <cmath>

#include "tenon/engines/applied_forces.h"
#include "tenon/engines/drive_values.h"
#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/jolt_simulation.h"
#include "tenon/engines/jolt/run/read_state.h"
#include "tenon/scene/motion/joint_motion.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

bool exerts(const scene::Drive& drive) {
  return (drive.stiffness != 0 || drive.damping != 0) && drive.max_force != 0;
}

/// A state that moves along with `from`, where that comes to `to`.
BodyState moved_along(const BodyState& state, const BodyState& from, const Vec3d& from_center,
                      const BodyState& to, const Vec3d& to_center, const Vec3d& center) {
  const Pose shift = to.pose * inverse(from.pose);
  const Vec3d linear = state.linear_velocity - from.linear_velocity -
                       cross(from.angular_velocity, center - from_center);
  const Vec3d turned = rotate(shift.orientation, linear);
  const Vec3d moved_center = transform_point(shift, center);
  return {shift * state.pose,
          turned + to.linear_velocity + cross(to.angular_velocity, moved_center - to_center),
          rotate(shift.orientation, state.angular_velocity - from.angular_velocity) +
              to.angular_velocity};
}

}  // namespace

Result<void> JoltSimulation::write_target(Index joint, Index drive) {
  const bool acts = model_.joints[joint].drives[drive].has_value() &&
                    exerts(drives_at(*scene_, joint, steering_, time())[drive]);
  if (!acts) {
    return not_steerable(scene_->joints[joint].path,
                         "the drive exerts no force on Jolt: its gains are 0, or it is disabled");
  }
  inputs_.steer_drives(joint, model_, steering_, time());
  return {};
}

Result<void> JoltSimulation::write_gravity() {
  const std::vector<Vec3d> gravity = steering_.gravity_of(*scene_);
  for (std::size_t s = 0; s < model_.systems.size(); ++s) {
    model_.systems[s].system->SetGravity(to_jolt(gravity[s]));
  }
  return {};
}

Result<void> JoltSimulation::write_parameter(const ParameterKey& key, double value) {
  if (is_of_drive(key.what)) {
    inputs_.steer_drives(key.object, model_, steering_, time());
    return {};
  }
  if (key.what == Parameter::BodyMass) {
    const scene::Body body = with_mass(scene_->bodies[key.object], value);
    if (!body.kinematic) {
      set_mass(body, *model_.bodies[key.object]);
      for (const JPH::Ref<TreeHolder>& tree : model_.trees) {
        tree->set_mass(key.object, body.mass, body.inertia);
      }
    }
    return {};
  }
  if (key.what == Parameter::ColliderFriction) {
    for (const System& system : model_.systems) {
      system.listener->set_friction(key.object, value);
    }
    return {};
  }
  return write_joint_parameter(key, value);
}

// Of every coordinate of the joint along which something acts.
Result<void> JoltSimulation::write_joint_parameter(const ParameterKey& key, double value) {
  bool written = false;
  for (const JPH::Ref<CoordinateLaw>& law : model_.joints[key.object].laws) {
    if (law == nullptr) {
      continue;
    }
    LawTerm* term = law->own_term(key.what);
    if (term == nullptr) {
      continue;
    }
    (key.what == Parameter::JointDamping    ? term->damping
     : key.what == Parameter::JointFriction ? term->max_force
                                            : term->inertia) = value;
    written = true;
  }
  return written ? Result<void>()
                 : not_steerable(scene_->joints[key.object].path,
                                 std::string(parameter_name(key.what)) +
                                     " can be changed on Jolt where the asset gives the joint one");
}

void JoltSimulation::write_state(Index body, const BodyState& state) {
  JPH::BodyInterface& bodies =
      model_.systems[scene_->bodies[body].scene].system->GetBodyInterfaceNoLock();
  JPH::Body& made = *model_.bodies[body];
  bodies.SetPositionAndRotation(made.GetID(), to_jolt_place(state.pose.position),
                                to_jolt(state.pose.orientation), JPH::EActivation::Activate);
  made.SetLinearVelocity(to_jolt(state.linear_velocity));
  made.SetAngularVelocity(to_jolt(state.angular_velocity));
}

// The body and all that hangs on it, in trees.
std::vector<Index> JoltSimulation::bodies_behind(Index body) const {
  std::vector<Index> found{body};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::vector<Index>& children = model_.forest.bodies[found[i]].children;
    found.insert(found.end(), children.begin(), children.end());
  }
  return found;
}

Result<void> JoltSimulation::write_joint_state(Index joint, const JointState& state) {
  const scene::Joint& source = scene_->joints[joint];
  const auto hangs_on_it = [&](const std::optional<Index>& body) {
    return body.has_value() && model_.forest.bodies[*body].joint == joint;
  };
  const std::optional<Index> child = hangs_on_it(source.body1)   ? source.body1
                                     : hangs_on_it(source.body0) ? source.body0
                                                                 : std::nullopt;
  if (!child.has_value()) {
    return not_steerable(source.path, "the joint closes a loop: its state follows from others");
  }
  const bool reversed = model_.forest.bodies[*child].reversed;
  const JointMap& map = model_.joints[joint];
  const JointSide side0 = read_side(model_, source.body0, source.frame0);
  const JointSide side1 = read_side(model_, source.body1, source.frame1);
  const Pose relative = relative_pose_at(map.dofs, state.position);
  // The frame of the child's side comes to where the other frame and the coordinates put it.
  const Pose wanted = reversed ? side1.frame * inverse(relative) : side0.frame * relative;
  const Pose found = reversed ? side0.frame : side1.frame;
  const JointSide& carrier = reversed ? side1 : side0;
  const scene::JointMotion motion = reversed ? joint_motion(map.dofs, wanted, side1.frame)
                                             : joint_motion(map.dofs, side0.frame, wanted);
  BodyState from = body_state(*child);
  BodyState to;
  to.pose = wanted * inverse(found) * from.pose;
  to.angular_velocity = carrier.motion.angular;
  Vec3d slide;
  const std::size_t slides = motion.slides.size();
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    const double speed = reversed ? -state.velocity[i] : state.velocity[i];
    slide += i < slides ? motion.slides[i] * speed : Vec3d{};
    to.angular_velocity += i < slides ? Vec3d{} : motion.turns[i - slides] * speed;
  }
  const Vec3d center = transform_point(to.pose, scene_->bodies[*child].center_of_mass);
  to.linear_velocity = carrier.motion.velocity_at(motion.point) + slide +
                       cross(to.angular_velocity, center - motion.point);
  const Vec3d from_center = center_of_mass(*child);
  for (const Index body : bodies_behind(*child)) {
    write_state(body,
                moved_along(body_state(body), from, from_center, to, center, center_of_mass(body)));
  }
  for (std::size_t i = 0; i < map.laws.size(); ++i) {
    if (map.laws[i] != nullptr) {
      map.laws[i]->count_from(0, state.position[i]);
    }
  }
  return {};
}

Result<void> JoltSimulation::write_body_state(Index body, const BodyState& state) {
  if (scene_->bodies[body].kinematic || model_.forest.bodies[body].joint.has_value()) {
    return not_steerable(scene_->bodies[body].path,
                         "the body hangs on a joint or is moved by the asset");
  }
  const BodyState from = body_state(body);
  BodyState to = state;
  to.pose.orientation = normalized(to.pose.orientation);
  const Vec3d from_center = center_of_mass(body);
  const Vec3d center = transform_point(to.pose, scene_->bodies[body].center_of_mass);
  for (const Index other : bodies_behind(body)) {
    write_state(other, other == body ? to
                                     : moved_along(body_state(other), from, from_center, to, center,
                                                   center_of_mass(other)));
  }
  return {};
}

// What its term has exerted during the step.
std::vector<double> JoltSimulation::efforts_of_step(Index joint) const {
  const JointMap& map = model_.joints[joint];
  std::vector<double> efforts(map.drives.size(), 0);
  for (std::size_t d = 0; d < efforts.size(); ++d) {
    if (const std::optional<DriveAt>& at = map.drives[d]) {
      efforts[d] = map.laws[at->law]->terms[at->term].impulse / model_.time_step;
    }
  }
  return efforts;
}

Wrench JoltSimulation::reaction_of_step(Index joint) const {
  Wrench reaction = read_reaction(model_, joint);
  const auto set = steering_.efforts.find(joint);
  if (set != steering_.efforts.end() && steps() > 0 && model_.joints[joint].acts) {
    const scene::Joint& source = scene_->joints[joint];
    const Wrench effort = effort_wrench(
        source, model_.joints[joint].dofs, read_side(model_, source.body0, source.frame0).frame,
        read_side(model_, source.body1, source.frame1).frame, set->second);
    reaction.force += effort.force;
    reaction.torque += effort.torque;
  }
  return reaction;
}

BodyAcceleration JoltSimulation::body_acceleration_of_step(Index body) const {
  return mean_acceleration(bodies_at_begin_, body, body_state(body), time_step());
}

std::vector<double> JoltSimulation::joint_acceleration_of_step(Index joint) const {
  return mean_acceleration(joints_at_begin_, joint, joint_state(joint), time_step());
}

}  // namespace tenon::engines::jolt
