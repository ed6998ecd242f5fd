// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes, balls, capsules and planes PhysX has; cylinders and cones it has by callbacks. Ellipsoids
// become hulls of points on them. Triangles may only stand still or be moved by the asset, so a
// free body collides as the hull of its mesh, which is told. PhysX's own bounds for what is too
// small to be a hull are made for things of a metre, so each hull is cooked at its own scale.
#include "tenon/engines/physx/build/geometry.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/hull_points.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon::engines::physx {
namespace {

using scene::Collider;
using scene::Shape;
using scene::ShapeKind;

constexpr int kHullCorners = 255;

// The rotation that brings x to the shape's axis.
Quatd axis_turn(scene::Axis axis) { return rotation_from_x(scene::unit_axis(axis)); }

px::PxCookingParams cooking_at(double extent) {
  px::PxTolerancesScale scale;
  scale.length = static_cast<float>(std::max(extent, 1e-6));
  px::PxCookingParams params(scale);
  params.areaTestEpsilon = 0.06F * 1e-4F * scale.length * scale.length;
  params.suppressTriangleMeshRemapTable = true;
  params.midphaseDesc = px::PxMeshMidPhase::eBVH34;
  return params;
}

double extent_of(const std::vector<px::PxVec3>& points) {
  px::PxBounds3 bounds = px::PxBounds3::empty();
  for (const px::PxVec3& point : points) {
    bounds.include(point);
  }
  return bounds.isEmpty() ? 0 : static_cast<double>(bounds.getDimensions().maxElement());
}

std::vector<px::PxVec3> to_points(const std::vector<Vec3d>& points) {
  std::vector<px::PxVec3> result;
  result.reserve(points.size());
  for (const Vec3d& point : points) {
    result.push_back(to_px(point));
  }
  return result;
}

px::PxConvexMesh* cook_hull(Build& build, const std::vector<Vec3d>& points, int most_corners) {
  const std::vector<px::PxVec3> vertices = to_points(scene::hull_points(points).points);
  px::PxConvexMeshDesc wanted;
  wanted.points.count = static_cast<px::PxU32>(vertices.size());
  wanted.points.stride = sizeof(px::PxVec3);
  wanted.points.data = vertices.data();
  wanted.vertexLimit = static_cast<px::PxU16>(std::clamp(most_corners, 4, kHullCorners));
  wanted.flags = px::PxConvexFlag::eCOMPUTE_CONVEX | px::PxConvexFlag::eSHIFT_VERTICES |
                 px::PxConvexFlag::eDISABLE_MESH_VALIDATION;
  return build.model.owned.add(build.runtime.functions->create_convex(
      *build.runtime.physics, cooking_at(extent_of(vertices)), wanted));
}

px::PxTriangleMesh* cook_triangles(Build& build, const scene::TriangleMesh& mesh,
                                   const std::vector<px::PxMaterialTableIndex>& materials) {
  const std::vector<px::PxVec3> vertices = to_points(mesh.points);
  px::PxTriangleMeshDesc wanted;
  wanted.points.count = static_cast<px::PxU32>(vertices.size());
  wanted.points.stride = sizeof(px::PxVec3);
  wanted.points.data = vertices.data();
  wanted.triangles.count = static_cast<px::PxU32>(mesh.triangles.size());
  wanted.triangles.stride = sizeof(Vec3i);
  wanted.triangles.data = mesh.triangles.data();
  if (!materials.empty()) {
    wanted.materialIndices.stride = sizeof(px::PxMaterialTableIndex);
    wanted.materialIndices.data = materials.data();
  }
  return build.model.owned.add(build.runtime.functions->create_triangles(
      *build.runtime.physics, cooking_at(extent_of(vertices)), wanted));
}

void add_hull(Build& build, const Collider& collider, const std::vector<Vec3d>& points,
              std::vector<Geometry>& made) {
  px::PxConvexMesh* hull =
      cook_hull(build, points, collider.max_hull_vertices.value_or(kHullCorners));
  if (hull == nullptr) {
    build.report(collider.path, "", "PhysX makes no hull of its points");
    return;
  }
  made.push_back({px::PxGeometryHolder(px::PxConvexMeshGeometry(
                      hull, px::PxMeshScale(), px::PxConvexMeshGeometryFlag::eTIGHT_BOUNDS)),
                  {}});
}

void add_triangles(Build& build, const Collider& collider, std::vector<Geometry>& made) {
  const scene::TriangleMesh& mesh = build.scene.meshes[collider.shape.mesh];
  std::vector<px::PxMaterialTableIndex> materials;
  for (std::size_t i = 0; i < collider.face_materials.size(); ++i) {
    materials.resize(mesh.triangles.size(), 0);
    for (const scene::Index t : collider.face_materials[i].triangles) {
      if (t < materials.size() && materials[t] == 0) {
        materials[t] = static_cast<px::PxMaterialTableIndex>(i + 1);
      }
    }
  }
  px::PxTriangleMesh* cooked = cook_triangles(build, mesh, materials);
  if (cooked == nullptr) {
    build.report(collider.path, "", "PhysX makes no mesh of its triangles");
    return;
  }
  px::PxTriangleMeshGeometry geometry(cooked);
  if (mesh.flat) {
    geometry.meshFlags = px::PxMeshGeometryFlag::eDOUBLE_SIDED;
  }
  made.push_back({px::PxGeometryHolder(geometry), {}});
}

void add_mesh(Build& build, const Collider& collider, bool moves, std::vector<Geometry>& made) {
  if (!moves) {
    add_triangles(build, collider, made);
    return;
  }
  build.report(collider.path, "physics:approximation",
               "on a body that moves PhysX collides with the convex hull of the mesh; use "
               "convexDecomposition to keep its hollows");
  add_hull(build, collider, build.scene.meshes[collider.shape.mesh].points, made);
}

// PhysX makes a hull of points in one plane that is thick on both sides; the triangles are not.
void add_whole_hull(Build& build, const Collider& collider, bool moves,
                    std::vector<Geometry>& made) {
  const scene::TriangleMesh& mesh = build.scene.meshes[collider.shape.mesh];
  if (!collider.shape.pieces.empty()) {
    return;
  }
  if (!scene::is_flat(mesh.points)) {
    add_hull(build, collider, mesh.points, made);
  } else if (!moves) {
    add_triangles(build, collider, made);
  } else {
    build.report(collider.path, "physics:approximation",
                 "PhysX needs volume: the flat mesh is thickened on both sides");
    add_hull(build, collider, mesh.points, made);
  }
}

void add_solid(Build& build, const Shape& shape, std::vector<Geometry>& made) {
  const auto axis = static_cast<int>(shape.axis);
  const float height = to_px(2 * shape.half_height);
  const float radius = to_px(shape.radius);
  const physx_api::Functions& functions = *build.runtime.functions;
  px::PxCustomGeometryCallbacks* solid = build.model.owned.add_solid(
      build.runtime, shape.kind == ShapeKind::Cone
                         ? functions.create_cone(height, radius, axis)
                         : functions.create_cylinder(height, radius, axis));
  if (solid != nullptr) {
    made.push_back({px::PxGeometryHolder(px::PxCustomGeometry(*solid)), {}});
  }
}

void add_plane(Build& build, const Collider& collider, bool moves, std::vector<Geometry>& made) {
  if (moves) {
    build.report(collider.path, "", "PhysX's planes are static; the body has none");
    return;
  }
  made.push_back(
      {px::PxGeometryHolder(px::PxPlaneGeometry()), {{}, axis_turn(collider.shape.axis)}});
}

}  // namespace

