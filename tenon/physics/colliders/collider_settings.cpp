// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/collider_settings.h"

#include <algorithm>
#include <cmath>

namespace tenon::physics {
namespace {

double not_negative(const ReadState& state, const PhysicsPrim& found, Token name) {
  const double value = state.values.authored_number(found.prim, name).value_or(0);
  return std::isfinite(value) ? std::max(0.0, value) : 0;
}

/// As PhysX has it: linear by second, angular in degrees by second about the body's origin.
std::optional<SurfaceVelocity> surface_velocity(const ReadState& state, const stage::Prim& prim) {
  const AttributeValues& values = state.values;
  const auto flag = [&](const char* name) {
    return values.authored_flag(prim, name).value_or(true);
  };
  if (!flag("physxSurfaceVelocity:surfaceVelocityEnabled")) {
    return std::nullopt;
  }
  const Vec3d zero;
  SurfaceVelocity result;
  result.linear = values.vector(prim, "physxSurfaceVelocity:surfaceVelocity").value_or(zero) *
                  state.units.length;
  result.angular =
      values.vector(prim, "physxSurfaceVelocity:surfaceAngularVelocity").value_or(zero) * kRadians;
  result.body_axes = flag("physxSurfaceVelocity:surfaceVelocityLocalSpace");
  const bool moves = !(result.linear == zero && result.angular == zero);
  return moves ? std::optional(result) : std::nullopt;
}

}  // namespace

ColliderSettings read_collider_settings(ReadState& state, const PhysicsPrim& found,
                                        const Collider& collider) {
  ColliderSettings result;
  result.trigger = found.roles.has(Api::PhysxTrigger);
  if (found.roles.has(Api::PhysxCollision)) {
    result.torsional_patch =
        not_negative(state, found, "physxCollision:torsionalPatchRadius") * state.units.length;
    result.min_torsional_patch =
        not_negative(state, found, "physxCollision:minTorsionalPatchRadius") * state.units.length;
  }
  const PhysicsPrim* const body =
      collider.body ? &state.walk.prims[state.body_prims[*collider.body]] : nullptr;
  if (body != nullptr && body->roles.has(Api::PhysxSurfaceVelocity)) {
    result.surface_velocity = surface_velocity(state, body->prim);
  } else if (found.roles.has(Api::PhysxSurfaceVelocity)) {
    if (body == nullptr) {
      state.not_read(found.prim, "PhysxSurfaceVelocityAPI",
                     "PhysX gives velocities to surfaces of rigid bodies alone");
    } else {
      result.surface_velocity = surface_velocity(state, found.prim);
    }
  }
  return result;
}

Compliance read_compliance(const ReadState& state, const PhysicsPrim& found) {
  Compliance result;
  if (found.roles.has(Api::NewtonMaterial)) {
    result.stiffness = not_negative(state, found, "newton:contactStiffness") * state.units.mass;
    result.damping = not_negative(state, found, "newton:contactDamping") * state.units.mass;
  }
  const Token physx_stiffness("physxMaterial:compliantContactStiffness");
  if (!found.roles.has(Api::PhysxMaterial) ||
      (result.stiffness > 0 && !state.values.authored_number(found.prim, physx_stiffness))) {
    return result;
  }
  result.acceleration =
      state.values.authored_flag(found.prim, "physxMaterial:compliantContactAccelerationSpring")
          .value_or(false);
  const double mass = result.acceleration ? 1 : state.units.mass;
  result.stiffness = not_negative(state, found, physx_stiffness) * mass;
  result.damping = not_negative(state, found, "physxMaterial:compliantContactDamping") * mass;
  return result;
}

}  // namespace tenon::physics
