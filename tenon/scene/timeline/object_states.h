// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Calls `visit(list, tracks)` with the members of PhysicsScene for each list whose objects may
/// have states.
template <class Visit>
void each_tracked_list(Visit&& visit) {
  visit(&PhysicsScene::scenes, &PhysicsScene::scene_tracks);
  visit(&PhysicsScene::bodies, &PhysicsScene::body_tracks);
  visit(&PhysicsScene::colliders, &PhysicsScene::collider_tracks);
  visit(&PhysicsScene::materials, &PhysicsScene::material_tracks);
  visit(&PhysicsScene::joints, &PhysicsScene::joint_tracks);
  visit(&PhysicsScene::tendons, &PhysicsScene::tendon_tracks);
  visit(&PhysicsScene::actuators, &PhysicsScene::actuator_tracks);
}

/// Writes into `next`, a state of an object of `scene`, what such a state does not say but what
/// `now` has: where things are and how they move, what switches and other tracks of the scene
/// decide on, and what objects refer to. `object` is the place of both in its list.
void keep_followed(const PhysicsScene& scene, Index object, const Scene& now, Scene& next);
void keep_followed(const PhysicsScene& scene, Index object, const Body& now, Body& next);
void keep_followed(const PhysicsScene& scene, Index object, const Collider& now, Collider& next);
void keep_followed(const PhysicsScene& scene, Index object, const Joint& now, Joint& next);
inline void keep_followed(const PhysicsScene&, Index, const Material&, Material&) {}
inline void keep_followed(const PhysicsScene&, Index, const Tendon&, Tendon&) {}
inline void keep_followed(const PhysicsScene&, Index, const MujocoActuator&, MujocoActuator&) {}

/// The shapes of a body follow a track of their own, with the mass that they make.
const ShapesTrack* shapes_track_of(const PhysicsScene& scene, Index body);

}  // namespace tenon::scene
