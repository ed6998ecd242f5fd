// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colliders as what engines receive: hulls and pieces by their corners, shapes that are given by
// numbers as triangles. A collider that is the triangles of a mesh which is seen shows that mesh.
#include <algorithm>
#include <map>
#include <optional>

#include "tenon/scene/shapes/convex_hull.h"
#include "tenon/scene/shapes/shape_mass.h"
#include "tenon/view/drawn_shapes.h"
#include "tenon/view/round_meshes.h"

namespace tenon::view {
namespace {

using scene::ShapeKind;

constexpr double kPlane = 10;  // half extents of a plane without end [m]

ViewMesh plain_mesh(const scene::TriangleMesh& mesh) {
  ViewMesh result;
  for (const Vec3d& point : mesh.points) {
    result.points.push_back(to_float(point));
  }
  for (const Vec3i& t : mesh.triangles) {
    for (const std::int32_t corner : t.v) {
      result.corners.push_back(static_cast<std::uint32_t>(corner));
    }
  }
  return result;
}

class ColliderShapes {
 public:
  ColliderShapes(const scene::PhysicsScene& scene, const ViewLimits& limits, ViewScene& view)
      : scene_(scene), limits_(limits), view_(view) {
    for (const ViewMesh& mesh : view.meshes) {
      corners_ += mesh.corners.size();
    }
    for (Index i = 0; i < view.shapes.size(); ++i) {
      seen_.emplace(view.shapes[i].path, i);
    }
  }

  void run() {
    for (const scene::Collider& collider : scene_.colliders) {
      add(collider);
    }
  }

 private:
  void add(const scene::Collider& collider) {
    const scene::Shape& shape = collider.shape;
    ViewCollider result;
    result.path = collider.path;
    result.body = collider.body;
    result.kind = shape.pieces.empty() ? scene::shape_name(shape.kind) : kSeveralHulls;
    if (collider.approximation) {
      result.approximation = scene::approximation_name(*collider.approximation);
    }
    result.enabled = collider.enabled;
    measure(shape, result);
    if (shape.kind == ShapeKind::Spheres) {
      add_balls(collider, result);
    } else if (shape.kind == ShapeKind::Mesh && show_seen(collider, result)) {
      view_.colliders.push_back(std::move(result));
      return;
    } else if (shape.kind == ShapeKind::ConvexHull || shape.kind == ShapeKind::Mesh) {
      for (const Index mesh :
           shape.pieces.empty() ? std::vector<Index>{shape.mesh} : shape.pieces) {
        put(collider, mesh_of(mesh, shape.kind == ShapeKind::ConvexHull), {{1, 1, 1}}, result);
      }
    } else {
      add_by_numbers(collider, result);
    }
    view_.colliders.push_back(std::move(result));
  }

  void measure(const scene::Shape& shape, ViewCollider& result) const {
    bool open = false;
    result.volume = scene::shape_integrals(shape, scene_.meshes, &open).volume;
    if (shape.kind != ShapeKind::ConvexHull || shape.mesh >= scene_.meshes.size()) {
      return;
    }
    const scene::TriangleMesh& mesh = scene_.meshes[shape.mesh];
    if (!mesh.triangles.empty() && scene::is_closed(mesh)) {
      result.source_volume = scene::mesh_integrals(mesh).volume;
      if (*result.source_volume > 0 && result.volume > 0) {
        result.hull_gap = std::max(0.0, result.volume / *result.source_volume - 1);
      }
    }
  }

  /// The shapes that are seen at the collider's path, in its own body.
  bool show_seen(const scene::Collider& collider, ViewCollider& result) {
    const auto [begin, end] = seen_.equal_range(collider.path);
    for (auto at = begin; at != end; ++at) {
      const ViewShape& shape = view_.shapes[at->second];
      if (shape.body == collider.body) {
        ViewShape copy = shape;
        copy.material.reset();
        result.shapes.push_back(static_cast<Index>(view_.collider_shapes.size()));
        view_.collider_shapes.push_back(copy);
      }
    }
    return !result.shapes.empty();
  }

