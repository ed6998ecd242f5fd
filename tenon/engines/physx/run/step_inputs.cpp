// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the user has set wins over samples of the asset. Forces on bodies end with the step, those
// on coordinates stay until others are set, so they are set to 0 once nothing pushes any more.
#include "tenon/engines/physx/run/step_inputs.h"

#include <algorithm>

#include "tenon/engines/applied_forces.h"
#include "tenon/engines/drive_values.h"
#include "tenon/engines/physx/convert.h"
#include "tenon/engines/physx/run/drives.h"
#include "tenon/engines/physx/run/read_state.h"

namespace tenon::engines::physx {
namespace {

using scene::Index;

/// PhysX's own pull is not that of the body: gravity that is scaled, or along an axis that is
/// locked, which PhysX holds against contacts alone.
bool has_own_gravity(const scene::Body& body) {
  const bool scaled = body.gravity_scale != 1;
  return body.gravity_scale != 0 && (scaled || body.settings.locked_translation != 0);
}

/// What the body is pulled by beside PhysX's gravity [m/s^2]; `locked` axes as a mask.
Vec3d missing_gravity(const scene::Body& body, const Vec3d& gravity, int locked) {
  Vec3d wanted = gravity * body.gravity_scale;
  for (std::size_t i = 0; i < 3; ++i) {
    wanted[i] = (locked >> i & 1) != 0 ? 0 : wanted[i];
  }
  return wanted - gravity;
}

void write_steering(const Steering& steering, Index joint, scene::Joint& source) {
  const auto set = [&](Parameter what, double& number) {
    const auto found = steering.parameters.find({what, joint, 0});
    number = found == steering.parameters.end() ? number : found->second;
  };
  set(Parameter::JointDamping, source.damping);
  set(Parameter::JointFriction, source.friction);
  set(Parameter::JointArmature, source.armature);
}

}  // namespace

StepInputs::StepInputs(const scene::PhysicsScene& scene)
    : scene_(&scene),
      tracked_(joints_with_tracks(scene)),
      applied_(scene.bodies.size()),
      joint_pushes_(scene.joints.size()) {
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (!body.kinematic && (has_own_gravity(body) || !body.settings.forces.empty())) {
      pushed_.push_back(b);
    }
  }
}

void StepInputs::before_step(Model& model, const Steering& steering, double now) {
  if (has_pushes_) {
    std::fill(applied_.begin(), applied_.end(), Wrench{});
    std::fill(joint_pushes_.begin(), joint_pushes_.end(), Wrench{});
    has_pushes_ = false;
  }
  follow_drive_tracks(model, steering, now);
  move_bodies(model, steering, now + model.time_step);
  push_bodies(model, steering);
  push_coordinates(model, steering);
  if (!model.couplings.empty() || !model.tendons.empty()) {
    read_caches(model);
    tendons_.update(*scene_, model);
    for (Coupling* coupling : model.couplings) {
      coupling->update(model);
    }
  }
}

scene::Joint StepInputs::joint_now(Index joint, const Steering& steering, double now) const {
  scene::Joint source = scene_->joints[joint];
  source.drives = drives_at(*scene_, joint, steering, now);
  write_steering(steering, joint, source);
  return source;
}

scene::Drive StepInputs::drive_now(Index joint, Index drive, const Steering& steering,
                                   double now) const {
  return joint_now(joint, steering, now).drives[drive];
}

void StepInputs::steer_drive(Index joint, Model& model, const Steering& steering, double now) {
  write_drives(joint_now(joint, steering, now), model.joints[joint], model.time_step);
}

void StepInputs::follow_drive_tracks(Model& model, const Steering& steering, double now) {
  for (const Index joint : tracked_) {
    steer_drive(joint, model, steering, now);
  }
}

void StepInputs::move_bodies(const Model& model, const Steering& steering, double at) const {
  const auto move = [](px::PxRigidActor* actor, const Pose& pose) {
    static_cast<px::PxRigidDynamic*>(actor)->setKinematicTarget(to_px(pose));
  };
  for (const scene::PoseTrack& track : scene_->pose_tracks) {
    if (track.times.empty()) {
      continue;
    }
    if (track.body.has_value() && scene_->bodies[*track.body].kinematic &&
        !steering.poses.contains(*track.body)) {
      move(model.bodies[*track.body], track.at(at));
    } else if (track.collider.has_value() && model.static_actors[*track.collider] != nullptr) {
      move(model.static_actors[*track.collider], track.at(at));
    }
  }
  for (const auto& [body, pose] : steering.poses) {
    move(model.bodies[body], pose);
  }
}

