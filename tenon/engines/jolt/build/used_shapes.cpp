// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/jolt/used_shapes.h"

#include <array>

#include "tenon/engines/jolt/jolt_headers.h"
//
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>

#include "tenon/engines/jolt/build/shapes.h"
#include "tenon/engines/jolt/jolt_runtime.h"

namespace tenon::engines::jolt {
namespace {

/// The faces of a hull as fans.
scene::TriangleMesh surface_of(const JPH::ConvexHullShape& hull, const Pose& pose) {
  scene::TriangleMesh surface;
  const Vec3d center = from_jolt(hull.GetCenterOfMass());
  for (JPH::uint i = 0; i < hull.GetNumPoints(); ++i) {
    surface.points.push_back(transform_point(pose, from_jolt(hull.GetPoint(i)) + center));
  }
  std::array<JPH::uint, 256> corners{};  // a hull has no more
  for (JPH::uint face = 0; face < hull.GetNumFaces(); ++face) {
    const JPH::uint count =
        hull.GetFaceVertices(face, static_cast<JPH::uint>(corners.size()), corners.data());
    for (JPH::uint k = 2; k < count; ++k) {
      surface.triangles.push_back({{static_cast<int>(corners[0]), static_cast<int>(corners[k - 1]),
                                    static_cast<int>(corners[k])}});
    }
  }
  return surface;
}

UsedShape used_shape(Build& build, scene::Index index) {
  const scene::Collider& collider = build.scene.colliders[index];
  const bool moves = build.scene.is_dynamic(collider.body);
  UsedShape used;
  for (const PlacedShape& part : shapes_of(build, index, moves)) {
    const JPH::EShapeSubType type = part.shape->GetSubType();
    if (type == JPH::EShapeSubType::ConvexHull) {
      used.kind = UsedShape::Kind::Hulls;
      used.surfaces.push_back(
          surface_of(static_cast<const JPH::ConvexHullShape&>(*part.shape), part.pose));
    } else if (type == JPH::EShapeSubType::Mesh) {
      used.kind = UsedShape::Kind::Triangles;
      used.surfaces.push_back(build.scene.meshes[collider.shape.mesh]);
    } else {
      used.kind = UsedShape::Kind::Shape;
    }
  }
  for (const NotMapped& note : build.model.not_mapped) {
    used.notes.push_back(note.why);
  }
  return used;
}

}  // namespace

std::vector<UsedShape> used_shapes(const scene::PhysicsScene& scene) {
  open_jolt();
  const SimulationOptions options;
  Diagnostics findings;
  std::vector<UsedShape> shapes;
  for (scene::Index i = 0; i < scene.colliders.size(); ++i) {
    Build build(scene, options, findings);
    shapes.push_back(used_shape(build, i));
  }
  return shapes;
}

}  // namespace tenon::engines::jolt
