// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is set is checked, given to PhysX and remembered, so that a model that is made anew gets it
// again.
#include <algorithm>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/physx_simulation.h"
#include "tenon/engines/physx/run/drives.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

Error not_steerable(const Path& prim, const std::string& why) {
  return Error(ErrorCode::Unsupported, why).with_rule("physx.not-steerable").with_prim(prim.str());
}

bool is_of_drive(Parameter what) {
  return what == Parameter::DriveStiffness || what == Parameter::DriveDamping ||
         what == Parameter::DriveMaxForce;
}

bool is_free(const Model& model, const scene::PhysicsScene& scene, Index body) {
  return !model.is_link(body) && !scene.bodies[body].kinematic;
}

}  // namespace

bool PhysxSimulation::can(Ability ability) const {
  switch (ability) {
    case Ability::SavedStates:
    case Ability::JointReactions:
    case Ability::Work:
      return false;
    default:
      return true;
  }
}

Result<void> PhysxSimulation::set_drive_target(Index joint, Index drive,
                                               const DriveTarget& target) {
  TENON_CHECK(check_target(*scene_, joint, drive, target));
  const scene::Drive& source = scene_->joints[joint].drives[drive];
  if (model_.joints[joint].role == JointRole::None ||
      !is_driven(scene_->joints[joint], source.dof)) {
    return not_steerable(scene_->joints[joint].path,
                         "the drive exerts no force on PhysX: its gains are 0, or it is disabled");
  }
  steering_.targets[{joint, drive}] = target;
  inputs_.steer_drive(joint, model_, steering_, time());
  return {};
}

Result<void> PhysxSimulation::set_joint_efforts(Index joint, std::span<const double> efforts) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_efforts(*scene_, joint, efforts, joint_state(joint).position.size()));
  steering_.efforts[joint].assign(efforts.begin(), efforts.end());
  return {};
}

Result<void> PhysxSimulation::set_body_wrench(Index body, const Wrench& wrench) {
  TENON_CHECK(check_wrench(*scene_, body, wrench));
  steering_.wrenches[body] = wrench;
  return {};
}

Result<void> PhysxSimulation::move_kinematic(Index body, const Pose& pose) {
  TENON_CHECK(check_pose(*scene_, body, pose));
  steering_.poses[body] = {pose.position, normalized(pose.orientation)};
  return {};
}

Result<void> PhysxSimulation::set_gravity(Index scene, const Vec3d& gravity) {
  TENON_CHECK(check_gravity(*scene_, scene, gravity));
  steering_.gravity[scene] = gravity;
  model_.scenes[scene]->setGravity(to_px(gravity));
  return {};
}

Result<void> PhysxSimulation::set_parameter(const ParameterKey& key, double value) {
  TENON_CHECK(check_parameter(*scene_, key, value));
  Steering before = steering_;
  steering_.parameters[key] = value;
  Result<void> done = write_parameter(key, value);
  if (!done) {
    steering_ = std::move(before);
  }
  return done;
}

Result<void> PhysxSimulation::write_parameter(const ParameterKey& key, double value) {
  if (is_of_drive(key.what)) {
    inputs_.steer_drive(key.object, model_, steering_, time());
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
    set_mass(body, *model_.bodies[key.object]);
    return {};
  }
  const JointMap* map =
      key.what == Parameter::ColliderFriction ? nullptr : &model_.joints[key.object];
  if (key.what == Parameter::JointArmature && map->role == JointRole::Reduced &&
      map->dofs.free.size() == 1) {
    map->link_joint->setArmature(map->axis, to_px(value));
    return {};
  }
  return not_steerable({}, std::string(parameter_name(key.what)) +
                               " cannot be changed on PhysX while the simulation runs");
}

// Into a model that knows nothing of it.
void PhysxSimulation::apply_steering() {
  for (const auto& [key, value] : steering_.parameters) {
    static_cast<void>(write_parameter(key, value).has_value());  // was possible when it was set
  }
  for (const auto& [at, target] : steering_.targets) {
    inputs_.steer_drive(at.first, model_, steering_, time());
  }
  for (const auto& [scene, gravity] : steering_.gravity) {
    model_.scenes[scene]->setGravity(to_px(gravity));
  }
}

Result<void> PhysxSimulation::set_joint_state(Index joint, const JointState& state) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_joint_state(*scene_, joint, state, joint_state(joint).position.size()));
  const JointMap& map = model_.joints[joint];
  if (map.role != JointRole::Reduced || map.dofs.free.size() != 1) {
    return not_steerable(scene_->joints[joint].path,
                         "only joints of articulations with one axis have a state on PhysX");
  }
  map.link_joint->setJointPosition(map.axis, to_px(state.position.front()));
  map.link_joint->setJointVelocity(map.axis, to_px(state.velocity.front()));
  model_.trees[map.tree].articulation->updateKinematic(px::PxArticulationKinematicFlag::ePOSITION |
                                                       px::PxArticulationKinematicFlag::eVELOCITY);
  stale_ = true;
  return {};
}

Result<void> PhysxSimulation::set_body_state(Index body, const BodyState& state) {
  TENON_CHECK(check_body_state(*scene_, body, state));
  if (is_free(model_, *scene_, body)) {
    auto& actor = static_cast<px::PxRigidDynamic&>(*model_.bodies[body]);
    actor.setGlobalPose(to_px(state.pose));
    actor.setLinearVelocity(to_px(state.linear_velocity));
    actor.setAngularVelocity(to_px(state.angular_velocity));
    return {};
  }
  for (const ReducedTree& tree : model_.trees) {
    px::PxArticulationLink* root = nullptr;
    tree.articulation->getLinks(&root, 1);
    const bool fixed =
        tree.articulation->getArticulationFlags() & px::PxArticulationFlag::eFIX_BASE;
    if (root == model_.bodies[body] && !fixed) {
      tree.articulation->setRootGlobalPose(to_px(state.pose));
      tree.articulation->setRootLinearVelocity(to_px(state.linear_velocity));
      tree.articulation->setRootAngularVelocity(to_px(state.angular_velocity));
      stale_ = true;
      return {};
    }
  }
  return not_steerable(scene_->bodies[body].path,
                       "the body hangs on a joint or is moved by the asset");
}

Result<std::vector<Contact>> PhysxSimulation::contacts() const {
  if (!outputs().contacts) {
    return output_off("contacts");
  }
  return contacts_;
}

// What the law gives at the end of the step, as PhysX takes drives there.
Result<std::vector<double>> PhysxSimulation::drive_efforts(Index joint) const {
  if (!outputs().efforts) {
    return output_off("efforts");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  const scene::Joint& source = scene_->joints[joint];
  const JointState state = joint_state(joint);
  const scene::JointDofs& dofs = model_.joints[joint].dofs;
  std::vector<double> efforts(source.drives.size(), 0);
  for (Index d = 0; d < source.drives.size() && steps_ > 0; ++d) {
    for (std::size_t i = 0; i < dofs.free.size() && i < state.position.size(); ++i) {
      if (dofs.free[i].dof != source.drives[d].dof) {
        continue;
      }
      scene::Drive drive = inputs_.drive_now(joint, d, steering_, time());
      const double force = drive.stiffness * (drive.target_position - state.position[i]) +
                           drive.damping * (drive.target_velocity - state.velocity[i]);
      efforts[d] = std::clamp(force, -drive.max_force, drive.max_force);
    }
  }
  return efforts;
}

Result<BodyAcceleration> PhysxSimulation::body_acceleration(Index body) const {
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

Result<std::vector<double>> PhysxSimulation::joint_acceleration(Index joint) const {
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

}  // namespace tenon::engines::physx
