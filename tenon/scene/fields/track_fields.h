// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/scene/fields/field.h"
#include "tenon/scene/physics_scene.h"

/// The tables of tendons, of filters and of what changes while a simulation runs. Times are seconds
/// from the start.
namespace tenon::scene {

template <>
struct Table<TendonWrap::Attachment> {
  static constexpr std::string_view kWord = "attachment";
  static constexpr Rows kFields{
      field<&TendonWrap::Attachment::path>(
          {.name = "path", .meaning = "the prim", .role = Role::Provenance}),
      field<&TendonWrap::Attachment::body>(
          {.name = "body", .meaning = "null: the world", .refers = List::Bodies}),
      field<&TendonWrap::Attachment::pose>(
          {.name = "pose", .meaning = "in the body, or in the world", .inlined = true}),
  };
};

template <>
struct Table<TendonWrap> {
  static constexpr std::string_view kWord = "wrap";
  static constexpr Rows kFields{
      field<&TendonWrap::kind>({.name = "kind", .meaning = "what the tendon does there"}),
      field<&TendonWrap::attachment>({.name = "attachment",
                                      .meaning = "a point of the tendon's surroundings",
                                      .presence = Presence::WhenSet,
                                      .former = "place"}),
      field<&TendonWrap::radius>({.name = "radius",
                                  .meaning = "of what it goes around",
                                  .unit = Unit::Meter,
                                  .presence = Presence::WhenSet}),
      field<&TendonWrap::side>(
          {.name = "side", .meaning = "where the path goes past; null: on the shorter way"}),
      field<&TendonWrap::divisor>({.name = "divisor",
                                   .meaning = "of a pulley: of the length of what follows",
                                   .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<Tendon> {
  static constexpr std::string_view kWord = "tendon";
  static constexpr Rows kFields{
      field<&Tendon::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&Tendon::joints>(
          {.name = "joints", .meaning = "of a fixed tendon", .refers = List::Joints}),
      field<&Tendon::coefficients>(
          {.name = "coefficients", .meaning = "one for each of its joints"}),
      field<&Tendon::wraps>(
          {.name = "wraps", .meaning = "of a spatial tendon, along its path", .former = "stops"}),
      field<&Tendon::stiffness>({.name = "stiffness", .meaning = "of its spring"}),
      field<&Tendon::damping>({.name = "damping", .meaning = "of its length"}),
      field<&Tendon::friction>({.name = "friction", .meaning = "along its length"}),
      field<&Tendon::armature>({.name = "armature", .meaning = "added to the inertia"}),
      field<&Tendon::spring_length>(
          {.name = "springLength", .meaning = "no force between the two; -1: as it stands"}),
      field<&Tendon::range>({.name = "range", .meaning = "of its length; null: any"}),
      field<&Tendon::limit_stiffness>({.name = "limitStiffness",
                                       .meaning = "of the range as a spring; 0: hard",
                                       .presence = Presence::WhenSet}),
      field<&Tendon::settings>({.name = "settings", .meaning = "others, for MuJoCo"}),
  };
};

template <>
struct Table<MujocoActuator> {
  static constexpr std::string_view kWord = "actuator";
  static constexpr Rows kFields{
      field<&MujocoActuator::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&MujocoActuator::kind>({.name = "on", .meaning = "what it acts on"}),
      field<&MujocoActuator::target>(
          {.name = "target", .meaning = "into joints or tendons, where it acts on one"}),
      field<&MujocoActuator::drive>(
          {.name = "drive", .meaning = "into the joint's drives; null: not a drive"}),
      field<&MujocoActuator::site>({.name = "site", .meaning = "the point, or the pin of a crank"}),
      field<&MujocoActuator::other_site>(
          {.name = "otherSite", .meaning = "what the point is seen from; the slider of a crank"}),
      field<&MujocoActuator::crank_length>(
          {.name = "crankLength", .meaning = "of the rod", .unit = Unit::Meter}),
      field<&MujocoActuator::in_parent>(
          {.name = "inParent", .meaning = "the gear of a ball counts in the parent's frame"}),
      field<&MujocoActuator::gain_type>({.name = "gainType", .meaning = "mjc:gainType"}),
      field<&MujocoActuator::bias_type>({.name = "biasType", .meaning = "mjc:biasType"}),
      field<&MujocoActuator::dyn_type>({.name = "dynType", .meaning = "mjc:dynType"}),
      field<&MujocoActuator::gain>({.name = "gain", .meaning = "mjc:gainPrm in SI"}),
      field<&MujocoActuator::bias>({.name = "bias", .meaning = "mjc:biasPrm in SI"}),
      field<&MujocoActuator::dynamics>({.name = "dynamics", .meaning = "mjc:dynPrm"}),
      field<&MujocoActuator::gear>({.name = "gear", .meaning = "mjc:gear"}),
      field<&MujocoActuator::control_range>(
          {.name = "controlRange", .meaning = "null: any control"}),
      field<&MujocoActuator::force_range>({.name = "forceRange", .meaning = "null: any force"}),
      field<&MujocoActuator::activation_range>(
          {.name = "activationRange", .meaning = "null: any activation"}),
      field<&MujocoActuator::length_range>(
          {.name = "lengthRange", .meaning = "both 0: to be found"}),
      field<&MujocoActuator::inherit_range>(
          {.name = "inheritRange", .meaning = "of the target's range; 0: none"}),
      field<&MujocoActuator::activation_count>(
          {.name = "activationCount", .meaning = "-1: as dynType has it"}),
      field<&MujocoActuator::acts_early>(
          {.name = "actsEarly", .meaning = "on the activation after a step"}),
      field<&MujocoActuator::group>({.name = "group", .meaning = "mjc:group"}),
      field<&MujocoActuator::fault>({.name = "fault",
                                     .meaning = "why it acts on nothing; empty: it does",
                                     .role = Role::Provenance}),
  };
};

template <>
struct Table<JointPairs> {
  static constexpr std::string_view kWord = "pairs of";
  static constexpr Rows kFields{
      field<&JointPairs::joint>({.name = "joint",
                                 .meaning = "that keeps them apart",
                                 .refers = List::Joints,
                                 .role = Role::Identity}),
      field<&JointPairs::sets>(
          {.name = "sets", .meaning = "numbers of two sets each", .former = "pairs"}),
  };
};

template <>
struct Table<CollisionFilter> {
  static constexpr std::string_view kWord = "filter";
  static constexpr Rows kFields{
      field<&CollisionFilter::groups_of_collider>(
          {.name = "groupsOfCollider",
           .meaning = "for each collider, indices into groupPaths; none: ungrouped"}),
      field<&CollisionFilter::group_paths>({.name = "groupPaths", .meaning = "the groups"}),
      field<&CollisionFilter::group_pair_off>(
          {.name = "groupPairOff", .meaning = "groups by groups, by rows: 1 where they are apart"}),
      field<&CollisionFilter::ungrouped_off>(
          {.name = "ungroupedOff", .meaning = "1 where a group is apart from ungrouped ones"}),
      field<&CollisionFilter::sets_of_collider>(
          {.name = "setsOfCollider",
           .meaning = "for each collider, numbers of sets that filters name; may end early"}),
      field<&CollisionFilter::sets_off>({.name = "setsOff",
                                         .meaning = "numbers of two sets each, that do not touch",
                                         .former = "pairsOff"}),
      field<&CollisionFilter::permanent_sets_off>(
          {.name = "permanentSetsOff",
           .meaning = "those that hold whatever becomes of joints",
           .former = "permanentPairs"}),
      field<&CollisionFilter::joint_pairs>(
          {.name = "jointPairs", .meaning = "what single joints keep apart"}),
  };
};

template <>
struct Table<ScalarTrack> {
  static constexpr std::string_view kWord = "drive over time";
  static constexpr Rows kFields{
      field<&ScalarTrack::what>(
          {.name = "value", .meaning = "what changes", .role = Role::Identity}),
      field<&ScalarTrack::joint>({.name = "joint",
                                  .meaning = "whose drive",
                                  .refers = List::Joints,
                                  .role = Role::Identity}),
      field<&ScalarTrack::drive>(
          {.name = "drive", .meaning = "into the joint's drives", .role = Role::Identity}),
      field<&ScalarTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&ScalarTrack::values>({.name = "values", .meaning = "at those times"}),
      field<&ScalarTrack::held>({.name = "held", .meaning = "until the next, not linear"}),
  };
};

template <>
struct Table<SwitchTrack> {
  static constexpr std::string_view kWord = "switch over time";
  static constexpr Rows kFields{
      field<&SwitchTrack::what>(
          {.name = "value", .meaning = "what is switched", .role = Role::Identity}),
      field<&SwitchTrack::object>({.name = "object",
                                   .meaning = "the body, collider or joint",
                                   .refers = List::BySwitch,
                                   .role = Role::Identity}),
      field<&SwitchTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&SwitchTrack::values>({.name = "values", .meaning = "1: on, until the next"}),
  };
};

template <>
struct Table<JointBounds> {
  static constexpr std::string_view kWord = "bounds";
  static constexpr Rows kFields{
      field<&JointBounds::lower>(
          {.name = "lower", .meaning = "null: unlimited", .unit = Unit::Position}),
      field<&JointBounds::upper>(
          {.name = "upper", .meaning = "null: unlimited", .unit = Unit::Position}),
      field<&JointBounds::cone_angle0>({.name = "coneAngle0",
                                        .meaning = "of spherical joints",
                                        .unit = Unit::Radian,
                                        .presence = Presence::WhenSet}),
      field<&JointBounds::cone_angle1>({.name = "coneAngle1",
                                        .meaning = "of spherical joints",
                                        .unit = Unit::Radian,
                                        .presence = Presence::WhenSet}),
      field<&JointBounds::limits>({.name = "limits",
                                   .meaning = "of single degrees of freedom",
                                   .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<BoundsTrack> {
  static constexpr std::string_view kWord = "bounds over time";
  static constexpr Rows kFields{
      field<&BoundsTrack::joint>({.name = "joint",
                                  .meaning = "whose bounds",
                                  .refers = List::Joints,
                                  .role = Role::Identity}),
      field<&BoundsTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&BoundsTrack::bounds>({.name = "bounds", .meaning = "at those times"}),
      field<&BoundsTrack::held>({.name = "held", .meaning = "until the next, not linear"}),
  };
};

template <>
struct Table<GravityTrack> {
  static constexpr std::string_view kWord = "gravity over time";
  static constexpr Rows kFields{
      field<&GravityTrack::scene>({.name = "scene",
                                   .meaning = "whose gravity",
                                   .refers = List::Scenes,
                                   .role = Role::Identity}),
      field<&GravityTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&GravityTrack::gravity>(
          {.name = "gravity", .meaning = "at those times", .unit = Unit::MeterPerSecondSquared}),
      field<&GravityTrack::held>({.name = "held", .meaning = "until the next, not linear"}),
  };
};

template <>
struct Table<PoseTrack> {
  static constexpr std::string_view kWord = "pose over time";
  static constexpr Rows kFields{
      field<&PoseTrack::body>({.name = "body",
                               .meaning = "a kinematic body",
                               .refers = List::Bodies,
                               .presence = Presence::WhenSet,
                               .role = Role::Identity}),
      field<&PoseTrack::collider>({.name = "collider",
                                   .meaning = "else a static collider",
                                   .refers = List::Colliders,
                                   .presence = Presence::WhenSet,
                                   .role = Role::Identity}),
      field<&PoseTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&PoseTrack::poses>({.name = "poses", .meaning = "in the world, at those times"}),
      field<&PoseTrack::held>({.name = "held", .meaning = "until the next, not interpolated"}),
      field<&PoseTrack::joint>({.name = "joint",
                                .meaning = "else a side of a joint",
                                .refers = List::Joints,
                                .presence = Presence::WhenSet,
                                .role = Role::Identity}),
      field<&PoseTrack::side>({.name = "side",
                               .meaning = "of the joint: 0 or 1",
                               .presence = Presence::WhenSet,
                               .role = Role::Identity}),
  };
};

template <>
struct Table<BodyShapes> {
  static constexpr std::string_view kWord = "shapes";
  static constexpr Rows kFields{
      field<&BodyShapes::poses>({.name = "poses", .meaning = "of the colliders, in the body"}),
      field<&BodyShapes::shapes>({.name = "shapes", .meaning = "of the colliders"}),
      field<&BodyShapes::mass>({.name = "mass", .meaning = "of the body", .unit = Unit::Kilogram}),
      field<&BodyShapes::center_of_mass>({.name = "centerOfMass",
                                          .meaning = "in the body frame",
                                          .unit = Unit::Meter,
                                          .words = "centre of mass"}),
      field<&BodyShapes::inertia>(
          {.name = "inertia", .meaning = "as that of bodies", .unit = Unit::KilogramMeterSquared}),
  };
};

template <>
struct Table<ShapesTrack> {
  static constexpr std::string_view kWord = "shapes over time";
  static constexpr Rows kFields{
      field<&ShapesTrack::body>({.name = "body",
                                 .meaning = "that they are of",
                                 .refers = List::Bodies,
                                 .role = Role::Identity}),
      field<&ShapesTrack::colliders>(
          {.name = "colliders", .meaning = "those that move", .refers = List::Colliders}),
      field<&ShapesTrack::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&ShapesTrack::shapes>({.name = "shapes", .meaning = "each holds until the next"}),
  };
};

/// What tracks of objects are of.
template <class Object>
struct ObjectTrackWords;
template <>
struct ObjectTrackWords<Scene> {
  static constexpr std::string_view kWord = "scene over time";
  static constexpr List kList = List::Scenes;
};
template <>
struct ObjectTrackWords<Body> {
  static constexpr std::string_view kWord = "body over time";
  static constexpr List kList = List::Bodies;
};
template <>
struct ObjectTrackWords<Collider> {
  static constexpr std::string_view kWord = "collider over time";
  static constexpr List kList = List::Colliders;
};
template <>
struct ObjectTrackWords<Material> {
  static constexpr std::string_view kWord = "material over time";
  static constexpr List kList = List::Materials;
};
template <>
struct ObjectTrackWords<Joint> {
  static constexpr std::string_view kWord = "joint over time";
  static constexpr List kList = List::Joints;
};
template <>
struct ObjectTrackWords<Tendon> {
  static constexpr std::string_view kWord = "tendon over time";
  static constexpr List kList = List::Tendons;
};
template <>
struct ObjectTrackWords<MujocoActuator> {
  static constexpr std::string_view kWord = "actuator over time";
  static constexpr List kList = List::Actuators;
};

template <class Object>
struct Table<ObjectTrack<Object>> {
  using Track = ObjectTrack<Object>;
  static constexpr std::string_view kWord = ObjectTrackWords<Object>::kWord;
  static constexpr Rows kFields{
      field<&Track::object>({.name = "object",
                             .meaning = "that changes",
                             .refers = ObjectTrackWords<Object>::kList,
                             .role = Role::Identity}),
      field<&Track::times>({.name = "times", .meaning = "ascending", .unit = Unit::Second}),
      field<&Track::states>({.name = "states", .meaning = "each holds until the next"}),
  };
};

template <>
struct Table<GroupState> {
  static constexpr std::string_view kWord = "collision groups at";
  static constexpr Rows kFields{
      field<&GroupState::time>({.name = "time",
                                .meaning = "from which on it holds",
                                .unit = Unit::Second,
                                .role = Role::Identity}),
      field<&GroupState::group_pair_off>(
          {.name = "groupPairOff", .meaning = "groups by groups, by rows: 1 where they are apart"}),
      field<&GroupState::ungrouped_off>(
          {.name = "ungroupedOff", .meaning = "1 where a group is apart from ungrouped ones"}),
  };
};

template <>
struct Table<BodyMass> {
  static constexpr std::string_view kWord = "mass";
  static constexpr Rows kFields{
      field<&BodyMass::mass>({.name = "mass", .meaning = "of the body", .unit = Unit::Kilogram}),
      field<&BodyMass::center_of_mass>({.name = "centerOfMass",
                                        .meaning = "in the body frame",
                                        .unit = Unit::Meter,
                                        .words = "centre of mass"}),
      field<&BodyMass::inertia>(
          {.name = "inertia", .meaning = "as that of bodies", .unit = Unit::KilogramMeterSquared}),
  };
};

template <>
struct Table<MergedBody> {
  static constexpr std::string_view kWord = "merged";
  static constexpr Rows kFields{
      field<&MergedBody::body>({.name = "body",
                                .meaning = "that is off",
                                .refers = List::Bodies,
                                .role = Role::Identity}),
      field<&MergedBody::into>({.name = "into",
                                .meaning = "the nearest body around it that is on",
                                .refers = List::Bodies,
                                .former = "carrier"}),
  };
};

template <>
struct Table<NestingState> {
  static constexpr std::string_view kWord = "nesting at";
  static constexpr Rows kFields{
      field<&NestingState::time>({.name = "time",
                                  .meaning = "from which on it holds",
                                  .unit = Unit::Second,
                                  .role = Role::Identity}),
      field<&NestingState::merged>({.name = "merged",
                                    .meaning = "bodies that move as parts of others",
                                    .former = "carried"}),
      field<&NestingState::masses>(
          {.name = "masses",
           .meaning = "of merged bodies and of those that they are merged into, ascending",
           .refers = List::Bodies}),
  };
};

}  // namespace tenon::scene
