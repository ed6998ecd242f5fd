// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the user has set wins over samples of the asset. Forces end with the step. A kinematic body
// of Jolt moves on with the velocity that took it to its pose, so those that are not moved are
// stopped.
#include "tenon/engines/jolt/run/step_inputs.h"

#include "tenon/engines/applied_forces.h"
#include "tenon/engines/drive_values.h"
#include "tenon/engines/jolt/build/build.h"
#include "tenon/engines/jolt/convert.h"
#include "tenon/engines/jolt/run/read_state.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

/// Jolt takes the turn from an arc cosine, of which single precision leaves steps of 0.7 mrad.
void move_to(JPH::Body& body, const Pose& pose, double time_step) {
  body.MoveKinematic(to_jolt_place(pose.position), to_jolt(pose.orientation), to_jolt(time_step));
  const Quatd turn = normalized(pose.orientation) * conjugate(from_jolt(body.GetRotation()));
  body.SetAngularVelocity(to_jolt(rotation_vector(normalized(turn)) * (1 / time_step)));
}

void stop(JPH::Body* body) {
  if (body != nullptr && body->IsKinematic()) {
    body->SetLinearVelocity(JPH::Vec3::sZero());
    body->SetAngularVelocity(JPH::Vec3::sZero());
  }
}

}  // namespace

StepInputs::StepInputs(const scene::PhysicsScene& scene)
    : scene_(&scene), tracked_(joints_with_tracks(scene)) {
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].kinematic) {
      kinematics_.push_back(b);
    } else if (!scene.bodies[b].settings.forces.empty()) {
      pushed_.push_back(b);
    }
  }
}

void StepInputs::before_step(const Model& model, const Steering& steering, double now) const {
  for (const Index joint : tracked_) {
    steer_drives(joint, model, steering, now);
  }
  move_bodies(model, steering, now + model.time_step);
  push_bodies(model, steering);
  push_coordinates(model, steering);
  for (const JPH::Ref<TreeHolder>& tree : model.trees) {
    tree->prepare();
  }
  for (const JPH::Ref<CoordinateLaw>& law : model.laws) {
    law->prepare(model.time_step);
  }
}

void StepInputs::steer_drives(Index joint, const Model& model, const Steering& steering,
                              double now) const {
  const JointMap& map = model.joints[joint];
  const std::vector<scene::Drive> drives = drives_at(*scene_, joint, steering, now);
  for (Index d = 0; d < drives.size(); ++d) {
    if (const std::optional<DriveAt>& at = map.drives[d]) {
      write_drive(drives[d], map.laws[at->law]->terms[at->term]);
    }
  }
}

void StepInputs::move_bodies(const Model& model, const Steering& steering, double at) const {
  for (const Index body : kinematics_) {
    stop(model.bodies[body]);
  }
  for (const scene::PoseTrack& track : scene_->pose_tracks) {
    if (track.times.empty()) {
      continue;
    }
    if (track.body.has_value() && scene_->bodies[*track.body].kinematic &&
        !steering.poses.contains(*track.body)) {
      move_to(*model.bodies[*track.body], track.at(at), model.time_step);
    } else if (track.collider.has_value() && model.static_bodies[*track.collider] != nullptr) {
      move_to(*model.static_bodies[*track.collider], track.at(at), model.time_step);
    }
  }
  for (const auto& [body, pose] : steering.poses) {
    move_to(*model.bodies[body], pose, model.time_step);
  }
}

void StepInputs::push(const Model& model, Index body, const Wrench& wrench) const {
  JPH::Body& made = *model.bodies[body];
  if (!made.IsDynamic()) {
    return;
  }
  if (!made.IsActive()) {
    model.systems[scene_->bodies[body].scene].system->GetBodyInterfaceNoLock().ActivateBody(
        made.GetID());
  }
  made.AddForce(to_jolt(wrench.force));
  made.AddTorque(to_jolt(wrench.torque));
}

void StepInputs::push_bodies(const Model& model, const Steering& steering) const {
  for (const Index b : pushed_) {
    push(model, b, constant_wrench(scene_->bodies[b], pose_of(*model.bodies[b])));
  }
  for (const auto& [body, wrench] : steering.wrenches) {
    push(model, body, wrench);
  }
}

void StepInputs::push_coordinates(const Model& model, const Steering& steering) const {
  for (const auto& [joint, efforts] : steering.efforts) {
    const scene::Joint& source = scene_->joints[joint];
    if (!model.joints[joint].acts || efforts.empty()) {
      continue;
    }
    const JointSide side0 = read_side(model, source.body0, source.frame0);
    const JointSide side1 = read_side(model, source.body1, source.frame1);
    const Wrench wrench =
        effort_wrench(source, model.joints[joint].dofs, side0.frame, side1.frame, efforts);
    const auto act = [&](const std::optional<Index>& body, double sign) {
      if (body.has_value()) {
        const Vec3d arm = side1.frame.position - read_center_of_mass(model, *body);
        push(model, *body,
             {wrench.force * sign, (wrench.torque + cross(arm, wrench.force)) * sign});
      }
    };
    act(source.body1, 1);
    act(source.body0, -1);
  }
}

}  // namespace tenon::engines::jolt
