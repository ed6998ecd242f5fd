// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/base/path.h"
#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// The list that an index of a field with `refers` points into, in the object `owner`.
template <class Owner>
List list_of(const Owner&, List refers) {
  return refers;
}
inline List list_of(const SwitchTrack& owner, List refers) {
  if (refers != List::BySwitch) {
    return refers;
  }
  switch (owner.what) {
    case Switch::BodyEnabled:
    case Switch::BodyKinematic:
      return List::Bodies;
    case Switch::ColliderEnabled:
      return List::Colliders;
    case Switch::JointEnabled:
    case Switch::JointCollision:
      break;
  }
  return List::Joints;
}

/// How many objects a list has.
inline std::size_t size_of(const PhysicsScene& scene, List list) {
  switch (list) {
    case List::Scenes:
      return scene.scenes.size();
    case List::Bodies:
      return scene.bodies.size();
    case List::Colliders:
      return scene.colliders.size();
    case List::Meshes:
      return scene.meshes.size();
    case List::Materials:
      return scene.materials.size();
    case List::Joints:
      return scene.joints.size();
    case List::Articulations:
      return scene.articulations.size();
    case List::Tendons:
      return scene.tendons.size();
    case List::Actuators:
      return scene.actuators.size();
    case List::None:
    case List::BySwitch:
      break;
  }
  return 0;
}

/// The path of an object of a list; empty for meshes, which have none, and where there is no such
/// object.
inline Path path_of(const PhysicsScene& scene, List list, Index index) {
  if (index >= size_of(scene, list)) {
    return {};
  }
  switch (list) {
    case List::Scenes:
      return scene.scenes[index].path;
    case List::Bodies:
      return scene.bodies[index].path;
    case List::Colliders:
      return scene.colliders[index].path;
    case List::Materials:
      return scene.materials[index].path;
    case List::Joints:
      return scene.joints[index].path;
    case List::Articulations:
      return scene.articulations[index].path;
    case List::Tendons:
      return scene.tendons[index].path;
    case List::Actuators:
      return scene.actuators[index].path;
    case List::Meshes:
    case List::None:
    case List::BySwitch:
      break;
  }
  return {};
}

/// The coordinate of an object turns, so that its numbers are of angles and torques. Of others what
/// holds around them (`outer`).
template <class Owner>
bool is_angular_in(const Owner&, bool outer) {
  return outer;
}
inline bool is_angular_in(const Drive& drive, bool) { return is_angular(drive.dof); }
inline bool is_angular_in(const Limit& limit, bool) { return is_angular(limit.dof); }
inline bool is_angular_in(const LimitSpring& spring, bool) { return is_angular(spring.dof); }
inline bool is_angular_in(const Mimic& mimic, bool) { return is_angular(mimic.dof); }
inline bool is_angular_in(const Joint& joint, bool) {
  return joint.kind != JointKind::Prismatic && joint.kind != JointKind::Distance;
}

}  // namespace tenon::scene
