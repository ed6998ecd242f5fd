// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

#include "tenon/base/path.h"
#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// The list that an index of a field with `refers` points into, in the object `owner`.
inline List switched_list(Switch what) {
  switch (what) {
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

template <class Owner>
List list_of(const Owner&, List refers) {
  return refers;
}
inline List list_of(const SwitchTrack& owner, List refers) {
  return refers == List::BySwitch ? switched_list(owner.what) : refers;
}

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

/// What the meaning of a field depends on in the struct that it is of. Walks over fields hand this
/// on instead of the struct, so that they are compiled once for each type of field, not once more
/// for each struct that has one.
struct OwnerFacts {
  List switched = List::BySwitch;  ///< what List::BySwitch stands for
  bool angular = true;             ///< its coordinate turns
  bool has_mesh = false;           ///< a shape of a mesh
  bool is_shape = false;
  bool is_collider = false;
  bool is_joint = false;
};

inline List list_of(const OwnerFacts& owner, List refers) {
  return refers == List::BySwitch ? owner.switched : refers;
}

template <class Owner>
OwnerFacts facts_of(const Owner& owner, bool outer_angular = true) {
  OwnerFacts facts;
  facts.switched = list_of(owner, List::BySwitch);
  facts.angular = is_angular_in(owner, outer_angular);
  facts.is_collider = std::is_same_v<Owner, Collider>;
  facts.is_joint = std::is_same_v<Owner, Joint>;
  if constexpr (std::is_same_v<Owner, Shape>) {
    facts.is_shape = true;
    facts.has_mesh = owner.kind == ShapeKind::ConvexHull || owner.kind == ShapeKind::Mesh;
  }
  return facts;
}

}  // namespace tenon::scene
