// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the asset says and the description does not hold: vendors' settings, per-face materials,
// point instancers. Listed, so that nothing is lost in silence.
#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>

#include "tenon/physics/read_state.h"

namespace tenon::physics {
namespace {

/// Properties that some pass reads; a '*' stands for one instance name.
constexpr std::string_view kRead[] = {"mjc:armature",
                                      "mjc:biasPrm",
                                      "mjc:biasType",
                                      "mjc:coef0",
                                      "mjc:coef1",
                                      "mjc:coef2",
                                      "mjc:coef3",
                                      "mjc:coef4",
                                      "mjc:condim",
                                      "mjc:damping",
                                      "mjc:dynType",
                                      "mjc:forceRange:max",
                                      "mjc:forceRange:min",
                                      "mjc:frictionloss",
                                      "mjc:gainPrm",
                                      "mjc:gainType",
                                      "mjc:gap",
                                      "mjc:gear",
                                      "mjc:margin",
                                      "mjc:maxhullvert",
                                      "mjc:priority",
                                      "mjc:ref",
                                      "mjc:rollingfriction",
                                      "mjc:solimp",
                                      "mjc:solimpfriction",
                                      "mjc:solimplimit",
                                      "mjc:solmix",
                                      "mjc:solref",
                                      "mjc:solreffriction",
                                      "mjc:solreflimit",
                                      "mjc:springref",
                                      "mjc:stiffness",
                                      "mjc:target",
                                      "mjc:torsionalfriction",
                                      "newton:armature",
                                      "newton:contactGap",
                                      "newton:contactMargin",
                                      "newton:damping",
                                      "newton:friction",
                                      "newton:gravityEnabled",
                                      "newton:inertia",
                                      "newton:maxHullVertices",
                                      "newton:mimicCoef0",
                                      "newton:mimicCoef1",
                                      "newton:mimicEnabled",
                                      "newton:mimicJoint",
                                      "newton:rollingFriction",
                                      "newton:selfCollisionEnabled",
                                      "newton:timeStepsPerSecond",
                                      "newton:torsionalFriction",
                                      "newton:velocityLimit",
                                      "physxArticulation:enabledSelfCollisions",
                                      "physxCollision:contactOffset",
                                      "physxCollision:restOffset",
                                      "physxConvexDecompositionCollision:hullVertexLimit",
                                      "physxConvexDecompositionCollision:maxConvexHulls",
                                      "physxConvexHullCollision:hullVertexLimit",
                                      "physxJoint:armature",
                                      "physxJoint:jointFriction",
                                      "physxJoint:maxJointVelocity",
                                      "physxJointAxis:*:armature",
                                      "physxJointAxis:*:dynamicFrictionEffort",
                                      "physxJointAxis:*:maxJointVelocity",
                                      "physxJointAxis:*:staticFrictionEffort",
                                      "physxJointAxis:*:viscousFrictionCoefficient",
                                      "physxMaterial:frictionCombineMode",
                                      "physxMaterial:restitutionCombineMode",
                                      "physxMimicJoint:*:dampingRatio",
                                      "physxMimicJoint:*:gearing",
                                      "physxMimicJoint:*:naturalFrequency",
                                      "physxMimicJoint:*:offset",
                                      "physxMimicJoint:*:referenceJoint",
                                      "physxMimicJoint:*:referenceJointAxis",
                                      "physxRigidBody:angularDamping",
                                      "physxRigidBody:disableGravity",
                                      "physxRigidBody:linearDamping",
                                      "physxScene:timeStepsPerSecond"};

bool is_vendor(std::string_view name) {
  return name.starts_with("physx") || name.starts_with("newton:") || name.starts_with("mjc:");
}

/// "physxMimicJoint:rotX:gearing" -> "physxMimicJoint:*:gearing" for instances of multiple-apply
/// APIs.
std::string without_instance(std::string_view name) {
  const std::size_t first = name.find(':');
  const std::size_t last = name.rfind(':');
  const std::string_view space = name.substr(0, first);
  if (first == last || (space != "physxJointAxis" && space != "physxMimicJoint")) {
    return std::string(name);
  }
  return std::string(space) + ":*" + std::string(name.substr(last));
}

bool is_read(std::string_view name) {
  return name.starts_with("mjc:option:") || name.starts_with("mjc:flag:") ||
         std::binary_search(std::begin(kRead), std::end(kRead), without_instance(name));
}

bool has_vendor_role(const Roles& roles) {
  constexpr Api kVendors[] = {Api::NewtonScene,
                              Api::NewtonMass,
                              Api::NewtonMaterial,
                              Api::MjcMaterial,
                              Api::NewtonCollision,
                              Api::NewtonMeshCollision,
                              Api::NewtonJoint,
                              Api::NewtonMimic,
                              Api::PhysxScene,
                              Api::PhysxRigidBody,
                              Api::PhysxCollision,
                              Api::PhysxConvexHull,
                              Api::PhysxMaterial,
                              Api::PhysxJoint,
                              Api::PhysxJointAxis,
                              Api::PhysxMimicJoint,
                              Api::PhysxArticulation,
                              Api::MjcScene,
                              Api::MjcCollision,
                              Api::MjcMeshCollision,
                              Api::MjcJoint,
                              Api::MjcEqualityJoint,
                              Api::NewtonArticulationRoot};
  return roles.kind == PrimKind::Actuator || std::any_of(std::begin(kVendors), std::end(kVendors),
                                                         [&](Api api) { return roles.has(api); });
}

void note_vendor_settings(ReadState& state, const PhysicsPrim& found) {
  if (!has_vendor_role(found.roles)) {
    return;
  }
  for (const Token& name : found.prim.authored_property_names()) {
    if (is_vendor(name.view()) && !is_read(name.view())) {
      state.not_read(found.prim, name.str(), "a setting of one engine without a neutral meaning");
    }
  }
}

/// S-38: bodies and colliders below a point instancer that is passed over.
void note_instancer(ReadState& state, const PhysicsPrim& found) {
  if (state.readings.point_instancers == PointInstancers::Expand) {
    return;
  }
  std::vector<stage::Prim> pending = found.prim.children();
  while (!pending.empty()) {
    const stage::Prim prim = pending.back();
    pending.pop_back();
    if (prim.has_api("PhysicsRigidBodyAPI") || prim.has_api("PhysicsCollisionAPI")) {
      state.not_read(found.prim, "prototypes",
                     "as asked, instances of a point instancer are not simulated");
      state.report(
          found.prim, Severity::Warning, "point-instancer.readings",
          "the point instancer has prototypes with physics; as asked, it is passed over like by "
          "OpenUSD's parser",
          "use instanceable references, which all readers take alike");
      return;
    }
    const std::vector<stage::Prim> children = prim.children();
    pending.insert(pending.end(), children.begin(), children.end());
  }
}

}  // namespace

void note_what_is_not_read(ReadState& state) {
  std::unordered_set<Path> prototypes;  // prims of point instancers are said of once
  for (const PhysicsPrim& found : state.walk.prims) {
    if (found.instance != kNone && !prototypes.insert(found.prim.path()).second) {
      continue;
    }
    note_vendor_settings(state, found);
    if (found.roles.kind == PrimKind::PointInstancer) {
      note_instancer(state, found);
    }
  }
  std::stable_sort(state.scene.not_read.begin(), state.scene.not_read.end(),
                   [](const NotRead& a, const NotRead& b) { return a.prim < b.prim; });
}

}  // namespace tenon::physics
