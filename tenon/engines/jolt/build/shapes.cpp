// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Boxes, balls, capsules and cylinders Jolt has, and a plane it gets here. Cones and ellipsoids
// become hulls of points on them. Triangles of Jolt meet no other triangles and no plane, so a free
// body collides as the hull of its mesh, which is told. Jolt rounds edges by a radius, 5 cm where
// nobody says less; here a twentieth of the smallest size, 1 mm at most.
#include "tenon/engines/jolt/build/shapes.h"

#include <algorithm>
#include <cmath>

#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/Collision/Shape/CylinderShape.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/Physics/Collision/Shape/OffsetCenterOfMassShape.h>
#include <Jolt/Physics/Collision/Shape/RotatedTranslatedShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/Shape/StaticCompoundShape.h>

#include "tenon/engines/hull_points.h"
#include "tenon/engines/jolt/run/plane_shape.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon::engines::jolt {
namespace {

using scene::Collider;
using scene::Index;
using scene::Shape;
using scene::ShapeKind;

constexpr double kMostRounding = 0.001;  // [m]
constexpr double kLeastSize = 1e-5;      // [m] Jolt takes no shape of no size
constexpr int kConePoints = 120;

double rounding_of(double smallest) { return std::min(smallest / 20, kMostRounding); }

/// The rotation that brings y, the axis of Jolt's solids, to the shape's axis.
Quatd turn_from_y(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::X:
      return rotation_about({{0, 0, 1}}, -M_PI / 2);
    case scene::Axis::Z:
      return rotation_about({{1, 0, 0}}, M_PI / 2);
    case scene::Axis::Y:
      break;
  }
  return kIdentityRotation;
}

struct Extent {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};
  Vec3d size() const { return high - low; }
};

Extent extent_of(const std::vector<Vec3d>& points) {
  Extent extent;
  for (const Vec3d& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      extent.low[i] = std::min(extent.low[i], point[i]);
      extent.high[i] = std::max(extent.high[i], point[i]);
    }
  }
  return extent;
}

// Jolt takes 256 corners; a hull with more is made of the points that a wider tolerance leaves.
JPH::RefConst<JPH::Shape> make_hull(const std::vector<Vec3d>& points) {
  const Vec3d size = extent_of(points).size();
  const double largest = std::max({size[0], size[1], size[2]});
  const double smallest = std::min({size[0], size[1], size[2]});
  JPH::ConvexHullShapeSettings settings;
  for (const Vec3d& point : scene::hull_points(points).points) {
    settings.mPoints.push_back(to_jolt(point));
  }
  settings.mMaxConvexRadius = to_jolt(rounding_of(smallest / 2));
  settings.mMaxErrorConvexRadius = to_jolt(kMostRounding / 5);
  for (double tolerance = 1e-4; tolerance < 0.1; tolerance *= 3) {
    settings.mHullTolerance = to_jolt(tolerance * largest);
    settings.ClearCachedResult();
    const JPH::ShapeSettings::ShapeResult made = settings.Create();
    if (made.IsValid()) {
      return made.Get().GetPtr();
    }
  }
  return nullptr;
}

std::vector<Vec3d> cone_points(const Shape& shape) {
  const auto up = static_cast<std::size_t>(shape.axis);
  std::vector<Vec3d> points(1);
  points[0][up] = shape.half_height;
  for (int i = 0; i < kConePoints; ++i) {
    const double angle = 2 * M_PI * i / kConePoints;
    Vec3d point;
    point[up] = -shape.half_height;
    point[(up + 1) % 3] = shape.radius * std::cos(angle);
    point[(up + 2) % 3] = shape.radius * std::sin(angle);
    points.push_back(point);
  }
  return points;
}

JPH::RefConst<JPH::Shape> make_box(const Vec3d& half) {
  const Vec3d size{{std::max(half[0], kLeastSize), std::max(half[1], kLeastSize),
                    std::max(half[2], kLeastSize)}};
  return new JPH::BoxShape(to_jolt(size),
                           to_jolt(rounding_of(std::min({size[0], size[1], size[2]}))));
}

void add_hull(Build& build, const Collider& collider, const std::vector<Vec3d>& points,
              std::vector<PlacedShape>& made) {
  const JPH::RefConst<JPH::Shape> hull = make_hull(points);
  if (hull == nullptr) {
    build.report(collider.path, "", "Jolt makes no hull of its points");
    return;
  }
  made.push_back({hull, {}});
}

JPH::MeshShapeSettings mesh_settings(const scene::TriangleMesh& mesh, const Collider& collider) {
  JPH::VertexList vertices;
  for (const Vec3d& point : mesh.points) {
    vertices.emplace_back(to_jolt(point[0]), to_jolt(point[1]), to_jolt(point[2]));
  }
  std::vector<JPH::uint32> materials(mesh.triangles.size(), 0);
  JPH::PhysicsMaterialList surfaces;
  if (!collider.face_materials.empty()) {
    surfaces.push_back(new FaceSurface(collider.material));
  }
  for (const scene::FaceMaterial& face : collider.face_materials) {
    surfaces.push_back(new FaceSurface(face.material));
    for (const Index t : face.triangles) {
      materials[t] =
          materials[t] == 0 ? static_cast<JPH::uint32>(surfaces.size() - 1) : materials[t];
    }
  }
  JPH::IndexedTriangleList triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corner = [&](std::size_t i) {
      return static_cast<JPH::uint32>(mesh.triangles[t][i]);
    };
    triangles.emplace_back(corner(0), corner(1), corner(2), materials[t]);
    if (mesh.flat) {  // touched from both sides
      triangles.emplace_back(corner(0), corner(2), corner(1), materials[t]);
    }
  }
  return {std::move(vertices), std::move(triangles), std::move(surfaces)};
}

