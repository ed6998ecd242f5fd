// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/prim.h"

namespace tenon::physics {

/// API schemas that the reader asks for; one bit each in Roles::apis.
enum class Api : std::uint8_t {
#define TENON_API(enumerator, name) enumerator,
#include "tenon/physics/api_schemas.def"
};

/// What a prim is by its type.
enum class PrimKind : std::uint8_t {
  Other,
  Scene,
  CollisionGroup,
  RevoluteJoint,
  PrismaticJoint,
  SphericalJoint,
  FixedJoint,
  DistanceJoint,
  D6Joint,
  Cube,
  Sphere,
  Capsule,
  Capsule1,
  Cylinder,
  Cylinder1,
  Cone,
  Plane,
  Points,
  Mesh,
  OtherGprim,
  PointInstancer,
  Actuator,
  Tendon,
  MujocoSensor,  ///< one of MuJoCo's models, beside the instrument that measures it
  GearJoint,     ///< of PhysX: couples two hinges
  RackJoint,     ///< of PhysX: couples a hinge and a slide
  ContactSensor,
  ImuSensor,
  RaycastSensor,
};

inline bool is_joint(PrimKind kind) {
  return kind >= PrimKind::RevoluteJoint && kind <= PrimKind::D6Joint;
}

/// What one prim means to physics: the same for all prims of one type with the same applied APIs.
struct Roles {
  std::uint64_t apis = 0;
  PrimKind kind = PrimKind::Other;
  bool xformable = false;
  bool marked_sensor = false;  ///< says with tenon:sensor what it measures; of this prim alone
  bool vendor = false;  ///< its type or an API of it is a vendor's (physx, newton, mjc, isaac)
  /// The joint type that an unknown type name such as "DistancePhysicsJoint" seems to mean, or "".
  Token meant_type;

  bool has(Api api) const { return (apis >> static_cast<unsigned>(api) & 1u) != 0; }
  /// The reader has something to do with this prim.
  bool matters() const;
};

/// The type that a name of older texts means, which call joints "<Kind>PhysicsJoint", or "".
Token meant_joint_type(std::string_view type);

/// Finds the roles of prims of one stage; asks the schemas once per combination of type and applied
/// APIs, which is what definitions of prims are made for.
class RoleFinder {
 public:
  RoleFinder();
  const Roles& roles_of(const stage::Prim& prim);

 private:
  Roles find(const stage::Prim& prim, const std::vector<Token>& schemas) const;

  std::vector<Token> api_names_;
  std::unordered_map<const schema::PrimDefinition*, Roles> known_;
};

}  // namespace tenon::physics
