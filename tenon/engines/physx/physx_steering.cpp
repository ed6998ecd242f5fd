// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How values that the caller sets get into PhysX, and what joints and drives did in a step.
#include <algorithm>

#include "tenon/engines/physx/build/build.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/physx_simulation.h"
#include "tenon/engines/physx/run/drives.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

bool is_free(const Model& model, const scene::PhysicsScene& scene, Index body) {
  return !model.is_link(body) && !scene.bodies[body].kinematic;
}

}  // namespace

Result<void> PhysxSimulation::write_target(Index joint, Index drive) {
  const scene::Drive& source = scene_->joints[joint].drives[drive];
  if (model_.joints[joint].role == JointRole::None ||
      !is_driven(scene_->joints[joint], source.dof)) {
    return not_steerable(scene_->joints[joint].path,
                         "the drive exerts no force on PhysX: its gains are 0, or it is disabled");
  }
  inputs_.steer_drive(joint, model_, steering_, time());
  return {};
}

Result<void> PhysxSimulation::write_gravity() {
  const std::vector<Vec3d> gravity = steering_.gravity_of(*scene_);
  for (std::size_t s = 0; s < model_.scenes.size(); ++s) {
    model_.scenes[s]->setGravity(to_px(gravity[s]));
  }
  return {};
}

Result<void> PhysxSimulation::write_parameter(const ParameterKey& key, double value) {
  if (is_of_drive(key.what)) {
    inputs_.steer_drive(key.object, model_, steering_, time());
    return {};
  }
  if (key.what == Parameter::BodyMass) {
    set_mass(with_mass(scene_->bodies[key.object], value), *model_.bodies[key.object]);
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
  inputs_.steer_drive(key.object, model_, steering_, time());
  return {};
}

Result<void> PhysxSimulation::write_joint_state(Index joint, const JointState& state) {
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

Result<void> PhysxSimulation::write_body_state(Index body, const BodyState& state) {
  stale_ = true;
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
      return {};
    }
  }
  return not_steerable(scene_->bodies[body].path,
                       "the body hangs on a joint or is moved by the asset");
}

std::vector<double> PhysxSimulation::efforts_of_step(Index joint) const {
  return outputs_.has_step() ? outputs_.efforts(joint)
                             : std::vector<double>(scene_->joints[joint].drives.size(), 0);
}

Wrench PhysxSimulation::reaction_of_step(Index joint) const {
  return outputs_.has_step() ? outputs_.reaction(joint) : Wrench{};
}

BodyAcceleration PhysxSimulation::body_acceleration_of_step(Index body) const {
  return outputs_.body_acceleration(body, time_step());
}

std::vector<double> PhysxSimulation::joint_acceleration_of_step(Index joint) const {
  return outputs_.has_step() ? outputs_.joint_acceleration(joint, time_step())
                             : std::vector<double>(joint_state(joint).velocity.size(), 0);
}

}  // namespace tenon::engines::physx
