// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Values that the caller sets are checked, given to PhysX and remembered, so that a rebuilt model
// gets them again.
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

bool PhysxSimulation::can(Ability /*ability*/) const { return true; }

double PhysxSimulation::energy_to_compare() const { return outputs().work ? energy().total() : 0; }

// Every function that sets something ends here.
void PhysxSimulation::set_from_outside(Input input, double energy_before) {
  input.step = steps_;
  log_.add(input);
  energy_bound_.note(input);
  passages_.note(input);
  outputs_.add_change(energy_to_compare() - energy_before);
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
  set_from_outside(input_of(joint, drive, target), energy_to_compare());
  return {};
}

Result<void> PhysxSimulation::set_joint_efforts(Index joint, std::span<const double> efforts) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_efforts(*scene_, joint, efforts, joint_state(joint).position.size()));
  steering_.efforts[joint].assign(efforts.begin(), efforts.end());
  set_from_outside(input_of(joint, efforts), energy_to_compare());
  return {};
}

Result<void> PhysxSimulation::set_body_wrench(Index body, const Wrench& wrench) {
  TENON_CHECK(check_wrench(*scene_, body, wrench));
  steering_.wrenches[body] = wrench;
  set_from_outside(input_of(body, wrench), energy_to_compare());
  return {};
}

Result<void> PhysxSimulation::move_kinematic(Index body, const Pose& pose) {
  TENON_CHECK(check_pose(*scene_, body, pose));
  steering_.poses[body] = {pose.position, normalized(pose.orientation)};
  set_from_outside(input_of(body, pose), energy_to_compare());
  return {};
}

Result<void> PhysxSimulation::set_gravity(Index scene, const Vec3d& gravity) {
  TENON_CHECK(check_gravity(*scene_, scene, gravity));
  const double before = energy_to_compare();
  steering_.gravity[scene] = gravity;
  model_.scenes[scene]->setGravity(to_px(gravity));
  set_from_outside(input_of(scene, gravity), before);
  return {};
}

Result<void> PhysxSimulation::set_parameter(const ParameterKey& key, double value) {
  TENON_CHECK(check_parameter(*scene_, key, value));
  const double energy_before = energy_to_compare();
  Steering before = steering_;
  steering_.parameters[key] = value;
  Result<void> done = write_parameter(key, value);
  if (!done) {
    steering_ = std::move(before);
    return done;
  }
  set_from_outside(input_of(key, value), energy_before);
  return {};
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
  if (key.what == Parameter::ColliderFriction) {
    return set_friction(*scene_, key.object, value, model_)
               ? Result<void>()
               : not_steerable(scene_->colliders[key.object].path, "PhysX has no such shape");
  }
  return write_joint_parameter(key);
}

Result<void> PhysxSimulation::write_joint_parameter(const ParameterKey& key) {
  JointMap& map = model_.joints[key.object];
  const scene::Joint joint = inputs_.joint_now(key.object, steering_, time());
  const auto refused = [&](const std::string& why) {
    return not_steerable(joint.path,
                         std::string(parameter_name(key.what)) + " acts on PhysX " + why);
  };
  const bool coordinate = map.role == JointRole::Reduced && map.dofs.free.size() == 1;
  if (key.what == Parameter::JointArmature) {
    if (!coordinate) {
      return refused("on coordinates of articulations only");
    }
    map.link_joint->setArmature(map.axis, to_px(joint.armature));
    return {};
  }
  const bool driven = std::any_of(joint.drives.begin(), joint.drives.end(),
                                  [&](const auto& drive) { return is_driven(joint, drive.dof); });
  if (key.what == Parameter::JointFriction && (driven || has_spring(joint))) {
    return refused("where the joint has neither drive nor spring");
  }
  if (!coordinate && (map.d6 == nullptr || driven)) {
    return refused("on coordinates of articulations, and on joints without a drive");
  }
  std::erase_if(model_.passive,
                [&](const PassiveForce& passive) { return passive.joint == key.object; });
  if (const auto passive = passive_force(joint, key.object, map)) {
    model_.passive.push_back(*passive);
  }
  inputs_.steer_drive(key.object, model_, steering_, time());
  return {};
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
  const double before = energy_to_compare();
  map.link_joint->setJointPosition(map.axis, to_px(state.position.front()));
  map.link_joint->setJointVelocity(map.axis, to_px(state.velocity.front()));
  model_.trees[map.tree].articulation->updateKinematic(px::PxArticulationKinematicFlag::ePOSITION |
                                                       px::PxArticulationKinematicFlag::eVELOCITY);
  stale_ = true;
  set_from_outside(input_of(joint, state), before);
  return {};
}

Result<void> PhysxSimulation::set_body_state(Index body, const BodyState& state) {
  TENON_CHECK(check_body_state(*scene_, body, state));
  const double before = energy_to_compare();
  const auto done = [&] {
    stale_ = true;
    set_from_outside(input_of(body, state), before);
    return Result<void>();
  };
  if (is_free(model_, *scene_, body)) {
    auto& actor = static_cast<px::PxRigidDynamic&>(*model_.bodies[body]);
    actor.setGlobalPose(to_px(state.pose));
    actor.setLinearVelocity(to_px(state.linear_velocity));
    actor.setAngularVelocity(to_px(state.angular_velocity));
    return done();
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
      return done();
    }
  }
  return not_steerable(scene_->bodies[body].path,
                       "the body hangs on a joint or is moved by the asset");
}

}  // namespace tenon::engines::physx
