// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX's normals point from the second shape to the first; ours go from the collider of the lower
// index to the other. Friction acts on patches of points with one normal, and is shared out among
// them as the normal forces are.
#include "tenon/engines/physx/run/step_events.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "tenon/engines/physx/convert.h"

// NOLINTBEGIN(readability-identifier-naming): names of PhysX
namespace tenon::engines::physx {
namespace {

constexpr px::PxU32 kMostPoints = 256;
constexpr double kSameNormal = 0.999;  // cosine between those of a patch and of its points

Vec3d carried_velocity(const scene::PhysicsScene& scene, scene::Index collider,
                       const px::PxTransform& pose, const px::PxVec3& point) {
  const std::optional<scene::SurfaceVelocity>& surface =
      scene.colliders[collider].settings.surface_velocity;
  if (!surface.has_value()) {
    return {};
  }
  const Pose body = from_px(pose);
  const bool turns = surface->body_axes;
  const Vec3d linear = turns ? rotate(body.orientation, surface->linear) : surface->linear;
  const Vec3d angular = turns ? rotate(body.orientation, surface->angular) : surface->angular;
  return linear + cross(angular, from_px(point) - body.position);
}

}  // namespace

void StepEvents::clear() {
  contacts.clear();
  happened = {};
}

void StepEvents::begin_scene(bool with_contacts) {
  runtime_->functions->watch_friction(with_contacts);
  sorted_ = false;
}

void StepEvents::onConstraintBreak(px::PxConstraintInfo* constraints, px::PxU32 count) {
  for (px::PxU32 i = 0; i < count; ++i) {
    if (constraints[i].type != px::PxConstraintExtIDs::eJOINT) {
      continue;
    }
    const auto* joint = static_cast<const px::PxJoint*>(constraints[i].externalReference);
    px::PxVec3 force(0);
    px::PxVec3 torque(0);
    constraints[i].constraint->getForce(force, torque);
    if (const std::optional<scene::Index> index = index_of(joint->userData)) {
      happened.broken.push_back({*index, static_cast<double>(force.magnitude()),
                                 static_cast<double>(torque.magnitude())});
    }
  }
}

void StepEvents::onContact(const px::PxContactPairHeader& header, const px::PxContactPair* pairs,
                           px::PxU32 count) {
  const bool gone = header.flags & (px::PxContactPairHeaderFlag::eREMOVED_ACTOR_0 |
                                    px::PxContactPairHeaderFlag::eREMOVED_ACTOR_1);
  if (gone) {
    return;
  }
  for (px::PxU32 i = 0; i < count; ++i) {
    add_contacts(pairs[i]);
  }
}

void StepEvents::add_contacts(const px::PxContactPair& pair) {
  px::PxContactPairPoint points[kMostPoints];
  const px::PxU32 count = pair.extractContacts(points, kMostPoints);
  Contact contact;
  contact.collider0 = collider_of(*pair.shapes[0]);
  contact.collider1 = collider_of(*pair.shapes[1]);
  double side = -1;
  if (contact.collider1 < contact.collider0) {
    std::swap(contact.collider0, contact.collider1);
    side = 1;
  }
  contact.body0 = scene_->colliders[contact.collider0].body;
  contact.body1 = scene_->colliders[contact.collider1].body;
  for (px::PxU32 i = 0; i < count; ++i) {
    const Vec3d normal = from_px(points[i].normal);
    contact.point = from_px(points[i].position);
    contact.normal = normal * side;
    contact.depth = -static_cast<double>(points[i].separation);
    contact.normal_force = dot(from_px(points[i].impulse), normal) / time_step_;
    contacts.push_back(contact);
  }
  add_friction(pair, std::span(contacts).last(count));
}

void StepEvents::sort_friction() {
  unsigned count = 0;
  const physx_api::FrictionImpulse* first = runtime_->functions->friction(count);
  friction_.assign(first, first + count);
  std::stable_sort(friction_.begin(), friction_.end(),
                   [](const auto& a, const auto& b) { return std::less<>()(a.pair, b.pair); });
  sorted_ = true;
}

void StepEvents::add_friction(const px::PxContactPair& pair, std::span<Contact> points) {
  if (!sorted_) {
    sort_friction();
  }
  auto patch = std::lower_bound(
      friction_.begin(), friction_.end(), pair.contactImpulses,
      [](const auto& kept, const float* wanted) { return std::less<>()(kept.pair, wanted); });
  for (; patch != friction_.end() && patch->pair == pair.contactImpulses; ++patch) {
    const Vec3d normal = from_px(patch->normal);
    const auto of_patch = [&](const Contact& contact) {
      return std::abs(dot(contact.normal, normal)) > kSameNormal;
    };
    double total = 0;
    for (const Contact& contact : points) {
      total += of_patch(contact) ? contact.normal_force : 0;
    }
    for (Contact& contact : points) {
      if (of_patch(contact) && total > 0) {
        // On collider 1: where the normal of the patch, turned as ours are, points to it.
        const double sign = dot(contact.normal, normal) > 0 ? 1 : -1;
        contact.friction_force +=
            from_px(patch->impulse) * (sign * contact.normal_force / total / time_step_);
      }
    }
  }
}

void StepEvents::onTrigger(px::PxTriggerPair* pairs, px::PxU32 count) {
  for (px::PxU32 i = 0; i < count; ++i) {
    const bool gone = pairs[i].flags & (px::PxTriggerPairFlag::eREMOVED_SHAPE_TRIGGER |
                                        px::PxTriggerPairFlag::eREMOVED_SHAPE_OTHER);
    if (!gone) {
      happened.passages.push_back({collider_of(*pairs[i].triggerShape),
                                   collider_of(*pairs[i].otherShape),
                                   pairs[i].status == px::PxPairFlag::eNOTIFY_TOUCH_FOUND});
    }
  }
}

void SurfaceMotion::onContactModify(px::PxContactModifyPair* const pairs, px::PxU32 count) {
  for (px::PxU32 i = 0; i < count; ++i) {
    px::PxContactModifyPair& pair = pairs[i];
    for (px::PxU32 p = 0; p < pair.contacts.size(); ++p) {
      const px::PxVec3& point = pair.contacts.getPoint(p);
      // The difference of velocities that the contact is to reach.
      const Vec3d of0 = carried_velocity(*scene_, collider_of(*pair.shape[0]),
                                         pair.actor[0]->getGlobalPose(), point);
      const Vec3d of1 = carried_velocity(*scene_, collider_of(*pair.shape[1]),
                                         pair.actor[1]->getGlobalPose(), point);
      pair.contacts.setTargetVelocity(p, to_px(of1 - of0));
    }
  }
}

}  // namespace tenon::engines::physx
// NOLINTEND(readability-identifier-naming)
