// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/run/plane_shape.h"

#include <Jolt/Physics/Collision/CollideShape.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/Shape/ConvexShape.h>
#include <Jolt/Physics/Collision/TransformedShape.h>

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
namespace tenon::engines::jolt {
namespace {

constexpr float kReach = 30000;  // [m] half floats, which compounds use, end at 65504

/// The part of the plane around `point` that a face of size `reach` can touch, counter-clockwise.
void add_face(JPH::Vec3Arg point, JPH::Vec3Arg normal, float reach,
              JPH::CollideShapeResult::Face& face) {
  const JPH::Vec3 along = normal.GetNormalizedPerpendicular() * reach;
  const JPH::Vec3 across = normal.Cross(along);
  face.push_back(point - along - across);
  face.push_back(point + along - across);
  face.push_back(point + along + across);
  face.push_back(point - along + across);
}

void collide_convex(const JPH::Shape* shape1, const JPH::Shape* shape2, JPH::Vec3Arg scale1,
                    JPH::Vec3Arg /*scale2*/, JPH::Mat44Arg place1, JPH::Mat44Arg place2,
                    const JPH::SubShapeIDCreator& part1, const JPH::SubShapeIDCreator& part2,
                    const JPH::CollideShapeSettings& settings, JPH::CollideShapeCollector& hits,
                    const JPH::ShapeFilter& /*filter*/) {
  const auto* convex = static_cast<const JPH::ConvexShape*>(shape1);
  const JPH::Vec3 normal = place2.Multiply3x3(static_cast<const PlaneShape*>(shape2)->normal());
  const JPH::Vec3 in_convex = place1.Multiply3x3Transposed(normal);
  JPH::ConvexShape::SupportBuffer buffer;
  const JPH::ConvexShape::Support* support = convex->GetSupportFunction(
      JPH::ConvexShape::ESupportMode::IncludeConvexRadius, buffer, scale1);
  const JPH::Vec3 lowest = place1 * support->GetSupport(-in_convex);
  const float height = normal.Dot(lowest - place2.GetTranslation());
  if (height > settings.mMaxSeparationDistance || height >= hits.GetEarlyOutFraction()) {
    return;
  }
  JPH::CollideShapeResult hit(lowest, lowest - normal * height, -normal, -height, part1.GetID(),
                              part2.GetID(), JPH::TransformedShape::sGetBodyID(hits.GetContext()));
  if (settings.mCollectFacesMode == JPH::ECollectFacesMode::CollectFaces) {
    shape1->GetSupportingFace(JPH::SubShapeID(), in_convex, scale1, place1, hit.mShape1Face);
    const float reach = 2 * shape1->GetLocalBounds().GetSize().Length();
    add_face(hit.mContactPointOn2, normal, reach, hit.mShape2Face);
  }
  hits.AddHit(hit);
}

}  // namespace

PlaneShape::PlaneShape(unsigned axis)
    : Shape(JPH::EShapeType::User1, JPH::EShapeSubType::User1),
      axis_(axis),
      normal_(axis == 0 ? 1.0F : 0.0F, axis == 1 ? 1.0F : 0.0F, axis == 2 ? 1.0F : 0.0F) {}

void PlaneShape::add_to_jolt() {
  for (const JPH::EShapeSubType type : JPH::sConvexSubShapeTypes) {
    JPH::CollisionDispatch::sRegisterCollideShape(type, JPH::EShapeSubType::User1, collide_convex);
    JPH::CollisionDispatch::sRegisterCollideShape(JPH::EShapeSubType::User1, type,
                                                  JPH::CollisionDispatch::sReversedCollideShape);
  }
}

JPH::AABox PlaneShape::GetLocalBounds() const {
  JPH::Vec3 high = JPH::Vec3::sReplicate(kReach);
  high.SetComponent(axis_, 0);
  return {JPH::Vec3::sReplicate(-kReach), high};
}

const JPH::PhysicsMaterial* PlaneShape::GetMaterial(const JPH::SubShapeID& /*part*/) const {
  return JPH::PhysicsMaterial::sDefault;
}

void PlaneShape::GetSubmergedVolume(JPH::Mat44Arg /*place*/, JPH::Vec3Arg /*scale*/,
                                    const JPH::Plane& /*surface*/, float& total, float& submerged,
                                    JPH::Vec3& center) const {
  total = 0;
  submerged = 0;
  center = JPH::Vec3::sZero();
}

}  // namespace tenon::engines::jolt
// NOLINTEND(readability-identifier-naming)