void add_triangles(Build& build, const Collider& collider, std::vector<PlacedShape>& made) {
  constexpr std::size_t kMostFaces = 31;  // Jolt has 5 bits for the material of a triangle
  if (collider.face_materials.size() > kMostFaces) {
    build.report(collider.path, "material:binding:physics",
                 "Jolt has room for 31 subsets of a mesh; none of them counts");
  }
  Collider source = collider;
  if (source.face_materials.size() > kMostFaces) {
    source.face_materials.clear();
  }
  const JPH::ShapeSettings::ShapeResult result =
      mesh_settings(build.scene.meshes[collider.shape.mesh], source).Create();
  if (!result.IsValid()) {
    build.report(collider.path, "",
                 "Jolt makes no mesh of its triangles: " + std::string(result.GetError().c_str()));
    return;
  }
  made.push_back({result.Get().GetPtr(), {}});
}

void add_mesh(Build& build, const Collider& collider, bool moves, std::vector<PlacedShape>& made) {
  if (!moves) {
    add_triangles(build, collider, made);
    return;
  }
  build.report(collider.path, "physics:approximation",
               "on a body that moves Jolt collides with the convex hull of the mesh; use "
               "convexDecomposition to keep its hollows");
  add_hull(build, collider, build.scene.meshes[collider.shape.mesh].points, made);
}

void add_hulls(Build& build, const Collider& collider, bool moves, std::vector<PlacedShape>& made) {
  const scene::TriangleMesh& mesh = build.scene.meshes[collider.shape.mesh];
  for (const Index piece : collider.shape.pieces) {
    add_hull(build, collider, build.scene.meshes[piece].points, made);
  }
  if (!collider.shape.pieces.empty()) {
    return;
  }
  if (scene::is_flat(mesh.points) && !moves) {
    add_triangles(build, collider, made);
  } else {
    add_hull(build, collider, mesh.points, made);
  }
}

void add_plane(Build& build, const Collider& collider, bool moves, std::vector<PlacedShape>& made) {
  if (moves) {
    build.report(collider.path, "", "Jolt's planes are static; the body has none");
    return;
  }
  made.push_back({new PlaneShape(static_cast<unsigned>(collider.shape.axis)), {}});
}

void add_shape(Build& build, const Collider& collider, bool moves, std::vector<PlacedShape>& made) {
  const Shape& shape = collider.shape;
  const double radius = std::max(shape.radius, kLeastSize);
  const double half_height = std::max(shape.half_height, kLeastSize);
  switch (shape.kind) {
    case ShapeKind::Box:
      made.push_back({make_box(shape.half_extents), {}});
      break;
    case ShapeKind::Sphere:
      made.push_back({new JPH::SphereShape(to_jolt(radius)), {}});
      break;
    case ShapeKind::Ellipsoid:
      add_hull(build, collider, ellipsoid_points(shape.half_extents, true), made);
      break;
    case ShapeKind::Capsule:
      made.push_back({new JPH::CapsuleShape(to_jolt(half_height), to_jolt(radius)),
                      {{}, turn_from_y(shape.axis)}});
      break;
    case ShapeKind::Cylinder:
      made.push_back({new JPH::CylinderShape(to_jolt(half_height), to_jolt(radius),
                                             to_jolt(rounding_of(std::min(half_height, radius)))),
                      {{}, turn_from_y(shape.axis)}});
      break;
    case ShapeKind::Cone:
      add_hull(build, collider, cone_points(shape), made);
      break;
    case ShapeKind::Plane:
      add_plane(build, collider, moves, made);
      break;
    case ShapeKind::ConvexHull:
      add_hulls(build, collider, moves, made);
      break;
    case ShapeKind::Mesh:
      add_mesh(build, collider, moves, made);
      break;
    case ShapeKind::Spheres:
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        made.push_back({new JPH::SphereShape(to_jolt(std::max(shape.sphere_radii[i], kLeastSize))),
                        {shape.sphere_centers[i], kIdentityRotation}});
      }
      break;
  }
}

}  // namespace

std::vector<PlacedShape> shapes_of(Build& build, Index collider, bool moves) {
  const Collider& source = build.scene.colliders[collider];
  std::vector<PlacedShape> made;
  add_shape(build, source, moves, made);
  for (const PlacedShape& part : made) {
    const_cast<JPH::Shape*>(part.shape.GetPtr())->SetUserData(number_of(collider));
  }
  return made;
}

JPH::RefConst<JPH::Shape> joined_shape(const std::vector<PlacedShape>& parts, const Vec3d& center) {
  JPH::RefConst<JPH::Shape> whole;
  if (parts.size() == 1) {
    whole = parts[0].shape;
    if (!(parts[0].pose == Pose{})) {
      whole = new JPH::RotatedTranslatedShape(to_jolt(parts[0].pose.position),
                                              to_jolt(parts[0].pose.orientation), whole);
    }
  } else {
    JPH::StaticCompoundShapeSettings settings;
    for (const PlacedShape& part : parts) {
      settings.AddShape(to_jolt(part.pose.position), to_jolt(part.pose.orientation), part.shape);
    }
    const JPH::ShapeSettings::ShapeResult made = settings.Create();
    whole = made.IsValid() ? made.Get().GetPtr() : nullptr;
  }
  const bool is_there = whole != nullptr && whole->GetCenterOfMass() == to_jolt(center);
  if (whole == nullptr || is_there) {
    return whole;
  }
  return new JPH::OffsetCenterOfMassShape(whole, to_jolt(center) - whole->GetCenterOfMass());
}

}  // namespace tenon::engines::jolt
