// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How values that the caller sets get into MuJoCo, and what joints and drives did in a step. Values
// of the model itself (parameters, gravity) go into a copy of its own where others step the same
// one. A kinematic body that nothing moves is a part of the world in MuJoCo: the first pose that is
// set rebuilds the model, with the body as one that is driven.
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/engines/mujoco/run/control.h"
#include "tenon/engines/scene_timeline.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

Result<std::size_t> drive_of(const Model& model, const scene::PhysicsScene& scene, Index joint,
                             Index drive) {
  const int found = find_drive(model, joint, drive);
  if (found < 0) {
    return Error(ErrorCode::Unsupported,
                 "the drive exerts no force on MuJoCo: its gains are 0, or its axis is locked")
        .with_rule("mujoco.not-steerable")
        .with_prim(scene.joints[joint].path.str())
        .with_fix("give the drive a stiffness or a damping");
  }
  return static_cast<std::size_t>(found);
}

}  // namespace

EngineObjects MujocoSimulation::engine_objects() const {
  return {"mujoco", mj_versionString(), model_.model.get(), model_.data.get()};
}

Result<void> MujocoSimulation::write_target(Index joint, Index drive) {
  TENON_TRY(const std::size_t at, drive_of(model_, *scene_, joint, drive));
  inputs_.set_target(at, steering_.targets.at({joint, drive}), model_);
  return {};
}

Result<void> MujocoSimulation::write_pose(Index body) {
  if (inputs_.set_pose(body, steering_.poses.at(body))) {
    return {};
  }
  if (timeline_ == nullptr) {
    timeline_ = timeline_of(*start_->scene);
    scene_ = &timeline_->scene();
  }
  timeline_->hold_pose(body);
  return rebuild({time(), advanced_to_, {}, {body}, {}});
}

Result<void> MujocoSimulation::write_parameter(const ParameterKey& key, double value) {
  stale_ = true;
  if (is_of_drive(key.what)) {
    TENON_TRY(const std::size_t at, drive_of(model_, *scene_, key.object, key.part));
    inputs_.set_gain(at, key.what, value, model_);
    return {};
  }
  TENON_CHECK(mujoco::write_parameter(*scene_, key, value, model_));
  return key.what == Parameter::BodyMass ? write_gravity() : Result<void>();
}

Result<void> MujocoSimulation::apply_steering() {
  if (steering_.empty()) {
    return {};
  }
  TENON_CHECK(write_steering());
  for (const auto& [body, pose] : steering_.poses) {
    inputs_.set_pose(body, pose);
  }
  return write_gravity();
}

Result<void> MujocoSimulation::write_joint_state(Index joint, const JointState& state) {
  stale_ = true;
  return mujoco::write_joint_state(*scene_, joint, state, model_);
}

Result<void> MujocoSimulation::write_body_state(Index body, const BodyState& state) {
  stale_ = true;
  return mujoco::write_body_state(*scene_, body, state, model_);
}

// Energy that came with it has another source than steps.
void MujocoSimulation::note(const Input& input) {
  if (input.kind == InputKind::Parameters || input.kind == InputKind::JointStates ||
      input.kind == InputKind::BodyStates) {
    energy_watch_.restart();
  }
}

std::vector<double> MujocoSimulation::efforts_of_step(Index joint) const {
  std::vector<double> result(scene_->joints[joint].drives.size(), 0);
  for (std::size_t i = 0; i < model_.drives.size() && i < outputs_->drive_efforts.size(); ++i) {
    if (model_.drives[i].joint == joint) {
      result[model_.drives[i].drive] = outputs_->drive_efforts[i];
    }
  }
  return result;
}

Wrench MujocoSimulation::reaction_of_step(Index joint) const {
  return joint < outputs_->reactions.size() ? outputs_->reactions[joint] : Wrench{};
}

BodyAcceleration MujocoSimulation::body_acceleration_of_step(Index body) const {
  return body < outputs_->bodies.size() ? outputs_->bodies[body] : BodyAcceleration{};
}

std::vector<double> MujocoSimulation::joint_acceleration_of_step(Index joint) const {
  return mean_acceleration(outputs_->joints_at_begin, joint, joint_state(joint), time_step());
}

}  // namespace tenon::engines::mujoco
