// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A collider has a rigid frame: translation and rotation of its world matrix. The shape is read in
// that frame with scale and shear worked into its sizes or points, so its place on the body is a
// rigid pose and exact (S-51). Sizes, points and poses are checked for finite numbers at the end,
// because a product of finite ones may overflow. Of settings that several vendors author, Newton's
// come before PhysX's and MuJoCo's.
#include <algorithm>
#include <cmath>

#include "tenon/physics/colliders/collider_settings.h"
#include "tenon/physics/colliders/shapes.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/scenes.h"
#include "tenon/physics/vendors/mujoco_contacts.h"
#include "tenon/physics/world_pose.h"

namespace tenon::physics {
namespace {

void read_hull_vertices(const ReadState& state, const PhysicsPrim& found, Collider& collider) {
  const AttributeValues& values = state.values;
  const Roles& roles = found.roles;
  std::optional<double> vertices;
  if (roles.has(Api::NewtonMeshCollision) || roles.has(Api::MjcMeshCollision)) {
    vertices = values.authored_number(found.prim, state.tokens.newton_hull_vertices);
  }
  if (!vertices && roles.has(Api::PhysxConvexHull)) {
    vertices = values.authored_number(found.prim, state.tokens.physx_hull_vertices);
  }
  if (!vertices && roles.has(Api::MjcMeshCollision)) {
    vertices = values.authored_number(found.prim, state.tokens.mjc_hull_vertices);
  }
  if (vertices && *vertices >= 4 && *vertices < 1e6) {
    collider.max_hull_vertices = static_cast<int>(*vertices);
  }
}

/// Distances and hull sizes that vendors' APIs ask for: Newton before PhysX before MuJoCo.
void read_contact_settings(const ReadState& state, const PhysicsPrim& found, Collider& collider) {
  const PhysicsTokens& tokens = state.tokens;
  const Roles& roles = found.roles;
  const auto distance = [&](Token name) -> std::optional<double> {
    const std::optional<double> authored = state.values.authored_number(found.prim, name);
    return authored && std::isfinite(*authored)
               ? std::optional<double>(*authored * state.units.length)
               : std::nullopt;
  };
  // Newton and MuJoCo count the gap from where the contact begins to push.
  const auto take = [&](Token margin, Token gap) {
    if (!collider.rest_offset) {
      collider.rest_offset = distance(margin);
    }
    const std::optional<double> found_before = distance(gap);
    if (found_before && !collider.contact_offset) {
      collider.contact_offset = *found_before + collider.rest_offset.value_or(0);
    }
  };
  if (roles.has(Api::NewtonCollision) || roles.has(Api::MjcCollision)) {
    take(tokens.newton_contact_margin, tokens.newton_contact_gap);
  }
  if (roles.has(Api::PhysxCollision)) {
    if (!collider.contact_offset) {
      collider.contact_offset = distance(tokens.physx_contact_offset);
    }
    if (!collider.rest_offset) {
      collider.rest_offset = distance(tokens.physx_rest_offset);
    }
  }
  if (roles.has(Api::MjcCollision)) {
    take(tokens.mjc_margin, tokens.mjc_gap);
    collider.parts.mujoco = read_mujoco_contact(state, found);
  }
  read_hull_vertices(state, found, collider);
}

bool has_zero_scale(const ReadState& state, const PhysicsPrim& found, const Factored& parts) {
  if (found.roles.kind == PrimKind::Plane) {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(std::fabs(parts.scale[i]) > 1e-12)) {
      state.report(found.prim, Severity::Error, "collider.zero-scale",
                   "the shape is scaled to nothing along an axis; it does not collide",
                   "author a scale that is not zero");
      return true;
    }
  }
  return false;
}

void check_apis(const ReadState& state, const PhysicsPrim& found) {
  if (found.roles.has(Api::Material)) {
    // S-74
    state.report(found.prim, Severity::Error, "collider.is-material",
                 "PhysicsMaterialAPI on a collider is ignored",
                 "apply it to a Material prim and bind that", api_part("PhysicsMaterialAPI"));
  }
  if (found.roles.has(Api::MeshCollision) && found.roles.kind != PrimKind::Mesh) {
    // S-63
    state.report(found.prim, Severity::Warning, "collider.mesh-api-ignored",
                 "PhysicsMeshCollisionAPI on a prim that is not a Mesh is ignored", "remove it",
                 api_part("PhysicsMeshCollisionAPI"));
  }
}

/// Pose of the collider's rigid frame in that of its body, or in the world (S-51).
Pose offset_of(const ReadState& state, const ShapeSource& source, const Collider& collider) {
  if (!collider.body) {
    return source.frame;
  }
  const PhysicsPrim& body = state.prim_of_body(*collider.body);
  if (state.readings.sheared_offsets == ShearedOffsets::Exact || &body == &source.found) {
    return inverse(state.scene.bodies[*collider.body].pose) * source.frame;
  }
  // As OpenUSD: the offset in the body's own space, scaled along its axes (S-33).
  Pose pose = rigid_part(source.found.world * inverse(body.world));
  const Vec3d scale = factor(body.world).scale;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.position[i] *= scale[i] * state.units.length;
  }
  return pose;
}

