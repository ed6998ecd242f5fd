// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/scene/fields/field.h"
#include "tenon/scene/fields/object_fields.h"
#include "tenon/scene/fields/sensor_fields.h"
#include "tenon/scene/fields/track_fields.h"
#include "tenon/scene/physics_scene.h"

/// The table of the whole description. A member that is added to a struct of physics_scene.h,
/// mujoco_parts.h, sensors.h or vendor_parts.h gets its row in one of these headers; all that walks
/// the tables then carries it.
namespace tenon::scene {

template <>
struct Table<NotRead> {
  static constexpr std::string_view kWord = "not read";
  static constexpr Rows kFields{
      field<&NotRead::prim>({.name = "prim", .meaning = "the prim", .role = Role::Provenance}),
      field<&NotRead::property>(
          {.name = "property", .meaning = "its property", .role = Role::Provenance}),
      field<&NotRead::why>({.name = "why", .meaning = "a clause", .role = Role::Provenance}),
  };
};

template <>
struct Table<PhysicsScene> {
  using Contents = SceneContents;
  static constexpr std::string_view kWord = "stage";
  static constexpr Rows kFields{
      field<&PhysicsScene::scenes>({.name = "scenes", .meaning = "at least one"}),
      field<&PhysicsScene::bodies>({.name = "bodies", .meaning = "by path"}),
      field<&PhysicsScene::colliders>({.name = "colliders", .meaning = "by path"}),
      field<&PhysicsScene::meshes>(
          {.name = "meshes", .meaning = "of colliders", .role = Role::Shared}),
      field<&PhysicsScene::materials>({.name = "materials", .meaning = "by path"}),
      field<&PhysicsScene::unbound>(
          {.name = "unbound", .meaning = "the material of colliders without one"}),
      field<&PhysicsScene::joints>({.name = "joints", .meaning = "by path"}),
      field<&PhysicsScene::articulations>({.name = "articulations", .meaning = "by path"}),
      field<&PhysicsScene::tendons>({.name = "tendons", .meaning = "by path"}),
      field<&PhysicsScene::actuators>({.name = "mujocoActuators",
                                       .meaning = "of MuJoCo, that are not drives of joints",
                                       .presence = Presence::WhenSet,
                                       .of_vendor = true,
                                       .words = "actuators of MuJoCo"}),
      field<&PhysicsScene::sensors>(
          {.name = "sensors", .meaning = "by path", .presence = Presence::WhenSet}),
      field<&PhysicsScene::filter>({.name = "filter", .meaning = "which colliders may touch"}),
      field<&PhysicsScene::scalar_tracks>(
          {.name = "driveTracks", .meaning = "numbers of drives that follow samples"}),
      field<&PhysicsScene::pose_tracks>(
          {.name = "poseTracks", .meaning = "poses that follow samples"}),
      field<&PhysicsScene::switch_tracks>(
          {.name = "switchTracks", .meaning = "switches that follow samples"}),
      field<&PhysicsScene::bounds_tracks>(
          {.name = "boundsTracks", .meaning = "bounds of joints that follow samples"}),
      field<&PhysicsScene::gravity_tracks>(
          {.name = "gravityTracks", .meaning = "gravity that follows samples"}),
      field<&PhysicsScene::shapes_tracks>(
          {.name = "shapesTracks", .meaning = "shapes that move inside their bodies"}),
      field<&PhysicsScene::scene_tracks>({.name = "sceneTracks",
                                          .meaning = "scenes whose numbers follow samples",
                                          .presence = Presence::WhenSet}),
      field<&PhysicsScene::body_tracks>({.name = "bodyTracks",
                                         .meaning = "bodies whose numbers follow samples",
                                         .presence = Presence::WhenSet}),
      field<&PhysicsScene::collider_tracks>({.name = "colliderTracks",
                                             .meaning = "colliders whose numbers follow samples",
                                             .presence = Presence::WhenSet}),
      field<&PhysicsScene::material_tracks>({.name = "materialTracks",
                                             .meaning = "materials whose numbers follow samples",
                                             .presence = Presence::WhenSet}),
      field<&PhysicsScene::joint_tracks>({.name = "jointTracks",
                                          .meaning = "joints whose numbers follow samples",
                                          .presence = Presence::WhenSet}),
      field<&PhysicsScene::tendon_tracks>({.name = "tendonTracks",
                                           .meaning = "tendons whose numbers follow samples",
                                           .presence = Presence::WhenSet}),
      field<&PhysicsScene::actuator_tracks>(
          {.name = "mujocoActuatorTracks",
           .meaning = "actuators of MuJoCo whose numbers follow samples",
           .presence = Presence::WhenSet,
           .of_vendor = true}),
      field<&PhysicsScene::group_states>(
          {.name = "groupStates", .meaning = "collision groups over time; none: filter holds"}),
      field<&PhysicsScene::nesting_states>(
          {.name = "nestingStates", .meaning = "bodies that others carry, over time"}),
      field<&PhysicsScene::not_read>({.name = "notRead",
                                      .meaning = "properties of the stage that are not supported",
                                      .role = Role::Provenance}),
      field<&PhysicsScene::meters_per_unit>(
          {.name = "metersPerUnit", .meaning = "of the stage", .role = Role::Provenance}),
      field<&PhysicsScene::kilograms_per_unit>(
          {.name = "kilogramsPerUnit", .meaning = "of the stage", .role = Role::Provenance}),
      field<&PhysicsScene::up>(
          {.name = "up", .meaning = "up axis of the stage", .role = Role::Provenance}),
      field<&PhysicsScene::start_time_code>({.name = "startTimeCode",
                                             .meaning = "where the simulation starts",
                                             .role = Role::Provenance}),
      field<&PhysicsScene::time_codes_per_second>(
          {.name = "timeCodesPerSecond", .meaning = "of the stage", .role = Role::Provenance}),
      field<&PhysicsScene::end_time_code>(
          {.name = "endTimeCode",
           .meaning = "authored end, or the start when none is authored",
           .role = Role::Provenance}),
  };
};

}  // namespace tenon::scene
