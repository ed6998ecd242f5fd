// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Values that the caller sets are checked, written into the model and remembered, so that a rebuilt
// model gets them again. Values of the model itself (parameters, gravity) go into a copy of its own
// where others step the same one. A kinematic body that nothing moves is a part of the world in
// MuJoCo: the first pose that is set rebuilds the model, with the body as one that is driven.
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/mujoco_simulation.h"
#include "tenon/engines/mujoco/run/carry_over.h"
#include "tenon/engines/mujoco/run/control.h"
#include "tenon/engines/scene_timeline.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

bool is_of_drive(Parameter what) {
  return what == Parameter::DriveStiffness || what == Parameter::DriveDamping ||
         what == Parameter::DriveMaxForce;
}

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

bool MujocoSimulation::can(Ability /*ability*/) const { return true; }

EngineObjects MujocoSimulation::engine_objects() const {
  return {"mujoco", mj_versionString(), model_.model.get(), model_.data.get()};
}

Result<void> MujocoSimulation::set_drive_target(Index joint, Index drive,
                                                const DriveTarget& target) {
  TENON_CHECK(check_target(*scene_, joint, drive, target));
  TENON_TRY(const std::size_t at, drive_of(model_, *scene_, joint, drive));
  inputs_.set_target(at, target, model_);
  steering_.targets[{joint, drive}] = target;
  return {};
}

Result<void> MujocoSimulation::set_joint_efforts(Index joint, std::span<const double> efforts) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_efforts(*scene_, joint, efforts, joint_state(joint).position.size()));
  steering_.efforts[joint].assign(efforts.begin(), efforts.end());
  return {};
}

Result<void> MujocoSimulation::set_body_wrench(Index body, const Wrench& wrench) {
  TENON_CHECK(check_wrench(*scene_, body, wrench));
  steering_.wrenches[body] = wrench;
  return write_gravities();
}

Result<void> MujocoSimulation::set_gravity(Index scene, const Vec3d& gravity) {
  TENON_CHECK(check_gravity(*scene_, scene, gravity));
  return change([&] {
    steering_.gravity[scene] = gravity;
    return write_gravities();
  });
}

Result<void> MujocoSimulation::move_kinematic(Index body, const Pose& pose) {
  TENON_CHECK(check_pose(*scene_, body, pose));
  const Pose wanted{pose.position, normalized(pose.orientation)};
  steering_.poses[body] = wanted;
  return inputs_.set_pose(body, wanted) ? Result<void>() : drive_body(body);
}

Result<void> MujocoSimulation::drive_body(Index body) {
  if (timeline_ == nullptr) {
    timeline_ = timeline_of(*start_->scene);
    scene_ = &timeline_->scene();
  }
  timeline_->hold_pose(body);
  return rebuild({time(), advanced_to_, {}, {body}, {}});
}

Result<void> MujocoSimulation::set_parameter(const ParameterKey& key, double value) {
  TENON_CHECK(check_parameter(*scene_, key, value));
  return change([&]() -> Result<void> {
    TENON_CHECK(apply_parameter(key, value));
    energy_watch_.restart();
    steering_.parameters[key] = value;
    return {};
  });
}

Result<void> MujocoSimulation::apply_parameter(const ParameterKey& key, double value) {
  if (is_of_drive(key.what)) {
    TENON_TRY(const std::size_t at, drive_of(model_, *scene_, key.object, key.part));
    inputs_.set_gain(at, key.what, value, model_);
    return {};
  }
  TENON_CHECK(write_parameter(*scene_, key, value, model_));
  return key.what == Parameter::BodyMass ? write_gravities() : Result<void>();
}

// Into a model that knows nothing of it. What no longer exists there stays remembered.
Result<void> MujocoSimulation::apply_steering() {
  if (steering_.empty()) {
    return {};
  }
  for (const auto& [key, value] : steering_.parameters) {
    if (Result<void> done = apply_parameter(key, value);
        !done && done.error().code() != ErrorCode::Unsupported) {
      return done;
    }
  }
  for (const auto& [at, target] : steering_.targets) {
    const int drive = find_drive(model_, at.first, at.second);
    if (drive >= 0) {
      inputs_.set_target(static_cast<std::size_t>(drive), target, model_);
    }
  }
  for (const auto& [body, pose] : steering_.poses) {
    inputs_.set_pose(body, pose);
  }
  return write_gravities();
}

Result<void> MujocoSimulation::set_joint_state(Index joint, const JointState& state) {
  TENON_CHECK(check_joint(*scene_, joint));
  TENON_CHECK(check_joint_state(*scene_, joint, state, joint_state(joint).position.size()));
  return change([&] {
    stale_ = true;
    energy_watch_.restart();
    return write_joint_state(*scene_, joint, state, model_);
  });
}

Result<void> MujocoSimulation::set_body_state(Index body, const BodyState& state) {
  TENON_CHECK(check_body_state(*scene_, body, state));
  return change([&] {
    stale_ = true;
    energy_watch_.restart();
    return write_body_state(*scene_, body, state, model_);
  });
}

Result<std::vector<Contact>> MujocoSimulation::contacts() const {
  if (!outputs().contacts) {
    return output_off("contacts");
  }
  return outputs_->contacts;
}

Result<std::vector<double>> MujocoSimulation::drive_efforts(Index joint) const {
  if (!outputs().efforts) {
    return output_off("efforts");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  std::vector<double> result(scene_->joints[joint].drives.size(), 0);
  for (std::size_t i = 0; i < model_.drives.size() && i < outputs_->drive_efforts.size(); ++i) {
    if (model_.drives[i].joint == joint) {
      result[model_.drives[i].drive] = outputs_->drive_efforts[i];
    }
  }
  return result;
}

Result<Wrench> MujocoSimulation::joint_reaction(Index joint) const {
  if (!outputs().reactions) {
    return output_off("reactions");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  return joint < outputs_->reactions.size() ? outputs_->reactions[joint] : Wrench{};
}

Result<BodyAcceleration> MujocoSimulation::body_acceleration(Index body) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_body(*scene_, body));
  return body < outputs_->bodies.size() ? outputs_->bodies[body] : BodyAcceleration{};
}

Result<std::vector<double>> MujocoSimulation::joint_acceleration(Index joint) const {
  if (!outputs().accelerations) {
    return output_off("accelerations");
  }
  TENON_CHECK(check_joint(*scene_, joint));
  std::vector<double> result = joint_state(joint).velocity;
  const bool known = joint < outputs_->joints_at_begin.size() &&
                     outputs_->joints_at_begin[joint].velocity.size() == result.size();
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] =
        known ? (result[i] - outputs_->joints_at_begin[joint].velocity[i]) / time_step() : 0;
  }
  return result;
}

Result<Work> MujocoSimulation::work() const {
  if (!outputs().work) {
    return output_off("work");
  }
  return outputs_->work;
}

}  // namespace tenon::engines::mujoco
