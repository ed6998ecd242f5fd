// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/timeline/object_states.h"

#include <algorithm>

namespace tenon::scene {
namespace {

bool has_pose_track(const PhysicsScene& scene, Index collider) {
  return std::any_of(scene.pose_tracks.begin(), scene.pose_tracks.end(),
                     [&](const PoseTrack& track) { return track.collider == collider; });
}

bool has_side_track(const PhysicsScene& scene, Index joint, int side) {
  return std::any_of(
      scene.pose_tracks.begin(), scene.pose_tracks.end(),
      [&](const PoseTrack& track) { return track.joint == joint && track.side == side; });
}

double Drive::* number_of(Animated what) {
  switch (what) {
    case Animated::DriveTargetPosition:
      return &Drive::target_position;
    case Animated::DriveTargetVelocity:
      return &Drive::target_velocity;
    case Animated::DriveStiffness:
      return &Drive::stiffness;
    case Animated::DriveDamping:
      return &Drive::damping;
    case Animated::DriveMaxForce:
      break;
  }
  return &Drive::max_force;
}

// Where the side hangs on another body than in the state, the frame is of that one.
void keep_side(const PhysicsScene& scene, Index joint, int side, const Joint& now, Joint& next) {
  const std::optional<Index>& body = side == 0 ? now.body0 : now.body1;
  std::optional<Index>& next_body = side == 0 ? next.body0 : next.body1;
  if (body != next_body || has_side_track(scene, joint, side)) {
    (side == 0 ? next.frame0 : next.frame1) = side == 0 ? now.frame0 : now.frame1;
  }
  next_body = body;
}

}  // namespace

const ShapesTrack* shapes_track_of(const PhysicsScene& scene, Index body) {
  const auto found = std::find_if(scene.shapes_tracks.begin(), scene.shapes_tracks.end(),
                                  [&](const ShapesTrack& track) { return track.body == body; });
  return found == scene.shapes_tracks.end() ? nullptr : &*found;
}

void keep_followed(const PhysicsScene&, Index, const Scene& now, Scene& next) {
  next.gravity = now.gravity;
  next.time_step = now.time_step;
}

void keep_followed(const PhysicsScene& scene, Index object, const Body& now, Body& next) {
  next.kinematic = now.kinematic;
  next.enabled = now.enabled;
  next.starts_asleep = now.starts_asleep;
  next.scene = now.scene;
  next.pose = now.pose;
  next.linear_velocity = now.linear_velocity;
  next.angular_velocity = now.angular_velocity;
  next.instance = now.instance;
  // What is merged into a body weighs there.
  if (shapes_track_of(scene, object) != nullptr || !scene.nesting_states.empty()) {
    next.mass = now.mass;
    next.center_of_mass = now.center_of_mass;
    next.inertia = now.inertia;
  }
}

void keep_followed(const PhysicsScene& scene, Index object, const Collider& now, Collider& next) {
  const ShapesTrack* shapes = now.body ? shapes_track_of(scene, *now.body) : nullptr;
  const bool moves = shapes != nullptr &&
                     std::binary_search(shapes->colliders.begin(), shapes->colliders.end(), object);
  if (moves || now.body != next.body || has_pose_track(scene, object)) {
    next.pose = now.pose;
  }
  if (moves) {
    next.shape = now.shape;
    next.face_materials = now.face_materials;
  }
  next.body = now.body;
  next.scene = now.scene;
  next.material = now.material;
  next.enabled = now.enabled;
}

void keep_followed(const PhysicsScene& scene, Index object, const Joint& now, Joint& next) {
  keep_side(scene, object, 0, now, next);
  keep_side(scene, object, 1, now, next);
  next.lower = now.lower;
  next.upper = now.upper;
  next.cone_angle0 = now.cone_angle0;
  next.cone_angle1 = now.cone_angle1;
  next.limits = now.limits;
  next.enabled = now.enabled;
  next.collision_enabled = now.collision_enabled;
  next.exclude_from_articulation = now.exclude_from_articulation;
  next.articulation = now.articulation;
  next.initial_position = now.initial_position;
  next.initial_velocity = now.initial_velocity;
  if (next.drives.size() != now.drives.size()) {
    next.drives = now.drives;
  }
  for (const ScalarTrack& track : scene.scalar_tracks) {
    if (track.joint == object && track.drive < next.drives.size()) {
      double Drive::* const number = number_of(track.what);
      next.drives[track.drive].*number = now.drives[track.drive].*number;
    }
  }
}

}  // namespace tenon::scene
