// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/prim_roles.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <utility>

#include "tenon/schema/registry.h"

namespace tenon::physics {
namespace {

struct KindOfType {
  const char* type;
  PrimKind kind;
};

/// Derived types stand before their bases: the first that fits counts.
constexpr KindOfType kKinds[] = {
    {"PhysicsScene", PrimKind::Scene},
    {"PhysicsCollisionGroup", PrimKind::CollisionGroup},
    {"PhysicsRevoluteJoint", PrimKind::RevoluteJoint},
    {"PhysicsPrismaticJoint", PrimKind::PrismaticJoint},
    {"PhysicsSphericalJoint", PrimKind::SphericalJoint},
    {"PhysicsFixedJoint", PrimKind::FixedJoint},
    {"PhysicsDistanceJoint", PrimKind::DistanceJoint},
    {"PhysxPhysicsGearJoint", PrimKind::GearJoint},
    {"PhysxPhysicsRackAndPinionJoint", PrimKind::RackJoint},
    {"PhysicsJoint", PrimKind::D6Joint},
    {"Cube", PrimKind::Cube},
    {"Sphere", PrimKind::Sphere},
    {"Capsule", PrimKind::Capsule},
    {"Capsule_1", PrimKind::Capsule1},
    {"Cylinder", PrimKind::Cylinder},
    {"Cylinder_1", PrimKind::Cylinder1},
    {"Cone", PrimKind::Cone},
    {"Plane", PrimKind::Plane},
    {"Points", PrimKind::Points},
    {"Mesh", PrimKind::Mesh},
    {"Gprim", PrimKind::OtherGprim},
    {"PointInstancer", PrimKind::PointInstancer},
    {"MjcActuator", PrimKind::Actuator},
    {"MjcTendon", PrimKind::Tendon},
    {"TenonMujocoSensor", PrimKind::MujocoSensor},
    {"IsaacContactSensor", PrimKind::ContactSensor},
    {"IsaacImuSensor", PrimKind::ImuSensor},
    {"IsaacRaycastSensor", PrimKind::RaycastSensor},
};

PrimKind kind_of(const stage::Prim& prim) {
  const Token type = prim.type_name();
  if (type.empty()) {
    return PrimKind::Other;
  }
  for (const KindOfType& row : kKinds) {
    if (type == row.type) {
      return row.kind;
    }
  }
  for (const KindOfType& row : kKinds) {
    if (prim.is_a(Token(row.type))) {
      return row.kind;
    }
  }
  return PrimKind::Other;
}

bool is_of_vendor(Token type, const std::vector<Token>& schemas) {
  const schema::Registry& registry = schema::Registry::instance();
  return registry.is_vendor(type) ||
         std::any_of(schemas.begin(), schemas.end(), [&](Token applied) {
           return registry.is_vendor(schema::split_api_name(applied).first);
         });
}

}  // namespace

Token meant_joint_type(std::string_view type) {
  constexpr std::string_view kOld = "PhysicsJoint";
  if (type.size() <= kOld.size() || !type.ends_with(kOld)) {
    return {};
  }
  return Token("Physics" + std::string(type.substr(0, type.size() - kOld.size())) + "Joint");
}

bool Roles::matters() const {
  constexpr std::uint64_t kNot = std::uint64_t{1} << static_cast<unsigned>(Api::MaterialBinding);
  const bool shape = kind >= PrimKind::Cube && kind <= PrimKind::OtherGprim;
  return (apis & ~kNot) != 0 || (kind != PrimKind::Other && !shape) || marked_sensor;
}

RoleFinder::RoleFinder() {
  static constexpr const char* kNames[] = {
#define TENON_API(enumerator, name) name,
#include "tenon/physics/api_schemas.def"
  };
  for (const char* name : kNames) {
    api_names_.emplace_back(name);
  }
}

const Roles& RoleFinder::roles_of(const stage::Prim& prim) {
  const auto found = known_.find(prim.definition());
  return found != known_.end()
             ? found->second
             : known_.emplace(prim.definition(), find(prim, prim.authored_api_schemas()))
                   .first->second;
}

Roles RoleFinder::find(const stage::Prim& prim, const std::vector<Token>& schemas) const {
  Roles roles;
  roles.kind = kind_of(prim);
  roles.xformable = prim.is_a(Token("Xformable"));
  roles.meant_type = meant_joint_type(prim.type_name().view());
  roles.vendor = is_of_vendor(prim.type_name(), schemas);
  for (std::size_t i = 0; i < api_names_.size(); ++i) {
    const std::string prefix = api_names_[i].str() + ":";
    bool has = prim.has_api(api_names_[i]);
    for (const Token& schema : schemas) {
      has = has || schema == api_names_[i] || schema.view().starts_with(prefix);
    }
    roles.apis |= std::uint64_t{has} << i;
  }
  return roles;
}

}  // namespace tenon::physics
