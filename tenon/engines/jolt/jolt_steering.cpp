// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Values that the caller sets are checked, given to Jolt and remembered, so that a rebuilt model
// gets them again.
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

Error not_steerable(const Path& prim, const std::string& why) {
  return Error(ErrorCode::Unsupported, why).with_rule("jolt.not-steerable").with_prim(prim.str());
}

bool is_of_drive(Parameter what) {
  return what == Parameter::DriveStiffness || what == Parameter::DriveDamping ||
         what == Parameter::DriveMaxForce;
}

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

bool JoltSimulation::can(Ability ability) const { return ability != Ability::Work; }

// Every function that sets something ends here.
void JoltSimulation::set_from_outside(Input input) {
  input.step = steps_;
  log_.add(input);
  energy_bound_.note(input);
  passages_.note(input);
}

Result<void> JoltSimulation::set_drive_target(Index joint, Index drive, const DriveTarget& target) {
  TENON_CHECK(check_target(*scene_, joint, drive, target));
  const bool acts = model_.joints[joint].drives[drive].has_value() &&
                    exerts(drives_at(*scene_, joint, steering_, time())[drive]);
  if (!acts) {
    return not_steerable(scene_->joints[joint].path,
                         "the drive exerts no force on Jolt: its gains are 0, or it is disabled");
  }
  steering_.targets[{joint, drive}] = target;
  inputs_.steer_drives(joint, model_, steering_, time());
  set_from_outside(input_of(joint, drive, target));
  return {};
}

Result<void> JoltSimulation::set_joint_efforts(Index joint, std::span<const double> efforts) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_efforts(*scene_, joint, efforts, joint_state(joint).position.size()));
  steering_.efforts[joint].assign(efforts.begin(), efforts.end());
  set_from_outside(input_of(joint, efforts));
  return {};
}

Result<void> JoltSimulation::set_body_wrench(Index body, const Wrench& wrench) {
  TENON_CHECK(check_wrench(*scene_, body, wrench));
  steering_.wrenches[body] = wrench;
  set_from_outside(input_of(body, wrench));
  return {};
}

Result<void> JoltSimulation::move_kinematic(Index body, const Pose& pose) {
  TENON_CHECK(check_pose(*scene_, body, pose));
  steering_.poses[body] = {pose.position, normalized(pose.orientation)};
  set_from_outside(input_of(body, pose));
  return {};
}

Result<void> JoltSimulation::set_gravity(Index scene, const Vec3d& gravity) {
  TENON_CHECK(check_gravity(*scene_, scene, gravity));
  steering_.gravity[scene] = gravity;
  model_.systems[scene].system->SetGravity(to_jolt(gravity));
  set_from_outside(input_of(scene, gravity));
  return {};
}

Result<void> JoltSimulation::set_parameter(const ParameterKey& key, double value) {
  TENON_CHECK(check_parameter(*scene_, key, value));
  Steering before = steering_;
  steering_.parameters[key] = value;
  Result<void> done = write_parameter(key, value);
  if (!done) {
    steering_ = std::move(before);
    return done;
  }
  set_from_outside(input_of(key, value));
  return {};
}

Result<void> JoltSimulation::write_parameter(const ParameterKey& key, double value) {
  if (is_of_drive(key.what)) {
    inputs_.steer_drives(key.object, model_, steering_, time());
    return {};
  }
  if (key.what == Parameter::BodyMass) {
    scene::Body body = scene_->bodies[key.object];
    const double ratio = value / body.mass;
    body.mass = value;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        body.inertia[i][k] *= ratio;
      }
    }
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

// Into a model that knows nothing of it.
void JoltSimulation::apply_steering() {
  for (const auto& [key, value] : steering_.parameters) {
    static_cast<void>(write_parameter(key, value).has_value());  // was possible when it was set
  }
  for (const auto& [at, target] : steering_.targets) {
    inputs_.steer_drives(at.first, model_, steering_, time());
  }
  for (const auto& [scene, gravity] : steering_.gravity) {
    model_.systems[scene].system->SetGravity(to_jolt(gravity));
  }
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

Result<void> JoltSimulation::set_joint_state(Index joint, const JointState& state) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_joint_state(*scene_, joint, state, joint_state(joint).position.size()));
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
  set_from_outside(input_of(joint, state));
  return {};
}

Result<void> JoltSimulation::set_body_state(Index body, const BodyState& state) {
  TENON_CHECK(check_body_state(*scene_, body, state));
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
  set_from_outside(input_of(body, state));
  return {};
}

Result<std::vector<Contact>> JoltSimulation::contacts() const {
  if (!outputs().contacts) {
    return output_off("contacts");
  }
  return contacts_;
}

// What its term has exerted during the step.
Result<std::vector<double>> JoltSimulation::drive_efforts(Index joint) const {
  if (!outputs().efforts) {
    return output_off("efforts");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  const JointMap& map = model_.joints[joint];
  std::vector<double> efforts(map.drives.size(), 0);
  for (std::size_t d = 0; d < efforts.size(); ++d) {
    if (const std::optional<DriveAt>& at = map.drives[d]) {
      efforts[d] = map.laws[at->law]->terms[at->term].impulse / model_.time_step;
    }
  }
  return efforts;
}

Result<Wrench> JoltSimulation::joint_reaction(Index joint) const {
  if (!outputs().reactions) {
    return output_off("reactions");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return reaction_of(joint);
}

Wrench JoltSimulation::reaction_of(Index joint) const {
  Wrench reaction = read_reaction(model_, joint);
  const auto set = steering_.efforts.find(joint);
  if (set != steering_.efforts.end() && steps_ > 0 && model_.joints[joint].acts) {
    const scene::Joint& source = scene_->joints[joint];
    const Wrench effort = effort_wrench(
        source, model_.joints[joint].dofs, read_side(model_, source.body0, source.frame0).frame,
        read_side(model_, source.body1, source.frame1).frame, set->second);
    reaction.force += effort.force;
    reaction.torque += effort.torque;
  }
  return reaction;
}

Result<BodyAcceleration> JoltSimulation::body_acceleration(Index body) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_body(*scene_, body));
  if (body >= bodies_at_begin_.size()) {
    return BodyAcceleration{};
  }
  const BodyState now = body_state(body);
  const BodyState& before = bodies_at_begin_[body];
  return BodyAcceleration{(now.linear_velocity - before.linear_velocity) * (1 / time_step()),
                          (now.angular_velocity - before.angular_velocity) * (1 / time_step())};
}

Result<std::vector<double>> JoltSimulation::joint_acceleration(Index joint) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  std::vector<double> result = joint_state(joint).velocity;
  const bool known =
      joint < joints_at_begin_.size() && joints_at_begin_[joint].velocity.size() == result.size();
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = known ? (result[i] - joints_at_begin_[joint].velocity[i]) / time_step() : 0;
  }
  return result;
}

}  // namespace tenon::engines::jolt
