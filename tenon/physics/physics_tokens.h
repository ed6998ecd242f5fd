// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/token.h"

namespace tenon::physics {

/// Property names that are looked up for every prim, interned once.
struct PhysicsTokens {
  Token sensor{"tenon:sensor"};  // what a prim measures
  // PhysicsScene and the vendors' scene APIs
  Token gravity_direction{"physics:gravityDirection"};
  Token gravity_magnitude{"physics:gravityMagnitude"};
  Token newton_gravity_enabled{"newton:gravityEnabled"};
  Token newton_steps{"newton:timeStepsPerSecond"};
  Token physx_steps{"physxScene:timeStepsPerSecond"};
  Token mjc_time_step{"mjc:option:timestep"};
  // bodies
  Token body_enabled{"physics:rigidBodyEnabled"};
  Token kinematic{"physics:kinematicEnabled"};
  Token starts_asleep{"physics:startsAsleep"};
  Token velocity{"physics:velocity"};
  Token angular_velocity{"physics:angularVelocity"};
  Token simulation_owner{"physics:simulationOwner"};
  Token physx_linear_damping{"physxRigidBody:linearDamping"};
  Token physx_angular_damping{"physxRigidBody:angularDamping"};
  Token physx_disable_gravity{"physxRigidBody:disableGravity"};
  Token gravity_scale{"tenon:gravityScale"};
  // mass
  Token mass{"physics:mass"};
  Token density{"physics:density"};
  Token center_of_mass{"physics:centerOfMass"};
  Token diagonal_inertia{"physics:diagonalInertia"};
  Token principal_axes{"physics:principalAxes"};
  Token newton_inertia{"newton:inertia"};
  // colliders
  Token collision_enabled{"physics:collisionEnabled"};
  Token approximation{"physics:approximation"};
  Token ellipsoid{"tenon:ellipsoid"};
  Token physx_contact_offset{"physxCollision:contactOffset"};
  Token physx_rest_offset{"physxCollision:restOffset"};
  Token newton_contact_gap{"newton:contactGap"};
  Token newton_contact_margin{"newton:contactMargin"};
  Token physx_hull_vertices{"physxConvexHullCollision:hullVertexLimit"};
  Token newton_hull_vertices{"newton:maxHullVertices"};
  Token mjc_gap{"mjc:gap"};
  Token mjc_margin{"mjc:margin"};
  Token mjc_hull_vertices{"mjc:maxhullvert"};
  Token newton_torsional_friction{"newton:torsionalFriction"};
  Token newton_rolling_friction{"newton:rollingFriction"};
  Token mjc_torsional_friction{"mjc:torsionalfriction"};
  Token mjc_rolling_friction{"mjc:rollingfriction"};
  // shapes
  Token size{"size"};
  Token radius{"radius"};
  Token radius_top{"radiusTop"};
  Token radius_bottom{"radiusBottom"};
  Token height{"height"};
  Token axis{"axis"};
  Token points{"points"};
  Token widths{"widths"};
  Token primvar_widths{"primvars:widths"};
  Token face_counts{"faceVertexCounts"};
  Token face_indices{"faceVertexIndices"};
  Token hole_indices{"holeIndices"};
  Token orientation{"orientation"};
  Token subdivision_scheme{"subdivisionScheme"};
  // materials
  Token static_friction{"physics:staticFriction"};
  Token dynamic_friction{"physics:dynamicFriction"};
  Token restitution{"physics:restitution"};
  Token physx_friction_combine{"physxMaterial:frictionCombineMode"};
  Token physx_restitution_combine{"physxMaterial:restitutionCombineMode"};
  // joints
  Token body0{"physics:body0"};
  Token body1{"physics:body1"};
  Token local_pos0{"physics:localPos0"};
  Token local_pos1{"physics:localPos1"};
  Token local_rot0{"physics:localRot0"};
  Token local_rot1{"physics:localRot1"};
  Token joint_enabled{"physics:jointEnabled"};
  Token exclude{"physics:excludeFromArticulation"};
  Token break_force{"physics:breakForce"};
  Token break_torque{"physics:breakTorque"};
  Token joint_axis{"physics:axis"};
  Token lower_limit{"physics:lowerLimit"};
  Token upper_limit{"physics:upperLimit"};
  Token cone_angle0{"physics:coneAngle0Limit"};
  Token cone_angle1{"physics:coneAngle1Limit"};
  Token min_distance{"physics:minDistance"};
  Token max_distance{"physics:maxDistance"};
  // filters
  Token filtered_pairs{"physics:filteredPairs"};
  Token filtered_groups{"physics:filteredGroups"};
  Token invert_groups{"physics:invertFilteredGroups"};
  Token merge_group{"physics:mergeGroup"};
  // articulations
  Token newton_self_collision{"newton:selfCollisionEnabled"};
  Token physx_self_collision{"physxArticulation:enabledSelfCollisions"};
};

inline const PhysicsTokens& physics_tokens() {
  static const PhysicsTokens tokens;
  return tokens;
}

}  // namespace tenon::physics
