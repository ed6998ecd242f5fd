// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/scene/fields/field.h"
#include "tenon/scene/fields/setting_fields.h"
#include "tenon/scene/physics_scene.h"

/// The tables of what a scene consists of: scenes, bodies, colliders, materials, joints,
/// articulations.
namespace tenon::scene {

template <>
struct Table<VendorSetting> {
  static constexpr std::string_view kWord = "setting";
  static constexpr Rows kFields{
      field<&VendorSetting::name>(
          {.name = "name", .meaning = "of the setting", .role = Role::Identity}),
      field<&VendorSetting::numbers>(
          {.name = "numbers", .meaning = "one for each component; flags are 0 or 1"}),
      field<&VendorSetting::token>({.name = "token", .meaning = "of settings that are words"}),
  };
};

/// The row of what single vendors say of an object.
inline constexpr FieldInfo kPartsField{
    .name = "parts", .meaning = "of single vendors", .inlined = true, .of_vendor = true};

inline constexpr FieldInfo kPhysxField{.name = "physx",
                                       .meaning = "how PhysX's schema wants it solved",
                                       .presence = Presence::WhenSet,
                                       .words = "PhysX"};

template <>
struct Table<SceneParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{
      field<&SceneParts::mujoco>({.name = "mujoco",
                                  .meaning = "what MjcSceneAPI authors, except the time step",
                                  .presence = Presence::WhenSet,
                                  .words = "MuJoCo"}),
      field<&SceneParts::physx>(kPhysxField),
  };
};

template <>
struct Table<BodyParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{field<&BodyParts::physx>(kPhysxField)};
};

template <>
struct Table<ArticulationParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{field<&ArticulationParts::physx>(kPhysxField)};
};

template <>
struct Table<Scene> {
  static constexpr std::string_view kWord = "scene";
  static constexpr Rows kFields{
      field<&Scene::path>({.name = "path",
                           .meaning = "null: made up because the stage has none",
                           .role = Role::Identity}),
      field<&Scene::gravity>({.name = "gravity",
                              .meaning = "acceleration in world axes",
                              .unit = Unit::MeterPerSecondSquared}),
      field<&Scene::time_step>({.name = "timeStep",
                                .meaning = "asked for by the asset",
                                .unit = Unit::Second,
                                .presence = Presence::Null}),
      field<&Scene::parts>(kPartsField),
  };
};

template <>
struct Table<InstanceSource> {
  static constexpr std::string_view kWord = "instance";
  static constexpr Rows kFields{
      field<&InstanceSource::instancer>(
          {.name = "instancer", .meaning = "the UsdGeomPointInstancer", .role = Role::Provenance}),
      field<&InstanceSource::prototype>({.name = "prototype",
                                         .meaning = "the target of the instancer",
                                         .role = Role::Provenance}),
      field<&InstanceSource::prim>({.name = "prim",
                                    .meaning = "the prim at or below the prototype",
                                    .role = Role::Provenance}),
      field<&InstanceSource::index>(
          {.name = "index", .meaning = "into the instancer's arrays", .role = Role::Provenance}),
      field<&InstanceSource::world>({.name = "world",
                                     .meaning = "transform of the prim at the start, stage units",
                                     .role = Role::Provenance}),
      field<&InstanceSource::nested>({.name = "nested",
                                      .meaning = "the instancer is in an instance of another",
                                      .role = Role::Provenance}),
  };
};

