// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/scene_reader.h"

namespace tenon::describe {

using robot::GeometryKind;
using robot::Index;

/// Cyclic turns, so exact ones.
Quatd turn_from_z(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::X:
      return {0.5, 0.5, 0.5, 0.5};
    case scene::Axis::Y:
      return {-0.5, -0.5, -0.5, 0.5};
    case scene::Axis::Z:
      break;
  }
  return kIdentityRotation;
}

/// The nearest link at or above a prim; else that of its body.
std::optional<Index> SceneReader::link_above(Path prim, std::optional<scene::Index> body) const {
  for (Path at = prim; !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    if (const auto found = links_.find(at); found != links_.end()) {
      return found->second;
    }
  }
  return body ? static_cast<Index>(link_of_[*body]) : world_;
}

bool SceneReader::take_shape(const scene::Collider& source, robot::Collider& collider) {
  const scene::Shape& shape = source.shape;
  robot::Geometry& g = collider.geometry;
  g.half_extents = shape.half_extents;
  g.radius = shape.radius;
  g.half_height = shape.half_height;
  switch (shape.kind) {
    case scene::ShapeKind::Box:
      g.kind = GeometryKind::Box;
      return true;
    case scene::ShapeKind::Sphere:
      g.kind = GeometryKind::Sphere;
      return true;
    case scene::ShapeKind::Cylinder:
    case scene::ShapeKind::Capsule:
      g.kind =
          shape.kind == scene::ShapeKind::Capsule ? GeometryKind::Capsule : GeometryKind::Cylinder;
      collider.pose = collider.pose * Pose{{}, turn_from_z(shape.axis)};
      return true;
    case scene::ShapeKind::ConvexHull:
    case scene::ShapeKind::Mesh: {
      g.kind = GeometryKind::Mesh;
      g.mesh = static_cast<Index>(robot_.meshes.size());
      robot::MeshFile& file = robot_.meshes.emplace_back();
      for (const Vec3d& point : scene_.meshes[shape.mesh].points) {
        file.points.push_back(to_float(point));
      }
      file.triangles = scene_.meshes[shape.mesh].triangles;
      return true;
    }
    case scene::ShapeKind::Ellipsoid:
    case scene::ShapeKind::Cone:
    case scene::ShapeKind::Plane:
    case scene::ShapeKind::Spheres:
      break;
  }
  left_out(source.path,
           "the collider is of the kind " + std::string(scene::shape_name(shape.kind)));
  return false;
}

void SceneReader::add_collider(const scene::Collider& source) {
  const std::optional<Index> link = link_above(source.path, source.body);
  if (!link) {
    left_out(source.path, "the collider stands still and belongs to no link");
    return;
  }
  if (!source.enabled) {
    left_out(source.path, "the collider is switched off");
    return;
  }
  robot::Collider collider;
  const stage::Prim prim = stage_.prim(source.path);
  std::set<std::string> none;
  collider.name = unique(none, prim ? source.path : Path(), "collision");
  // In its body where it can be, which is exact; else by way of the world, as they stand.
  const bool in_body = source.body && link_of_[*source.body] == *link;
  const Pose body = source.body ? scene_.bodies[*source.body].pose : Pose{};
  collider.pose = in_body ? inverse(in_body_[*link]) * source.pose
                          : inverse(poses_[*link]) * body * source.pose;
  if (source.material) {
    left_out(source.path, "the collider has friction or restitution");
  }
  if (source.shape.kind == scene::ShapeKind::Mesh || !source.shape.pieces.empty()) {
    left_out(source.path, "the collider is more than the hull of its mesh");
  }
  if (take_shape(source, collider)) {
    robot_.links[*link].colliders.push_back(std::move(collider));
  }
}

void SceneReader::add_colliders() {
  for (const scene::Collider& source : scene_.colliders) {
    add_collider(source);
  }
}

}  // namespace tenon::describe