/// Sizes, points and pose are numbers that an engine can use; overflow leaves others behind.
bool is_finite_shape(ReadState& state, const Shape& shape) {
  const auto finite = [](const Vec3d& v) { return is_finite(v); };
  bool usable = is_finite(shape.half_extents) &&
                is_finite(Vec3d{{shape.radius, shape.half_height, 0}}) &&
                std::all_of(shape.sphere_centers.begin(), shape.sphere_centers.end(), finite) &&
                std::all_of(shape.sphere_radii.begin(), shape.sphere_radii.end(),
                            [](double r) { return std::isfinite(r); });
  if (shape.kind == ShapeKind::ConvexHull || shape.kind == ShapeKind::Mesh) {
    usable = usable && state.shared_meshes.has_finite_points(shape.mesh, state.scene.meshes);
  }
  return usable;
}

/// Of a collider whose body has no place that is said already.
void report_not_finite(const ReadState& state, const PhysicsPrim& found) {
  if (found.body != kNone && !state.has_place(state.body_of_prim[found.body])) {
    return;
  }
  state.report(found.prim, Severity::Error, "collider.not-finite",
               "the shape's sizes or its place are not finite numbers; it does not collide",
               "author finite sizes, points and transforms");
}

/// What the caller says that an enabled collider weighs (M-20); of a prim that is no shape, one
/// that touches nothing.
std::optional<ShapeReading> told_shape(ReadState& state, const PhysicsPrim& found,
                                       std::optional<ShapeReading> own) {
  if (state.integrals == nullptr ||
      !state.values.flag(found.prim, state.tokens.collision_enabled, true)) {
    return own;
  }
  const std::optional<SolidIntegrals> told = (*state.integrals)(found.prim);
  if (!told) {
    return own;
  }
  if (!own) {
    own.emplace().shape.kind = ShapeKind::Spheres;
  }
  own->integrals = placed(*told, inverse(own->pose));
  return own;
}

}  // namespace

std::optional<Collider> read_collider(ReadState& state, const PhysicsPrim& found,
                                      std::optional<SolidIntegrals>& integrals) {
  check_apis(state, found);
  ShapeSource source{found, factor(found.world), {}, false, false};
  source.frame = {source.parts.translation * state.units.length,
                  rotation_of(source.parts.rotation)};
  if (!is_finite(source.frame)) {
    report_not_finite(state, found);
    return std::nullopt;
  }
  if (has_zero_scale(state, found, source.parts)) {
    return std::nullopt;
  }
  Collider collider;
  collider.path = found.path;
  if (found.body != kNone) {
    collider.body = state.body_of_prim[found.body];
    collider.scene = state.scene.bodies[*collider.body].scene;  // S-20
    source.on_body = true;
    source.dynamic = state.is_dynamic(*collider.body);
  } else {
    const OwnerScene owner = owner_scene(state, found.prim, default_scene(state));
    collider.scene = owner.scene;
  }
  state.values.note_asked(&state.sizes);
  std::optional<ShapeReading> own = read_shape(state, source);
  state.values.note_asked(nullptr);
  std::optional<ShapeReading> reading = told_shape(state, found, std::move(own));
  if (!reading) {
    return std::nullopt;
  }
  collider.pose = offset_of(state, source, collider) * reading->pose;
  if (!is_finite(collider.pose) || !is_finite_shape(state, reading->shape)) {
    report_not_finite(state, found);
    return std::nullopt;
  }
  collider.shape = std::move(reading->shape);
  collider.enabled = state.values.flag(found.prim, state.tokens.collision_enabled, true);
  collider.approximation = reading->approximation;
  integrals = reading->integrals;
  read_contact_settings(state, found, collider);
  collider.settings = read_collider_settings(state, found, collider);
  return collider;
}

namespace {

/// S-63
void report_lone_mesh_apis(const ReadState& state) {
  for (const PhysicsPrim& found : state.walk.prims) {
    if (found.roles.has(Api::MeshCollision) && !found.roles.has(Api::Collision)) {
      state.report(found.prim, Severity::Warning, "collider.mesh-api-alone",
                   "PhysicsMeshCollisionAPI without PhysicsCollisionAPI is not a collider",
                   "apply PhysicsCollisionAPI too, or remove it",
                   api_part("PhysicsMeshCollisionAPI"));
    }
  }
}

}  // namespace

void read_colliders(ReadState& state) {
  report_lone_mesh_apis(state);
  state.collider_of_prim.assign(state.walk.prims.size(), kNone);
  const auto prims =
      sorted_prims(state.walk, [](const PhysicsPrim& p) { return p.roles.has(Api::Collision); });
  state.scene.colliders.reserve(prims.size());
  for (const std::uint32_t i : prims) {
    std::optional<SolidIntegrals> integrals;
    std::optional<Collider> collider = read_collider(state, state.walk.prims[i], integrals);
    if (!collider) {
      continue;
    }
    const auto index = static_cast<Index>(state.scene.colliders.size());
    if (collider->body) {
      state.colliders_of_body[*collider->body].push_back(index);
    }
    if (integrals) {
      state.integrals_of_collider.emplace(index, *integrals);
    }
    state.collider_of_prim[i] = index;
    state.collider_prims.push_back(i);
    state.scene.colliders.push_back(*std::move(collider));
  }
}

}  // namespace tenon::physics
