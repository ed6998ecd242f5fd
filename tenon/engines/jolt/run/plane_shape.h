// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/jolt/jolt_headers.h"
//
#include <Jolt/Physics/Collision/Shape/Shape.h>

// NOLINTBEGIN(readability-identifier-naming): names of Jolt
namespace tenon::engines::jolt {

/// A half-space, solid below the plane through its origin, which Jolt 5.0 lacks. Its bounds end
/// 30 km away; a large box in its place would lose the digits that contacts need.
class PlaneShape final : public JPH::Shape {
 public:
  /// `axis` 0 to 2: the normal is x, y or z.
  explicit PlaneShape(unsigned axis);
  /// Teaches Jolt what convex shapes do that meet it.
  static void add_to_jolt();

  JPH::Vec3 normal() const { return normal_; }

  JPH::AABox GetLocalBounds() const override;
  JPH::uint GetSubShapeIDBitsRecursive() const override { return 0; }
  float GetInnerRadius() const override { return 0; }
  JPH::MassProperties GetMassProperties() const override { return {}; }
  const JPH::PhysicsMaterial* GetMaterial(const JPH::SubShapeID& /*part*/) const override;
  JPH::Vec3 GetSurfaceNormal(const JPH::SubShapeID& /*part*/, JPH::Vec3Arg /*at*/) const override {
    return normal_;
  }
  float GetVolume() const override { return 0; }
  Stats GetStats() const override { return {sizeof(*this), 0}; }

  // What simulations do not ask.
  void GetSubmergedVolume(JPH::Mat44Arg /*place*/, JPH::Vec3Arg /*scale*/,
                          const JPH::Plane& /*surface*/, float& total, float& submerged,
                          JPH::Vec3& center) const override;
  bool CastRay(const JPH::RayCast& /*ray*/, const JPH::SubShapeIDCreator& /*part*/,
               JPH::RayCastResult& /*hit*/) const override {
    return false;
  }
  void CastRay(const JPH::RayCast& /*ray*/, const JPH::RayCastSettings& /*settings*/,
               const JPH::SubShapeIDCreator& /*part*/, JPH::CastRayCollector& /*hits*/,
               const JPH::ShapeFilter& /*filter*/) const override {}
  void CollidePoint(JPH::Vec3Arg /*point*/, const JPH::SubShapeIDCreator& /*part*/,
                    JPH::CollidePointCollector& /*hits*/,
                    const JPH::ShapeFilter& /*filter*/) const override {}
  void CollideSoftBodyVertices(JPH::Mat44Arg /*place*/, JPH::Vec3Arg /*scale*/,
                               JPH::SoftBodyVertex* /*vertices*/, JPH::uint /*count*/,
                               float /*time*/, JPH::Vec3Arg /*moved*/,
                               int /*index*/) const override {}
  void GetTrianglesStart(GetTrianglesContext& /*context*/, const JPH::AABox& /*box*/,
                         JPH::Vec3Arg /*position*/, JPH::QuatArg /*rotation*/,
                         JPH::Vec3Arg /*scale*/) const override {}
  int GetTrianglesNext(GetTrianglesContext& /*context*/, int /*most*/, JPH::Float3* /*corners*/,
                       const JPH::PhysicsMaterial** /*materials*/) const override {
    return 0;
  }

 private:
  unsigned axis_;
  JPH::Vec3 normal_;
};

}  // namespace tenon::engines::jolt
// NOLINTEND(readability-identifier-naming)
