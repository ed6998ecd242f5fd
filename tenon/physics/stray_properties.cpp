// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/stray_properties.h"

#include <vector>

namespace tenon::physics {
namespace {

/// Properties that count only where their API is applied.
struct ApiProperties {
  Api api;
  const char* api_name;
  std::vector<Token> names;
};

const std::vector<ApiProperties>& api_properties() {
  static const std::vector<ApiProperties> list{
      {Api::RigidBody,
       "PhysicsRigidBodyAPI",
       {"physics:rigidBodyEnabled", "physics:kinematicEnabled", "physics:velocity",
        "physics:angularVelocity", "physics:startsAsleep"}},
      {Api::Mass,
       "PhysicsMassAPI",
       {"physics:mass", "physics:centerOfMass", "physics:diagonalInertia",
        "physics:principalAxes"}},
      {Api::Collision, "PhysicsCollisionAPI", {"physics:collisionEnabled"}},
      {Api::FilteredPairs, "PhysicsFilteredPairsAPI", {"physics:filteredPairs"}},
      {Api::Material,
       "PhysicsMaterialAPI",
       {"physics:dynamicFriction", "physics:staticFriction", "physics:restitution"}}};
  return list;
}

/// Names without the prefix that the schema wants.
const std::vector<Token>& unprefixed(const Roles& roles) {
  static const std::vector<Token> material{"staticFriction", "dynamicFriction", "restitution",
                                           "density"};
  static const std::vector<Token> body{"velocity", "angularVelocity", "mass"};
  static const std::vector<Token> none;
  return roles.has(Api::Material) ? material : roles.has(Api::RigidBody) ? body : none;
}

void report_ignored(const AttributeValues& values, const stage::Prim& prim,
                    const ApiProperties& row) {
  std::string names;
  Token first;
  for (const Token name : row.names) {
    if (prim.has_property(name)) {
      first = first.empty() ? name : first;
      names += (names.empty() ? "" : ", ") + name.str();
    }
  }
  if (!first.empty()) {
    values.report(prim, first, Severity::Warning, "attribute.api-missing",
                  names + (names.find(',') == std::string::npos ? " is" : " are") +
                      " ignored: " + row.api_name + " is not applied",
                  std::string("apply ") + row.api_name);
  }
}

}  // namespace

void report_stray_properties(const AttributeValues& values, const stage::Prim& prim,
                             const Roles& roles) {
  for (const ApiProperties& row : api_properties()) {
    if (!roles.has(row.api)) {
      report_ignored(values, prim, row);
    }
  }
  for (const Token name : unprefixed(roles)) {
    if (prim.has_property(name)) {
      values.report(prim, name, Severity::Warning, "attribute.unprefixed",
                    name.str() + " is ignored: the schema's name is physics:" + name.str(),
                    "write physics:" + name.str());
    }
  }
  if (!roles.meant_type.empty()) {
    report(values.diagnostics(), prim, Severity::Warning, "joint.unknown-type",
           "there is no type \"" + prim.type_name().str() + "\"; the joint is left out",
           "write " + roles.meant_type.str(), type_part());
  }
}

}  // namespace tenon::physics