template <>
struct Table<Body> {
  static constexpr std::string_view kWord = "body";
  static constexpr Rows kFields{
      field<&Body::path>({.name = "path",
                          .meaning = "the prim; made up for instances of a point instancer",
                          .role = Role::Identity}),
      field<&Body::kinematic>(
          {.name = "kinematic", .meaning = "its pose is given, never computed"}),
      field<&Body::enabled>({.name = "enabled", .meaning = "false: it is fixed"}),
      field<&Body::starts_asleep>(
          {.name = "startsAsleep", .meaning = "it hangs still until it is touched"}),
      field<&Body::scene>(
          {.name = "scene", .meaning = "the scene that it moves in", .refers = List::Scenes}),
      field<&Body::pose>(
          {.name = "pose", .meaning = "world <- body at the start, unscaled", .inlined = true}),
      field<&Body::linear_velocity>({.name = "linearVelocity",
                                     .meaning = "of the centre of mass, world axes",
                                     .unit = Unit::MeterPerSecond}),
      field<&Body::angular_velocity>(
          {.name = "angularVelocity", .meaning = "world axes", .unit = Unit::RadianPerSecond}),
      field<&Body::mass>({.name = "mass", .meaning = "mass", .unit = Unit::Kilogram}),
      field<&Body::center_of_mass>({.name = "centerOfMass",
                                    .meaning = "in the body frame",
                                    .unit = Unit::Meter,
                                    .words = "centre of mass"}),
      field<&Body::inertia>({.name = "inertia",
                             .meaning = "about the centre of mass, body axes, nine numbers by rows",
                             .unit = Unit::KilogramMeterSquared}),
      field<&Body::mass_source>({.name = "massSource",
                                 .meaning = "what the mass comes from",
                                 .role = Role::Provenance,
                                 .words = "mass is"}),
      field<&Body::linear_damping>(
          {.name = "linearDamping", .meaning = "of the velocity", .unit = Unit::PerSecond}),
      field<&Body::angular_damping>({.name = "angularDamping",
                                     .meaning = "of the angular velocity",
                                     .unit = Unit::PerSecond}),
      field<&Body::gravity_scale>({.name = "gravityScale", .meaning = "times gravity"}),
      field<&Body::settings>(kSettingsField),
      field<&Body::parts>(kPartsField),
      field<&Body::instance>({.name = "instance",
                              .meaning = "the instance of a point instancer that it comes from",
                              .presence = Presence::WhenSet,
                              .role = Role::Provenance}),
  };
};

template <>
struct Table<TriangleMesh> {
  static constexpr std::string_view kWord = "mesh";
  static constexpr Rows kFields{
      field<&TriangleMesh::points>({.name = "points",
                                    .meaning = "in the collider's frame, scale included",
                                    .unit = Unit::Meter}),
      field<&TriangleMesh::triangles>(
          {.name = "triangles", .meaning = "three indices each; outward is counter-clockwise"}),
      field<&TriangleMesh::flat>(
          {.name = "flat", .meaning = "all points in one plane: touched from both sides"}),
  };
};

template <>
struct Table<Shape> {
  static constexpr std::string_view kWord = "shape";
  static constexpr Rows kFields{
      field<&Shape::kind>({.name = "shape", .meaning = "what collides"}),
      field<&Shape::half_extents>({.name = "halfExtents",
                                   .meaning = "of boxes; semi-axes of ellipsoids",
                                   .unit = Unit::Meter,
                                   .presence = Presence::WhenSet}),
      field<&Shape::radius>({.name = "radius",
                             .meaning = "of round shapes; of the base of cones",
                             .unit = Unit::Meter,
                             .presence = Presence::WhenSet}),
      field<&Shape::half_height>({.name = "halfHeight",
                                  .meaning = "along the axis, without caps",
                                  .unit = Unit::Meter,
                                  .presence = Presence::WhenSet}),
      field<&Shape::axis>({.name = "axis",
                           .meaning = "that the shape is round about; a plane's normal",
                           .presence = Presence::WhenSet,
                           .words = "axis of the shape"}),
      field<&Shape::mesh>({.name = "mesh",
                           .meaning = "of convexHull and mesh",
                           .refers = List::Meshes,
                           .presence = Presence::WhenSet}),
      field<&Shape::pieces>({.name = "hulls",
                             .meaning = "of its convex decomposition; none: the hull of the mesh",
                             .refers = List::Meshes,
                             .presence = Presence::WhenSet}),
      field<&Shape::sphere_centers>({.name = "centers",
                                     .meaning = "of spheres, in the collider's frame",
                                     .unit = Unit::Meter,
                                     .presence = Presence::WhenSet,
                                     .words = "centres of the spheres"}),
      field<&Shape::sphere_radii>({.name = "radii",
                                   .meaning = "of spheres",
                                   .unit = Unit::Meter,
                                   .presence = Presence::WhenSet,
                                   .words = "radii of the spheres"}),
  };
};

