// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/physx/used_shapes.h"

#include "tenon/engines/physx/build/geometry.h"

namespace tenon::engines::physx {
namespace {

/// The polygons of a hull as fans.
scene::TriangleMesh surface_of(const px::PxConvexMesh& hull, const Pose& pose) {
  scene::TriangleMesh surface;
  for (px::PxU32 i = 0; i < hull.getNbVertices(); ++i) {
    surface.points.push_back(transform_point(pose, from_px(hull.getVertices()[i])));
  }
  const px::PxU8* corners = hull.getIndexBuffer();
  for (px::PxU32 i = 0; i < hull.getNbPolygons(); ++i) {
    px::PxHullPolygon polygon;
    if (!hull.getPolygonData(i, polygon)) {
      continue;
    }
    const px::PxU8* first = corners + polygon.mIndexBase;
    for (px::PxU16 k = 2; k < polygon.mNbVerts; ++k) {
      surface.triangles.push_back({{first[0], first[k - 1], first[k]}});
    }
  }
  return surface;
}

UsedShape used_shape(Build& build, const scene::Collider& collider) {
  const bool moves = build.scene.is_dynamic(collider.body);
  UsedShape used;
  for (const Geometry& geometry : geometry_of(build, collider, moves)) {
    const px::PxGeometryType::Enum type = geometry.shape.getType();
    if (type == px::PxGeometryType::eCONVEXMESH) {
      used.kind = UsedShape::Kind::Hulls;
      used.surfaces.push_back(surface_of(*geometry.shape.convexMesh().convexMesh, geometry.pose));
    } else if (type == px::PxGeometryType::eTRIANGLEMESH) {
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

Result<std::vector<UsedShape>> used_shapes(const scene::PhysicsScene& scene) {
  TENON_TRY(const Runtime* runtime, open_physx());
  const Messages messages;
  const SimulationOptions options;
  Diagnostics findings;
  std::vector<UsedShape> shapes;
  for (const scene::Collider& collider : scene.colliders) {
    Build build(scene, *runtime, options, findings);  // PhysX's objects go with it
    shapes.push_back(used_shape(build, collider));
  }
  return shapes;
}

}  // namespace tenon::engines::physx