std::vector<Geometry> geometry_of(Build& build, const Collider& collider, bool moves) {
  const Shape& shape = collider.shape;
  std::vector<Geometry> made;
  switch (shape.kind) {
    case ShapeKind::Box:
      made.push_back({px::PxGeometryHolder(px::PxBoxGeometry(to_px(shape.half_extents))), {}});
      break;
    case ShapeKind::Sphere:
      made.push_back({px::PxGeometryHolder(px::PxSphereGeometry(to_px(shape.radius))), {}});
      break;
    case ShapeKind::Ellipsoid:
      add_hull(build, collider, ellipsoid_points(shape.half_extents, false), made);
      build.report(collider.path, "xformOp:scale",
                   "an ellipsoid is a hull of 200 points here, up to 3 % inside of it");
      break;
    case ShapeKind::Capsule:
      made.push_back({px::PxGeometryHolder(
                          px::PxCapsuleGeometry(to_px(shape.radius), to_px(shape.half_height))),
                      {{}, axis_turn(shape.axis)}});
      break;
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      add_solid(build, shape, made);
      break;
    case ShapeKind::Plane:
      add_plane(build, collider, moves, made);
      break;
    case ShapeKind::ConvexHull:
      add_whole_hull(build, collider, moves, made);
      for (const scene::Index piece : shape.pieces) {
        add_hull(build, collider, build.scene.meshes[piece].points, made);
      }
      break;
    case ShapeKind::Mesh:
      add_mesh(build, collider, moves, made);
      break;
    case ShapeKind::Spheres:
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        made.push_back({px::PxGeometryHolder(px::PxSphereGeometry(to_px(shape.sphere_radii[i]))),
                        {shape.sphere_centers[i], kIdentityRotation}});
      }
      break;
  }
  return made;
}

}  // namespace tenon::engines::physx
