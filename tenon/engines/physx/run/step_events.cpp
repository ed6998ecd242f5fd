// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// PhysX gives the normal impulse of each contact point and none of its friction. Its normals point
// from the second shape to the first; ours go from the collider of the lower index to the other.
#include "tenon/engines/physx/run/step_events.h"

#include <utility>

#include "tenon/engines/physx/convert.h"

// NOLINTBEGIN(readability-identifier-naming): names of PhysX
namespace tenon::engines::physx {
namespace {

constexpr px::PxU32 kMostPoints = 256;

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
  broken.clear();
  passed.clear();
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
      broken.push_back({*index, static_cast<double>(force.magnitude()),
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
}

void StepEvents::onTrigger(px::PxTriggerPair* pairs, px::PxU32 count) {
  for (px::PxU32 i = 0; i < count; ++i) {
    const bool gone = pairs[i].flags & (px::PxTriggerPairFlag::eREMOVED_SHAPE_TRIGGER |
                                        px::PxTriggerPairFlag::eREMOVED_SHAPE_OTHER);
    if (!gone) {
      passed.push_back({collider_of(*pairs[i].triggerShape), collider_of(*pairs[i].otherShape),
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
