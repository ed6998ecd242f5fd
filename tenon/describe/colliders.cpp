// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A collider goes to the link of the nearest prim above it that is one, at its place there. What it
// collides as follows from its shape in the scene, where approximations are made already: a hull is
// a mesh whose hull counts. SDF has surfaces, ellipsoids, planes and meshes as they are; URDF has
// none of these.
#include "tenon/describe/colliders.h"

namespace tenon::describe {

using robot::GeometryKind;
using robot::Index;

namespace {

/// None for kinds that the format does not have.
std::optional<GeometryKind> geometry_kind(scene::ShapeKind kind, bool is_sdf) {
  switch (kind) {
    case scene::ShapeKind::Box:
      return GeometryKind::Box;
    case scene::ShapeKind::Sphere:
      return GeometryKind::Sphere;
    case scene::ShapeKind::Cylinder:
      return GeometryKind::Cylinder;
    case scene::ShapeKind::Capsule:
      return GeometryKind::Capsule;
    case scene::ShapeKind::ConvexHull:
    case scene::ShapeKind::Mesh:
      return GeometryKind::Mesh;
    case scene::ShapeKind::Ellipsoid:
      return is_sdf ? std::optional(GeometryKind::Ellipsoid) : std::nullopt;
    case scene::ShapeKind::Plane:
      return is_sdf ? std::optional(GeometryKind::Plane) : std::nullopt;
    case scene::ShapeKind::Cone:
    case scene::ShapeKind::Spheres:
      break;
  }
  return std::nullopt;
}

robot::MeshFile triangles_of(const scene::TriangleMesh& mesh) {
  robot::MeshFile file;
  for (const Vec3d& point : mesh.points) {
    file.points.push_back(to_float(point));
  }
  file.triangles = mesh.triangles;
  return file;
}

/// In its body where it can be, which is exact; else by way of the world, as they stand.
Pose pose_in_link(const SceneSource& source, const BodyTree& bodies,
                  const scene::Collider& described, Index link) {
  const RobotTree& tree = bodies.tree;
  if (described.body && bodies.link_of_body[*described.body] == link) {
    return inverse(tree.in_body(link)) * described.pose;
  }
  const Pose body = described.body ? source.scene().bodies[*described.body].pose : Pose{};
  return inverse(tree.pose(link)) * body * described.pose;
}

/// The nearest link at or above a collider; else that of its body, or the world.
std::optional<Index> link_of(const BodyTree& bodies, const scene::Collider& described) {
  if (const std::optional<Index> above = bodies.tree.link_above(described.path)) {
    return above;
  }
  return described.body ? bodies.link_of_body[*described.body] : bodies.tree.world();
}

/// SDF has one coefficient of friction along a direction.
robot::Surface surface_of(SceneSource& source, const scene::Collider& described) {
  const scene::Material& material = source.scene().materials[*described.material];
  robot::Surface surface;
  surface.static_friction = material.static_friction;
  surface.dynamic_friction = material.dynamic_friction;
  surface.restitution = material.restitution;
  if (material.static_friction != material.dynamic_friction) {
    source.left_out(described.path, "static friction differs from dynamic friction, which is kept");
  }
  if (material.torsional_friction || material.rolling_friction) {
    source.left_out(described.path, "the collider has torsional or rolling friction");
  }
  if (material.compliance.stiffness > 0 && !material.compliance.acceleration) {
    surface.contact_stiffness = material.compliance.stiffness;
    surface.contact_damping = material.compliance.damping;
  } else if (material.compliance.stiffness > 0) {
    source.left_out(described.path, "its contacts are springs for each unit of mass");
  }
  return surface;
}

/// What its surface and its mesh say, in `collider` where the format has a place for it.
void read_contacts(SceneSource& source, const scene::Collider& described,
                   robot::Collider& collider) {
  const scene::Shape& shape = described.shape;
  if (described.material && source.is_sdf()) {
    collider.surface = surface_of(source, described);
  } else if (described.material) {
    source.left_out(described.path, "the collider has friction or restitution");
  }
  if (source.is_sdf() && shape.kind == scene::ShapeKind::Mesh) {
    collider.approximation = robot::Approximation::None;
  } else if (source.is_sdf() && !shape.pieces.empty()) {
    collider.approximation = robot::Approximation::Decomposition;
  } else if (shape.kind == scene::ShapeKind::Mesh || !shape.pieces.empty()) {
    source.left_out(described.path, "the collider is more than the hull of its mesh");
  }
}

/// A collider without its mesh; none, and a finding, for an unsupported kind.
std::optional<robot::Collider> read_collider(SceneSource& source, const BodyTree& bodies,
                                             const scene::Collider& described, Index link) {
  const scene::Shape& shape = described.shape;
  robot::Collider collider;
  const stage::Prim prim = source.stage().prim(described.path);
  collider.name = source.name_of(prim ? described.path : Path(), "collision");
  collider.pose = pose_in_link(source, bodies, described, link);
  read_contacts(source, described, collider);
  const std::optional<GeometryKind> kind = geometry_kind(shape.kind, source.is_sdf());
  if (!kind) {
    source.left_out(described.path,
                    "the collider is of the kind " + std::string(scene::shape_name(shape.kind)));
    return std::nullopt;
  }
  collider.geometry.kind = *kind;
  collider.geometry.half_extents = shape.half_extents;
  collider.geometry.radius = shape.radius;
  collider.geometry.half_height = shape.half_height;
  if (*kind == GeometryKind::Cylinder || *kind == GeometryKind::Capsule ||
      *kind == GeometryKind::Plane) {
    collider.pose = collider.pose * Pose{{}, turn_from_z(shape.axis)};
  }
  return collider;
}

}  // namespace

void add_colliders(SceneSource& source, BodyTree& bodies, std::vector<robot::MeshFile>& meshes) {
  for (const scene::Collider& described : source.scene().colliders) {
    const std::optional<Index> link = link_of(bodies, described);
    if (!link) {
      source.left_out(described.path, "the collider is static and belongs to no link");
      continue;
    }
    if (!described.enabled) {
      source.left_out(described.path, "the collider is switched off");
      continue;
    }
    std::optional<robot::Collider> collider = read_collider(source, bodies, described, *link);
    if (!collider) {
      continue;
    }
    if (collider->geometry.kind == GeometryKind::Mesh) {
      collider->geometry.mesh = static_cast<Index>(meshes.size());
      meshes.push_back(triangles_of(source.scene().meshes[described.shape.mesh]));
    }
    bodies.tree.links()[*link].colliders.push_back(std::move(*collider));
  }
}

}  // namespace tenon::describe
