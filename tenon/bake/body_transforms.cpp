// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/body_transforms.h"

#include "tenon/stage/transform_at.h"

namespace tenon::bake {
namespace {

constexpr std::size_t kKeptParents = 100'000;  // matrices, 20 MB

}  // namespace

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

const Mat4d& BodyTransforms::world_of_parent(const stage::Prim& parent,
                                             const PoseRecording& recording, std::size_t frame,
                                             double code) {
  const std::pair key(parent.path().id(), frame);
  const auto known = of_parents_.find(key);
  if (known != of_parents_.end()) {
    return known->second;
  }
  if (of_parents_.size() >= kKeptParents) {
    of_parents_.clear();
  }
  return of_parents_.emplace(key, world_of_prim(parent, recording, frame, code)).first->second;
}

Mat4d BodyTransforms::local(std::size_t i, const PoseRecording& recording, std::size_t frame,
                            double code) {
  const Mat4d world = world_of_body(i, recording, frame);
  const stage::Prim& prim = placed_[i].prim;
  if (stage::local_transform(prim, code).resets_stack) {
    return world;
  }
  return world * inverse(world_of_parent(prim.parent(), recording, frame, code));
}

}  // namespace tenon::bake
