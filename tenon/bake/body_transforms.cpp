// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/body_transforms.h"

#include "tenon/stage/transform_at.h"

namespace tenon::bake {

BodyTransforms::BodyTransforms(const stage::Stage& stage, const scene::PhysicsScene& scene)
    : meters_per_unit_(scene.meters_per_unit) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    Placed placed;
    placed.prim = stage.prim(body.path);
    const Mat4d world = body.instance ? body.instance->world
                                      : stage::local_to_world(placed.prim, scene.start_time_code);
    placed.stretch = world * inverse(pose_matrix(rigid_part(world)));
    placed_.push_back(placed);
    if (!body.kinematic) {
      body_at_.emplace(body.path, i);
    }
  }
}

Mat4d BodyTransforms::world_of_body(std::size_t i, const PoseRecording& recording,
                                    std::size_t frame) const {
  Pose pose = recording.pose(frame, i);
  pose.position *= 1 / meters_per_unit_;
  return placed_[i].stretch * pose_matrix(pose);
}

Mat4d BodyTransforms::world_of_prim(const stage::Prim& prim, const PoseRecording& recording,
                                    std::size_t frame, double code) const {
  Mat4d result = Mat4d::identity();
  for (stage::Prim at = prim; at.is_valid() && !at.is_pseudo_root(); at = at.parent()) {
    const auto body = body_at_.find(at.path());
    if (body != body_at_.end()) {
      return result * world_of_body(body->second, recording, frame);
    }
    const stage::LocalTransform local = stage::local_transform(at, code);
    result = result * local.matrix;
    if (local.resets_stack) {
      break;
    }
  }
  return result;
}

Mat4d BodyTransforms::local(std::size_t i, const PoseRecording& recording, std::size_t frame,
                            double code) const {
  const Mat4d world = world_of_body(i, recording, frame);
  const stage::Prim& prim = placed_[i].prim;
  if (stage::local_transform(prim, code).resets_stack) {
    return world;
  }
  return world * inverse(world_of_prim(prim.parent(), recording, frame, code));
}

}  // namespace tenon::bake
