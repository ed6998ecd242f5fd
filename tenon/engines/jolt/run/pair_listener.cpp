// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Jolt has one coefficient of friction for a pair: where the surfaces are at rest against each
// other it is that of static friction, else that of dynamic friction.
#include "tenon/engines/jolt/run/pair_listener.h"

#include <algorithm>

#include <Jolt/Physics/Body/Body.h>
#include <Jolt/Physics/Collision/CollideShape.h>

#include "tenon/engines/jolt/convert.h"

namespace tenon::engines::jolt {
namespace {

using scene::Index;

constexpr JPH::CollisionGroup::GroupID kStatic = 0x7fffffff;
constexpr float kAtRest = 1e-3F;  ///< [m/s] slower surfaces do not slide

Index collider_of(const JPH::Body& body, const JPH::SubShapeID& part) {
  return index_of(body.GetShape()->GetSubShapeUserData(part)).value_or(0);
}

bool exerts(const scene::PhysicsScene& scene, Index collider) {
  const scene::Collider& source = scene.colliders[collider];
  return !source.settings.trigger &&
         (!source.body.has_value() || scene.bodies[*source.body].settings.solves_contacts);
}

/// Adds what the surface of a collider moves at, as Jolt counts it: about the first body's centre.
void add_surface(const scene::PhysicsScene& scene, Index collider, const JPH::Body& body,
                 JPH::RVec3Arg center, float sign, JPH::ContactSettings& settings) {
  const std::optional<scene::SurfaceVelocity>& surface =
      scene.colliders[collider].settings.surface_velocity;
  if (!surface.has_value()) {
    return;
  }
  const JPH::Quat turn = surface->body_axes ? body.GetRotation() : JPH::Quat::sIdentity();
  const JPH::Vec3 linear = turn * to_jolt(surface->linear);
  const JPH::Vec3 angular = turn * to_jolt(surface->angular);
  const JPH::Vec3 arm(center - body.GetPosition());
  settings.mRelativeLinearSurfaceVelocity += sign * (linear + angular.Cross(arm));
  settings.mRelativeAngularSurfaceVelocity += sign * angular;
}

}  // namespace

BodyFilter::BodyFilter(const scene::PhysicsScene& scene)
    : scene_(scene), first_(scene.bodies.size() + 1, 0) {
  for (const scene::Collider& collider : scene.colliders) {
    if (collider.body.has_value()) {
      ++first_[*collider.body + 1];
    }
  }
  for (std::size_t b = 1; b < first_.size(); ++b) {
    first_[b] += first_[b - 1];
  }
  colliders_.resize(first_.back() + scene.colliders.size());
  std::vector<std::size_t> next = first_;
  for (Index c = 0; c < scene.colliders.size(); ++c) {
    if (const std::optional<Index>& body = scene.colliders[c].body) {
      colliders_[next[*body]++] = c;
    }
    colliders_[first_.back() + c] = c;
  }
}

JPH::CollisionGroup BodyFilter::group_of_body(Index body) const { return {this, body, 0}; }
JPH::CollisionGroup BodyFilter::group_of_collider(Index collider) const {
  return {this, kStatic, collider};
}

std::span<const Index> BodyFilter::colliders_of(const JPH::CollisionGroup& group) const {
  const std::span<const Index> all(colliders_);
  if (group.GetGroupID() == kStatic) {
    return all.subspan(first_.back() + group.GetSubGroupID(), 1);
  }
  const std::size_t first = first_[group.GetGroupID()];
  return all.subspan(first, first_[group.GetGroupID() + 1] - first);
}

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
bool BodyFilter::CanCollide(const JPH::CollisionGroup& a, const JPH::CollisionGroup& b) const {
  for (const Index one : colliders_of(a)) {
    for (const Index other : colliders_of(b)) {
      if (scene_.may_meet(one, other)) {
        return true;
      }
    }
  }
  return false;
}

PairListener::PairListener(const scene::PhysicsScene& scene, bool keeps_contacts)
    : scene_(scene), keeps_contacts_(keeps_contacts) {
  const auto more_at_rest = [](const scene::Material& material) {
    return material.static_friction > material.dynamic_friction;
  };
  holds_at_rest_ = more_at_rest(scene.unbound) ||
                   std::any_of(scene.materials.begin(), scene.materials.end(), more_at_rest);
}

void PairListener::begin_step(std::span<JPH::Body* const> bodies) {
  motions_.clear();
  for (std::size_t b = 0; holds_at_rest_ && b < bodies.size(); ++b) {
    motions_.push_back({bodies[b]->GetLinearVelocity(), bodies[b]->GetAngularVelocity()});
  }
  inside_.clear();
  manifolds_.clear();
  touching_ = 0;
}

JPH::ValidateResult PairListener::OnContactValidate(const JPH::Body& body1, const JPH::Body& body2,
                                                    JPH::RVec3Arg /*base*/,
                                                    const JPH::CollideShapeResult& hit) {
  const Index one = collider_of(body1, hit.mSubShapeID1);
  const Index other = collider_of(body2, hit.mSubShapeID2);
  return scene_.may_meet(one, other) ? JPH::ValidateResult::AcceptContact
                                     : JPH::ValidateResult::RejectContact;
}

const scene::Material& PairListener::material_of(const JPH::Body& body,
                                                 const JPH::SubShapeID& part) const {
  const auto named = [&](const std::optional<Index>& material) -> const scene::Material& {
    return material.has_value() ? scene_.materials[*material] : scene_.unbound;
  };
  const scene::Collider& collider = scene_.colliders[collider_of(body, part)];
  if (!collider.face_materials.empty() && collider.shape.kind == scene::ShapeKind::Mesh) {
    const JPH::PhysicsMaterial* face = body.GetShape()->GetMaterial(part);
    if (face != nullptr && face != JPH::PhysicsMaterial::sDefault) {
      return named(static_cast<const FaceSurface*>(face)->material());
    }
  }
  return named(collider.material);
}

// Jolt asks when forces have already acted on the bodies: what they moved at before is kept.
JPH::Vec3 PairListener::speed_before(const JPH::Body& body, JPH::RVec3Arg point) const {
  const std::optional<Index> index = index_of(body.GetUserData());
  if (!index.has_value() || body.IsKinematic()) {
    return body.GetPointVelocity(point);
  }
  const Motion& motion = motions_[*index];
  const JPH::Vec3 arm(point - body.GetCenterOfMassPosition());
  return motion.linear + motion.angular.Cross(arm);
}

bool PairListener::at_rest(const JPH::Body& body1, const JPH::Body& body2,
                           const JPH::ContactManifold& manifold) const {
  if (!holds_at_rest_) {
    return false;
  }
  const JPH::RVec3 point = manifold.GetWorldSpaceContactPointOn1(0);
  const JPH::Vec3 speed = speed_before(body2, point) - speed_before(body1, point);
  const JPH::Vec3 normal = manifold.mWorldSpaceNormal;
  return (speed - normal * normal.Dot(speed)).Length() < kAtRest;
}

void PairListener::set_surface(const JPH::Body& body1, const JPH::Body& body2,
                               const JPH::ContactManifold& manifold,
                               JPH::ContactSettings& settings) const {
  const scene::Material& one = material_of(body1, manifold.mSubShapeID1);
  const scene::Material& other = material_of(body2, manifold.mSubShapeID2);
  const JPH::RVec3 center = body1.GetCenterOfMassPosition();
  const Index collider1 = collider_of(body1, manifold.mSubShapeID1);
  const Index collider2 = collider_of(body2, manifold.mSubShapeID2);
  add_surface(scene_, collider1, body1, center, -1, settings);
  add_surface(scene_, collider2, body2, center, 1, settings);
  const bool rests = at_rest(body1, body2, manifold);
  const auto friction = [&](const scene::Material& material, Index collider) {
    const auto set = friction_.find(collider);
    if (set != friction_.end()) {
      return set->second;
    }
    return rests ? std::max(material.static_friction, material.dynamic_friction)
                 : material.dynamic_friction;
  };
  settings.mCombinedFriction =
      to_jolt(scene::combine(friction(one, collider1), one.friction_combine,
                             friction(other, collider2), other.friction_combine));
  settings.mCombinedRestitution = to_jolt(scene::combine(
      one.restitution, one.restitution_combine, other.restitution, other.restitution_combine));
}

void PairListener::keep(const JPH::Body& body1, const JPH::Body& body2,
                        const JPH::ContactManifold& manifold) {
  Manifold kept;
  kept.collider1 = collider_of(body1, manifold.mSubShapeID1);
  kept.collider2 = collider_of(body2, manifold.mSubShapeID2);
  kept.normal = from_jolt(manifold.mWorldSpaceNormal);
  for (JPH::uint i = 0; i < manifold.mRelativeContactPointsOn1.size(); ++i) {
    const Vec3d on1 = from_jolt(manifold.GetWorldSpaceContactPointOn1(i));
    const Vec3d on2 = from_jolt(manifold.GetWorldSpaceContactPointOn2(i));
    kept.points.push_back({(on1 + on2) * 0.5, dot(on1 - on2, kept.normal)});
  }
  manifolds_[JPH::SubShapeIDPair(body1.GetID(), manifold.mSubShapeID1, body2.GetID(),
                                 manifold.mSubShapeID2)] = std::move(kept);
}

void PairListener::OnContactAdded(const JPH::Body& body1, const JPH::Body& body2,
                                  const JPH::ContactManifold& manifold,
                                  JPH::ContactSettings& settings) {
  const Index one = collider_of(body1, manifold.mSubShapeID1);
  const Index other = collider_of(body2, manifold.mSubShapeID2);
  const bool touches = manifold.mPenetrationDepth >= 0;
  if (!exerts(scene_, one) || !exerts(scene_, other)) {
    settings.mIsSensor = true;
    const auto passes = [&](Index trigger, Index body) {
      if (touches && scene_.colliders[trigger].settings.trigger) {
        inside_.emplace(trigger, body);
      }
    };
    passes(one, other);
    passes(other, one);
    return;
  }
  if (!body1.IsDynamic() && !body2.IsDynamic()) {
    return;  // both are moved by the asset
  }
  touching_ += touches ? manifold.mRelativeContactPointsOn1.size() : 0;
  set_surface(body1, body2, manifold, settings);
  if (keeps_contacts_) {
    keep(body1, body2, manifold);
  }
}

void PairListener::OnContactPersisted(const JPH::Body& body1, const JPH::Body& body2,
                                      const JPH::ContactManifold& manifold,
                                      JPH::ContactSettings& settings) {
  OnContactAdded(body1, body2, manifold, settings);
}
// NOLINTEND(readability-identifier-naming)

}  // namespace tenon::engines::jolt