template <>
struct Table<FaceMaterial> {
  static constexpr std::string_view kWord = "faces of";
  static constexpr Rows kFields{
      field<&FaceMaterial::subset>(
          {.name = "subset", .meaning = "the GeomSubset", .role = Role::Identity}),
      field<&FaceMaterial::material>(
          {.name = "material", .meaning = "null: no physics material", .refers = List::Materials}),
      field<&FaceMaterial::triangles>({.name = "triangles", .meaning = "of the mesh, ascending"}),
  };
};

template <>
struct Table<MujocoContact> {
  static constexpr std::string_view kWord = "contact";
  static constexpr Rows kFields{
      field<&MujocoContact::condim>({.name = "condim",
                                     .meaning = "1, 3, 4 or 6 directions that resist",
                                     .presence = Presence::WhenSet}),
      field<&MujocoContact::priority>({.name = "priority",
                                       .meaning = "the higher one decides about a contact",
                                       .presence = Presence::WhenSet}),
      field<&MujocoContact::solmix>({.name = "solmix",
                                     .meaning = "weight where priorities are equal",
                                     .presence = Presence::WhenSet}),
      field<&MujocoContact::solref>(
          {.name = "solref", .meaning = "of contacts", .presence = Presence::WhenSet}),
      field<&MujocoContact::solimp>(
          {.name = "solimp", .meaning = "of contacts", .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<ColliderParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{
      field<&ColliderParts::mujoco>({.name = "mujoco",
                                     .meaning = "what MjcCollisionAPI authors",
                                     .presence = Presence::WhenSet,
                                     .words = "MuJoCo"}),
  };
};

template <>
struct Table<Collider> {
  static constexpr std::string_view kWord = "collider";
  static constexpr Rows kFields{
      field<&Collider::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&Collider::body>({.name = "body", .meaning = "null: static", .refers = List::Bodies}),
      field<&Collider::scene>(
          {.name = "scene", .meaning = "the scene that it is in", .refers = List::Scenes}),
      field<&Collider::shape>({.name = "shape", .meaning = "what collides", .inlined = true}),
      field<&Collider::pose>({.name = "pose",
                              .meaning = "body <- collider; world <- collider where static",
                              .inlined = true}),
      field<&Collider::material>(
          {.name = "material", .meaning = "null: the unbound one", .refers = List::Materials}),
      field<&Collider::face_materials>({.name = "faceMaterials",
                                        .meaning = "of triangles with another material",
                                        .presence = Presence::WhenSet}),
      field<&Collider::approximation>({.name = "approximation",
                                       .meaning = "of meshes: what the asset asks for",
                                       .presence = Presence::WhenSet}),
      field<&Collider::enabled>({.name = "enabled", .meaning = "false: it touches nothing"}),
      field<&Collider::contact_offset>({.name = "contactOffset",
                                        .meaning = "distance at which contacts begin to be made",
                                        .unit = Unit::Meter,
                                        .presence = Presence::WhenSet}),
      field<&Collider::rest_offset>({.name = "restOffset",
                                     .meaning = "distance at which two surfaces rest",
                                     .unit = Unit::Meter,
                                     .presence = Presence::WhenSet}),
      field<&Collider::max_hull_vertices>({.name = "maxHullVertices",
                                           .meaning = "of the convex hull",
                                           .presence = Presence::WhenSet,
                                           .words = "max vertices of the hull"}),
      field<&Collider::settings>(kSettingsField),
      field<&Collider::parts>(kPartsField),
  };
};

template <>
struct Table<Material> {
  static constexpr std::string_view kWord = "material";
  static constexpr Rows kFields{
      field<&Material::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&Material::static_friction>(
          {.name = "staticFriction", .meaning = "coefficient at rest"}),
      field<&Material::dynamic_friction>(
          {.name = "dynamicFriction", .meaning = "coefficient of sliding"}),
      field<&Material::restitution>({.name = "restitution", .meaning = "coefficient"}),
      field<&Material::density>({.name = "density",
                                 .meaning = "null: none given",
                                 .unit = Unit::KilogramPerCubicMeter,
                                 .presence = Presence::Null}),
      field<&Material::torsional_friction>({.name = "torsionalFriction",
                                            .meaning = "about the normal of a contact",
                                            .unit = Unit::Meter,
                                            .presence = Presence::WhenSet}),
      field<&Material::rolling_friction>({.name = "rollingFriction",
                                          .meaning = "of rolling",
                                          .unit = Unit::Meter,
                                          .presence = Presence::WhenSet}),
      field<&Material::friction_combine>(
          {.name = "frictionCombine", .meaning = "how two coefficients become that of a pair"}),
      field<&Material::restitution_combine>(
          {.name = "restitutionCombine", .meaning = "how two coefficients become that of a pair"}),
      field<&Material::compliance>({.name = "compliance",
                                    .meaning = "of contacts that give way like springs",
                                    .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<Limit> {
  static constexpr std::string_view kWord = "";
  static constexpr Rows kFields{
      field<&Limit::dof>({.name = "dof", .meaning = "degree of freedom", .role = Role::Identity}),
      field<&Limit::lower>({.name = "lower",
                            .meaning = "null: unlimited; above upper: locked at zero",
                            .unit = Unit::Position,
                            .words = "lower limit"}),
      field<&Limit::upper>({.name = "upper",
                            .meaning = "null: unlimited",
                            .unit = Unit::Position,
                            .words = "upper limit"}),
  };
};

template <>
struct Table<Drive> {
  static constexpr std::string_view kWord = "drive";
  static constexpr Rows kFields{
      field<&Drive::source>({.name = "source",
                             .meaning = "the prim that authors it: the joint, or an actuator",
                             .role = Role::Provenance}),
      field<&Drive::dof>({.name = "dof", .meaning = "degree of freedom", .role = Role::Identity}),
      field<&Drive::acceleration>({.name = "type",
                                   .meaning = "acceleration: gains per unit of effective inertia",
                                   .off = "force",
                                   .on = "acceleration"}),
      field<&Drive::stiffness>(
          {.name = "stiffness", .meaning = "of the position", .unit = Unit::Stiffness}),
      field<&Drive::damping>(
          {.name = "damping", .meaning = "of the velocity", .unit = Unit::Damping}),
      field<&Drive::max_force>({.name = "maxForce",
                                .meaning = "null: unlimited",
                                .unit = Unit::Effort,
                                .words = "maximum force"}),
      field<&Drive::target_position>(
          {.name = "targetPosition", .meaning = "of the coordinate", .unit = Unit::Position}),
      field<&Drive::target_velocity>(
          {.name = "targetVelocity", .meaning = "of the coordinate", .unit = Unit::Velocity}),
      field<&Drive::envelope>(kSettingsField),
  };
};

template <>
struct Table<MujocoEquality> {
  static constexpr std::string_view kWord = "equality";
  static constexpr Rows kFields{
      field<&MujocoEquality::solref>({.name = "mujocoSolref",
                                      .meaning = "mjc:solref",
                                      .presence = Presence::WhenSet,
                                      .words = "solref of MuJoCo"}),
      field<&MujocoEquality::solimp>({.name = "mujocoSolimp",
                                      .meaning = "mjc:solimp",
                                      .presence = Presence::WhenSet,
                                      .words = "solimp of MuJoCo"}),
  };
};

template <>
struct Table<MimicParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{
      field<&MimicParts::mujoco>(
          {.name = "mujoco", .meaning = "what MjcEqualityJointAPI authors", .inlined = true}),
  };
};

template <>
struct Table<Mimic> {
  static constexpr std::string_view kWord = "mimic";
  static constexpr Rows kFields{
      field<&Mimic::schema>(
          {.name = "schema", .meaning = "the API that says so", .role = Role::Provenance}),
      field<&Mimic::dof>({.name = "dof",
                          .meaning = "degree of freedom of the joint that follows",
                          .role = Role::Identity}),
      field<&Mimic::leader>(
          {.name = "leader", .meaning = "the joint that it follows", .refers = List::Joints}),
      field<&Mimic::leader_dof>({.name = "leaderDof",
                                 .meaning = "degree of freedom of the leader",
                                 .words = "degree of freedom of the leader"}),
      field<&Mimic::multiplier>({.name = "multiplier", .meaning = "of the leader's coordinate"}),
      field<&Mimic::offset>({.name = "offset", .meaning = "added to it", .unit = Unit::Position}),
      field<&Mimic::higher>({.name = "higher",
                             .meaning = "coefficients of the second to fourth power",
                             .of_vendor = true,
                             .words = "higher coefficients"}),
      field<&Mimic::natural_frequency>({.name = "naturalFrequency",
                                        .meaning = "of its spring; with dampingRatio 0: rigid",
                                        .unit = Unit::RadianPerSecond}),
      field<&Mimic::damping_ratio>({.name = "dampingRatio", .meaning = "of its spring"}),
      field<&Mimic::parts>(kPartsField),
  };
};

template <>
struct Table<MujocoSoftness> {
  static constexpr std::string_view kWord = "softness";
  static constexpr Rows kFields{
      field<&MujocoSoftness::solref_limit>({.name = "solrefLimit",
                                            .meaning = "of the limit",
                                            .presence = Presence::WhenSet,
                                            .words = "solref of the limit"}),
      field<&MujocoSoftness::solimp_limit>({.name = "solimpLimit",
                                            .meaning = "of the limit",
                                            .presence = Presence::WhenSet,
                                            .words = "solimp of the limit"}),
      field<&MujocoSoftness::solref_friction>({.name = "solrefFriction",
                                               .meaning = "of friction",
                                               .presence = Presence::WhenSet,
                                               .words = "solref of friction"}),
      field<&MujocoSoftness::solimp_friction>({.name = "solimpFriction",
                                               .meaning = "of friction",
                                               .presence = Presence::WhenSet,
                                               .words = "solimp of friction"}),
  };
};

template <>
struct Table<MujocoLoop> {
  static constexpr std::string_view kWord = "loop";
  static constexpr Rows kFields{
      field<&MujocoLoop::solref>(
          {.name = "solref", .meaning = "of the constraint", .presence = Presence::WhenSet}),
      field<&MujocoLoop::solimp>(
          {.name = "solimp", .meaning = "of the constraint", .presence = Presence::WhenSet}),
      field<&MujocoLoop::torque_scale>({.name = "torqueScale",
                                        .meaning = "of a weld: what rotation weighs",
                                        .unit = Unit::Meter,
                                        .presence = Presence::WhenSet}),
  };
};

template <>
struct Table<JointParts> {
  static constexpr std::string_view kWord = "parts of vendors";
  static constexpr Rows kFields{
      field<&JointParts::mujoco>({.name = "mujoco",
                                  .meaning = "what MjcJointAPI authors",
                                  .presence = Presence::WhenSet,
                                  .words = "MuJoCo"}),
      field<&JointParts::mujoco_loop>(
          {.name = "mujocoLoop",
           .meaning = "what MjcEqualityConnectAPI or MjcEqualityWeldAPI authors",
           .presence = Presence::WhenSet,
           .words = "loop of MuJoCo"}),
  };
};

template <>
struct Table<Joint> {
  static constexpr std::string_view kWord = "joint";
  static constexpr Rows kFields{
      field<&Joint::path>({.name = "path", .meaning = "the prim", .role = Role::Identity}),
      field<&Joint::kind>(
          {.name = "type", .meaning = "which degrees of freedom it leaves", .words = "kind"}),
      field<&Joint::body0>({.name = "body0", .meaning = "null: world", .refers = List::Bodies}),
      field<&Joint::body1>({.name = "body1", .meaning = "null: world", .refers = List::Bodies}),
      field<&Joint::target0>({.name = "target0",
                              .meaning = "prim named by the relationship, may be static",
                              .presence = Presence::WhenSet,
                              .role = Role::Provenance}),
      field<&Joint::target1>({.name = "target1",
                              .meaning = "prim named by the relationship, may be static",
                              .presence = Presence::WhenSet,
                              .role = Role::Provenance}),
      field<&Joint::frame0>(
          {.name = "frame0", .meaning = "body0 <- joint, or world <- joint", .words = "in body 0"}),
      field<&Joint::frame1>(
          {.name = "frame1", .meaning = "body1 <- joint, or world <- joint", .words = "in body 1"}),
      field<&Joint::axis>(
          {.name = "axis", .meaning = "of the joint frame", .presence = Presence::Null}),
      field<&Joint::lower>({.name = "lower",
                            .meaning = "null: unlimited; above upper: locked",
                            .unit = Unit::Position,
                            .words = "lower limit"}),
      field<&Joint::upper>({.name = "upper",
                            .meaning = "null: unlimited",
                            .unit = Unit::Position,
                            .words = "upper limit"}),
      field<&Joint::cone_angle0>({.name = "coneAngle0",
                                  .meaning = "of spherical joints: toward the next axis",
                                  .unit = Unit::Radian,
                                  .presence = Presence::WhenSet}),
      field<&Joint::cone_angle1>({.name = "coneAngle1",
                                  .meaning = "of spherical joints: toward the one after",
                                  .unit = Unit::Radian,
                                  .presence = Presence::WhenSet}),
      field<&Joint::drives>(
          {.name = "drives", .meaning = "effort = stiffness (target - q) + damping (target - v)"}),
      field<&Joint::limits>({.name = "limits", .meaning = "of single degrees of freedom"}),
      field<&Joint::limit_springs>({.name = "limitSprings",
                                    .meaning = "how bounds give way or rebound",
                                    .presence = Presence::WhenSet}),
      field<&Joint::mimics>(
          {.name = "mimics", .meaning = "q = offset + multiplier * leader + higher powers"}),
      field<&Joint::enabled>({.name = "enabled", .meaning = "false: it holds nothing"}),
      field<&Joint::collision_enabled>({.name = "collisionEnabled",
                                        .meaning = "its bodies touch each other",
                                        .words = "bodies collide"}),
      field<&Joint::exclude_from_articulation>({.name = "excludeFromArticulation",
                                                .meaning = "it is not part of a tree",
                                                .words = "excluded from the articulation"}),
      field<&Joint::break_force>(
          {.name = "breakForce", .meaning = "null: it never breaks", .unit = Unit::Newton}),
      field<&Joint::break_torque>(
          {.name = "breakTorque", .meaning = "null: it never breaks", .unit = Unit::NewtonMeter}),
      field<&Joint::articulation>({.name = "articulation",
                                   .meaning = "that it is a joint of",
                                   .refers = List::Articulations}),
      field<&Joint::armature>(
          {.name = "armature", .meaning = "added to the inertia", .unit = Unit::Inertia}),
      field<&Joint::friction>(
          {.name = "friction", .meaning = "Coulomb friction", .unit = Unit::Effort}),
      field<&Joint::damping>({.name = "damping", .meaning = "passive", .unit = Unit::Damping}),
      field<&Joint::stiffness>(
          {.name = "stiffness", .meaning = "of the passive spring", .unit = Unit::Stiffness}),
      field<&Joint::spring_reference>({.name = "springReference",
                                       .meaning = "rest position of the passive spring",
                                       .unit = Unit::Position,
                                       .words = "rest position of the spring"}),
      field<&Joint::velocity_limit>(
          {.name = "velocityLimit", .meaning = "null: unlimited", .unit = Unit::Velocity}),
      field<&Joint::initial_position>(
          {.name = "initialPosition", .meaning = "null: from the poses", .unit = Unit::Position}),
      field<&Joint::initial_velocity>({.name = "initialVelocity",
                                       .meaning = "null: from the velocities",
                                       .unit = Unit::Velocity}),
      field<&Joint::parts>(kPartsField),
  };
};

template <>
struct Table<Articulation> {
  static constexpr std::string_view kWord = "articulation";
  static constexpr Rows kFields{
      field<&Articulation::path>({.name = "path", .meaning = "prim with the root API"}),
      field<&Articulation::root>({.name = "root",
                                  .meaning = "root body, or the joint that fixes it to the world",
                                  .role = Role::Identity}),
      field<&Articulation::fixed_base>({.name = "fixedBase",
                                        .meaning = "the root does not move",
                                        .words = "fixed to the world"}),
      field<&Articulation::links>({.name = "links",
                                   .meaning = "root first, then in path order",
                                   .refers = List::Bodies,
                                   .unordered = true}),
      field<&Articulation::joints>(
          {.name = "joints", .meaning = "of the tree", .refers = List::Joints, .unordered = true}),
      field<&Articulation::loop_joints>({.name = "loopJoints",
                                         .meaning = "closed by constraints, not part of the tree",
                                         .refers = List::Joints,
                                         .unordered = true,
                                         .words = "joints of loops"}),
      field<&Articulation::self_collision>({.name = "selfCollision",
                                            .meaning = "its links touch each other",
                                            .words = "self-collision"}),
      field<&Articulation::parts>(kPartsField),
  };
};

}  // namespace tenon::scene
