// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/list_of.h"

#include <optional>

namespace tenon::scene {
namespace {

List switched_list(Switch what) {
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

template <class T>
std::optional<bool> turns(DataView owner) {
  const T* of = owner.get_if<T>();
  return of == nullptr ? std::nullopt : std::optional(is_angular(of->dof));
}

/// Whether the coordinate of a struct turns; none where it has none.
std::optional<bool> turns(DataView owner) {
  if (const Joint* joint = owner.get_if<Joint>()) {
    return joint->kind != JointKind::Prismatic && joint->kind != JointKind::Distance;
  }
  for (const auto& of : {turns<Drive>, turns<Limit>, turns<LimitSpring>, turns<Mimic>}) {
    if (const auto found = of(owner)) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace

std::size_t size_of(const PhysicsScene& scene, List list) {
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

Path path_of(const PhysicsScene& scene, List list, Index index) {
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

OwnerFacts facts_of(DataView owner, bool outer_angular) {
  OwnerFacts facts;
  if (const SwitchTrack* track = owner.get_if<SwitchTrack>()) {
    facts.switched = switched_list(track->what);
  }
  facts.angular = turns(owner).value_or(outer_angular);
  facts.is_collider = owner.is_a<Collider>();
  facts.is_joint = owner.is_a<Joint>();
  if (const Shape* shape = owner.get_if<Shape>()) {
    facts.is_shape = true;
    facts.has_mesh = shape->kind == ShapeKind::ConvexHull || shape->kind == ShapeKind::Mesh;
  }
  return facts;
}

}  // namespace tenon::scene