  void add_balls(const scene::Collider& collider, ViewCollider& result) {
    const std::vector<Vec3d>& centers = collider.shape.sphere_centers;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const double radius = collider.shape.sphere_radii[i];
      put(collider, unit_ball(), {{radius, radius, radius}}, result, centers[i]);
    }
  }

  Index unit_ball() {
    if (!ball_) {
      ball_ = keep(ball_mesh(1));
    }
    return *ball_;
  }

  void add_by_numbers(const scene::Collider& collider, ViewCollider& result) {
    const scene::Shape& shape = collider.shape;
    const double r = shape.radius;
    const double h = shape.half_height;
    Index mesh = 0;
    Vec3d scale{{1, 1, 1}};
    if (shape.kind == ShapeKind::Sphere || shape.kind == ShapeKind::Ellipsoid) {
      mesh = unit_ball();
      scale = shape.kind == ShapeKind::Sphere ? Vec3d{{r, r, r}} : shape.half_extents;
    } else if (shape.kind == ShapeKind::Box) {
      mesh = keep(box_mesh(shape.half_extents));
    } else if (shape.kind == ShapeKind::Capsule) {
      mesh = keep(capsule_mesh(r, r, h));
    } else if (shape.kind == ShapeKind::Cone) {
      mesh = keep(frustum_mesh(r, 0, h));
    } else if (shape.kind == ShapeKind::Plane) {
      mesh = keep(plane_mesh(kPlane, kPlane));
    } else {
      mesh = keep(frustum_mesh(r, r, h));
    }
    put(collider, mesh, scale, result);
  }

  /// Corners of the triangles of a mesh of the scene, or of its hull.
  Index mesh_of(Index mesh, bool hull) {
    const auto [at, is_new] = known_.emplace(std::pair(mesh, hull), 0);
    if (is_new) {
      const scene::TriangleMesh& source = scene_.meshes[mesh];
      const scene::TriangleMesh made = hull ? scene::convex_hull(source.points) : source;
      at->second = keep(plain_mesh(made.triangles.empty() ? source : made));
    }
    return at->second;
  }

  Index keep(ViewMesh mesh) {
    corners_ += mesh.corners.size();
    view_.meshes.push_back(std::move(mesh));
    return static_cast<Index>(view_.meshes.size() - 1);
  }

  void put(const scene::Collider& collider, Index mesh, const Vec3d& scale, ViewCollider& result,
           const Vec3d& center = {}) {
    if (view_.collider_shapes.size() >= limits_.shapes || corners_ > limits_.corners) {
      if (!full_) {
        view_.notes.push_back({collider.path, "there are more colliders than can be shown"});
      }
      full_ = true;
      return;
    }
    const bool along_axis =
        collider.shape.kind == ShapeKind::Capsule || collider.shape.kind == ShapeKind::Cylinder ||
        collider.shape.kind == ShapeKind::Cone || collider.shape.kind == ShapeKind::Plane;
    ViewShape shape;
    shape.path = collider.path;
    shape.body = collider.body;
    shape.pose = collider.pose *
                 Pose{center, along_axis ? turn_from_z(collider.shape.axis) : kIdentityRotation};
    shape.scale = scale;
    shape.mesh = mesh;
    result.shapes.push_back(static_cast<Index>(view_.collider_shapes.size()));
    view_.collider_shapes.push_back(shape);
  }

  const scene::PhysicsScene& scene_;
  const ViewLimits& limits_;
  ViewScene& view_;
  std::multimap<Path, Index> seen_;
  std::map<std::pair<Index, bool>, Index> known_;
  std::optional<Index> ball_;
  std::size_t corners_ = 0;
  bool full_ = false;
};

}  // namespace

void add_colliders(const scene::PhysicsScene& scene, const ViewLimits& limits, ViewScene& view) {
  ColliderShapes(scene, limits, view).run();
}

}  // namespace tenon::view