void StepInputs::push(const Model& model, Index body, const Wrench& wrench) const {
  model.bodies[body]->addForce(to_px(wrench.force));
  model.bodies[body]->addTorque(to_px(wrench.torque));
}

void StepInputs::apply(const Model& model, Index body, const Wrench& wrench) {
  push(model, body, wrench);
  applied_[body].force += wrench.force;
  applied_[body].torque += wrench.torque;
  has_pushes_ = true;
}

void StepInputs::push_bodies(const Model& model, const Steering& steering) {
  for (const Index b : pushed_) {
    const scene::Body& body = scene_->bodies[b];
    if (!body.settings.forces.empty()) {
      apply(model, b, constant_wrench(body, from_px(model.bodies[b]->getGlobalPose())));
    }
    if (has_own_gravity(body)) {
      const Vec3d gravity = from_px(model.scenes[body.scene]->getGravity());
      const double mass = model.bodies[b]->getMass();
      const int locked =
          model.is_link(b) ? 0 : body.settings.locked_translation;  // as PhysX has it
      push(model, b, {missing_gravity(body, gravity, locked) * mass, {}});
    }
  }
  for (const auto& [body, wrench] : steering.wrenches) {
    if (!scene_->bodies[body].kinematic) {
      apply(model, body, wrench);
    }
  }
}

void StepInputs::push_constraint(const Model& model, Index joint,
                                 const std::vector<double>& efforts) {
  const scene::Joint& source = scene_->joints[joint];
  const auto frame = [&](const std::optional<Index>& body, const Pose& local) {
    return body ? from_px(model.bodies[*body]->getGlobalPose()) * local : local;
  };
  const Pose frame0 = frame(source.body0, source.frame0);
  const Pose frame1 = frame(source.body1, source.frame1);
  const Wrench wrench = effort_wrench(source, model.joints[joint].dofs, frame0, frame1, efforts);
  const auto act = [&](const std::optional<Index>& body, double sign) {
    if (scene_->is_dynamic(body)) {
      const Vec3d arm = frame1.position - read_center_of_mass(model, *body);
      push(model, *body, {wrench.force * sign, (wrench.torque + cross(arm, wrench.force)) * sign});
    }
  };
  act(source.body1, 1);
  act(source.body0, -1);
  joint_pushes_[joint] = wrench;
  has_pushes_ = true;
}

void StepInputs::push_coordinates(Model& model, const Steering& steering) {
  const bool pushes = !steering.efforts.empty() ||
                      std::any_of(model.joints.begin(), model.joints.end(),
                                  [](const JointMap& map) { return map.beside.has_value(); });
  if (!pushes && !has_forces_) {
    return;
  }
  has_forces_ = pushes;
  read_caches(model);
  for (const ReducedTree& tree : model.trees) {
    std::fill_n(tree.cache->jointForce, tree.articulation->getDofs(), 0.0F);
  }
  for (Index j = 0; j < model.joints.size(); ++j) {
    JointMap& map = model.joints[j];
    if (map.beside) {
      const auto given = steering.efforts.find(j);
      const double effort =
          given != steering.efforts.end() && !given->second.empty() ? given->second.front() : 0;
      model.trees[map.tree].cache->jointForce[map.coordinate] +=
          to_px(prepare_spring(map, read_joint_state(*scene_, model, j), effort, model.time_step));
    }
  }
  for (const auto& [joint, efforts] : steering.efforts) {
    const JointMap& map = model.joints[joint];
    if (map.role == JointRole::Reduced && map.dofs.free.size() == 1) {
      model.trees[map.tree].cache->jointForce[map.coordinate] += to_px(efforts.front());
    } else if (map.role != JointRole::None && !efforts.empty()) {
      push_constraint(model, joint, efforts);
    }
  }
  for (const ReducedTree& tree : model.trees) {
    tree.articulation->applyCache(*tree.cache, px::PxArticulationCacheFlag::eFORCE);
  }
}

}  // namespace tenon::engines::physx
