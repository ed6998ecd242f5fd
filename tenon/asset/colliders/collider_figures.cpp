// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Shapes are compared in the frame of the body, as a box or a ball around a mesh has a pose of its
// own in it. What an engine takes as the asset describes it has no gap; what it makes a hull of,
// an ellipsoid or a cone, is compared with triangles of the described shape.
#include "tenon/asset/colliders/collider_figures.h"

#include <utility>

#include "tenon/scene/shapes/mesh_inertia.h"
#include "tenon/scene/shapes/shape_mass.h"

namespace tenon {
namespace {

using approximate::ShapeSurface;
using engines::UsedShape;
using scene::Collider;
using scene::ShapeKind;
using scene::TriangleMesh;

void move_mesh(const Pose& pose, TriangleMesh& mesh) {
  for (Vec3d& point : mesh.points) {
    point = transform_point(pose, point);
  }
}

ShapeSurface described_surface(const Collider& collider) {
  ShapeSurface surface = approximate::surface_of(collider.shape);
  for (TriangleMesh& part : surface.parts) {
    move_mesh(collider.pose, part);
  }
  if (surface.ball) {
    surface.ball->center = transform_point(collider.pose, surface.ball->center);
  }
  return surface;
}

ShapeSurface used_surface(const Collider& collider, const UsedShape& used) {
  if (used.kind == UsedShape::Kind::Shape) {
    return described_surface(collider);
  }
  ShapeSurface surface;
  surface.is_solid = used.kind == UsedShape::Kind::Hulls;
  surface.parts = used.surfaces;
  for (TriangleMesh& part : surface.parts) {
    move_mesh(collider.pose, part);
  }
  return surface;
}

std::size_t cost_of_shape(const scene::Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::Box:
      return 8;
    case ShapeKind::Capsule:
      return 2;
    case ShapeKind::Spheres:
      return shape.sphere_centers.size();
    default:
      return 1;
  }
}

void count(const Collider& collider, const UsedShape& used, ColliderFigures& figures) {
  switch (used.kind) {
    case UsedShape::Kind::None:
      return;
    case UsedShape::Kind::Shape:
      figures.used = scene::shape_name(collider.shape.kind);
      figures.pieces =
          collider.shape.kind == ShapeKind::Spheres ? collider.shape.sphere_centers.size() : 1;
      figures.cost = cost_of_shape(collider.shape);
      return;
    case UsedShape::Kind::Hulls:
    case UsedShape::Kind::Triangles:
      break;
  }
  const bool is_hulls = used.kind == UsedShape::Kind::Hulls;
  figures.used = !is_hulls                  ? "mesh"
                 : used.surfaces.size() > 1 ? "convexDecomposition"
                                            : "convexHull";
  figures.pieces = used.surfaces.size();
  for (const TriangleMesh& surface : used.surfaces) {
    figures.vertices += surface.points.size();
    figures.triangles += surface.triangles.size();
  }
  figures.cost = is_hulls ? figures.vertices : 3 * figures.triangles;
}

std::optional<double> volume_of(const Collider& collider, const scene::PhysicsScene& scene,
                                const UsedShape& used) {
  double volume = 0;
  if (used.kind == UsedShape::Kind::Shape) {
    volume = scene::shape_integrals(collider.shape, scene.meshes).volume;
  } else if (used.kind == UsedShape::Kind::Hulls) {
    for (const TriangleMesh& hull : used.surfaces) {
      volume += scene::mesh_integrals(hull).volume;
    }
  }
  return volume > 0 ? std::optional(volume) : std::nullopt;
}

TriangleMesh joined_parts(const std::vector<TriangleMesh>& parts) {
  TriangleMesh whole;
  for (const TriangleMesh& part : parts) {
    const auto first = static_cast<std::int32_t>(whole.points.size());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    for (const Vec3i& t : part.triangles) {
      whole.triangles.push_back({{t[0] + first, t[1] + first, t[2] + first}});
    }
  }
  return whole;
}

/// Of a collider that is no mesh.
void compare_with_shape(const Collider& collider, const scene::PhysicsScene& scene,
                        const UsedShape& used, ColliderFigures& figures) {
  const double volume = scene::shape_integrals(collider.shape, scene.meshes).volume;
  figures.mesh_volume = volume > 0 ? std::optional(volume) : std::nullopt;
  if (used.kind == UsedShape::Kind::Shape) {
    figures.gap.emplace();
    return;
  }
  const TriangleMesh described = joined_parts(described_surface(collider).parts);
  if (!described.triangles.empty()) {
    figures.gap = approximate::surface_gap(described, used_surface(collider, used));
  }
}

}  // namespace

std::optional<double> ColliderFigures::cover() const {
  return volume && mesh_volume ? std::optional(*volume / *mesh_volume) : std::nullopt;
}

MeshOfCollider mesh_of_collider(const Collider& collider, const scene::PhysicsScene& scene) {
  MeshOfCollider found;
  found.mesh = approximate::welded(scene.meshes[collider.shape.mesh]);
  move_mesh(collider.pose, found.mesh);
  const double volume = scene::is_closed(found.mesh) ? scene::mesh_integrals(found.mesh).volume : 0;
  if (volume > 0) {
    found.volume = volume;
  }
  return found;
}

ColliderFigures collider_figures(const Collider& collider, const scene::PhysicsScene& scene,
                                 const UsedShape& used, const MeshOfCollider* mesh) {
  ColliderFigures figures;
  figures.notes = used.notes;
  count(collider, used, figures);
  if (used.kind == UsedShape::Kind::None) {
    return figures;
  }
  figures.volume = volume_of(collider, scene, used);
  if (mesh == nullptr) {
    compare_with_shape(collider, scene, used, figures);
    return figures;
  }
  figures.mesh_volume = mesh->volume;
  const ShapeSurface surface = used_surface(collider, used);
  if (!surface.parts.empty() && !mesh->mesh.triangles.empty()) {
    figures.gap = approximate::surface_gap(mesh->mesh, surface);
  }
  return figures;
}

}  // namespace tenon
