// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The largest distance from a surface to something is found by halving triangles, those first whose
// bound is highest. A bound is the distance at the middle plus the radius, as distances change no
// faster than places do; and the largest distance of the corners to one convex part of the other
// side, as distances to a convex part are largest at corners. So what lies on each other is found
// without halving. The search ends where no bound is more than the tolerance above the best.
#include "tenon/approximate/surface_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <utility>

#include "tenon/approximate/surface_tree.h"
#include "tenon/base/limits/collider_limits.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::approximate {

double diagonal_of(const scene::TriangleMesh& mesh) {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high = -low;
  for (const Vec3d& point : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  return mesh.points.empty() ? 0 : length(high - low);
}

namespace {

using scene::Shape;
using scene::ShapeKind;
using scene::TriangleMesh;

constexpr double kTolerance = 0.005;  // of the size of the mesh
constexpr int kAround = 64;           // corners of what is round

/// A place as a target sees it.
struct Seen {
  double distance = kInfinity;  // below zero: inside, and by how much at least
  std::uint32_t part = 0;       // convex, and this near or nearer
  std::size_t work = 0;         // boxes, triangles and planes looked at
};

/// A solid within planes.
class ConvexPart {
 public:
  explicit ConvexPart(const TriangleMesh& mesh) : tree_(mesh), slack_(1e-9 * diagonal_of(mesh)) {
    for (const Vec3i& t : mesh.triangles) {
      const auto corner = [&](std::size_t i) {
        return mesh.points[static_cast<std::size_t>(t[i])];
      };
      const Vec3d normal = cross(corner(1) - corner(0), corner(2) - corner(0));
      if (length(normal) > 1e3 * slack_ * slack_) {  // slivers have no direction
        normals_.push_back(normalized(normal));
        offsets_.push_back(dot(normals_.back(), corner(0)));
      }
    }
  }

  /// Inside: minus the depth.
  Seen nearest(const Vec3d& point) const {
    double highest = -kInfinity;
    std::size_t looked_at = 0;
    for (; looked_at < normals_.size() && highest <= slack_; ++looked_at) {
      highest = std::max(highest, dot(normals_[looked_at], point) - offsets_[looked_at]);
    }
    if (!normals_.empty() && highest <= slack_) {
      return {std::min(highest, 0.0), 0, looked_at};
    }
    const SurfaceTree::Nearest found = tree_.nearest(point);
    return {found.distance, 0, looked_at + found.work};
  }

 private:
  SurfaceTree tree_;
  double slack_;
  std::vector<Vec3d> normals_;
  std::vector<double> offsets_;
};

/// What collides, as a target.
class ShapeTarget {
 public:
  explicit ShapeTarget(const ShapeSurface& shape) : ball_(shape.ball) {
    for (const TriangleMesh& part : shape.parts) {
      if (shape.is_solid) {
        parts_.emplace_back(part);
      } else {
        triangles_.emplace(part);
      }
    }
  }

  Seen nearest(const Vec3d& point) const {
    if (ball_) {
      return {distance_to(0, point), 0, 1};
    }
    if (triangles_) {
      const SurfaceTree::Nearest found = triangles_->nearest(point);
      return {found.distance, found.triangle, found.work};
    }
    Seen seen;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const Seen own = parts_[i].nearest(point);
      if (own.distance < seen.distance) {
        seen.distance = own.distance;
        seen.part = i;
      }
      seen.work += own.work;
    }
    return seen;
  }
  double distance_to(std::uint32_t part, const Vec3d& point) const {
    return ball_        ? length(point - ball_->center) - ball_->radius
           : triangles_ ? triangles_->distance_to(part, point)
                        : parts_[part].nearest(point).distance;
  }

 private:
  std::optional<scene::BoundingBall> ball_;
  std::vector<ConvexPart> parts_;
  std::optional<SurfaceTree> triangles_;
};

/// What it represents, as a target.
class MeshTarget {
 public:
  explicit MeshTarget(const TriangleMesh& mesh) : tree_(mesh), closed_(scene::is_closed(mesh)) {}

  Seen nearest(const Vec3d& point) const {
    const SurfaceTree::Nearest found = tree_.nearest(point);
    const bool inside = closed_ && tree_.contains(point);
    return {inside ? -found.distance : found.distance, found.triangle, found.work};
  }
  double distance_to(std::uint32_t part, const Vec3d& point) const {
    return tree_.distance_to(part, point);
  }

 private:
  SurfaceTree tree_;
  bool closed_;
};

/// The largest distance from points of surfaces to a target.
template <class Target>
class Farthest {
 public:
  /// `place` is one of the target's.
  Farthest(const Target& target, const Vec3d& place, double tolerance)
      : target_(target), place_(place), tolerance_(tolerance) {}

  void look_at(const TriangleMesh& mesh) {
    for (const Vec3d& point : mesh.points) {
      if (is_spent()) {
        left_out_ = std::max(left_out_, length(point - place_));
        continue;
      }
      best_ = std::max(best_, nearest(point).distance);
    }
    for (const Vec3i& t : mesh.triangles) {
      const auto corner = [&](std::size_t i) {
        return mesh.points[static_cast<std::size_t>(t[i])];
      };
      add(corner(0), corner(1), corner(2));
    }
  }

  void refine() {
    for (std::size_t halved = 0; !pending_.empty() && halved < limits::kSurfaceParts && !is_spent();
         ++halved) {
      const Part part = pending_.top();
      if (part.bound <= best_ + tolerance_) {
        return;
      }
      pending_.pop();
      const auto& [a, b, c] = part.corners;
      const Vec3d ab = (a + b) * 0.5;
      const Vec3d bc = (b + c) * 0.5;
      const Vec3d ca = (c + a) * 0.5;
      add(a, ab, ca);
      add(ab, b, bc);
      add(ca, bc, c);
      add(ab, bc, ca);
    }
  }

  double best() const { return best_; }
  double error() const {
    const double bound = pending_.empty() ? left_out_ : std::max(left_out_, pending_.top().bound);
    return std::max(0.0, bound - best_);
  }

 private:
  struct Part {
    double bound = 0;
    std::array<Vec3d, 3> corners;
    bool operator<(const Part& other) const { return bound < other.bound; }
  };

  bool is_spent() const { return work_ >= limits::kSurfaceWork; }

  Seen nearest(const Vec3d& point) {
    const Seen seen = target_.nearest(point);
    work_ += seen.work;
    return seen;
  }

  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    if (is_spent()) {  // no place is farther than from one place of the target
      for (const Vec3d& corner : {a, b, c}) {
        left_out_ = std::max(left_out_, length(corner - place_));
      }
      return;
    }
    const Vec3d middle = (a + b + c) * (1.0 / 3);
    const Seen seen = nearest(middle);
    best_ = std::max(best_, seen.distance);
    double radius = 0;
    double corner_bound = 0;
    for (const Vec3d& corner : {a, b, c}) {
      radius = std::max(radius, length(corner - middle));
      corner_bound = std::max(corner_bound, target_.distance_to(seen.part, corner));
    }
    const double bound = std::min(seen.distance + radius, corner_bound);
    if (bound > best_ + tolerance_) {
      pending_.push({bound, {a, b, c}});
    } else {
      left_out_ = std::max(left_out_, bound);
    }
  }

  const Target& target_;
  Vec3d place_;
  double tolerance_;
  std::size_t work_ = 0;
  double best_ = 0;
  double left_out_ = 0;  // the highest bound of what is not halved
  std::priority_queue<Part> pending_;
};

/// A profile of heights and radii turned about Z, its first and last radius zero.
TriangleMesh turned(const std::vector<std::pair<double, double>>& profile) {
  TriangleMesh mesh;
  for (const auto& [height, radius] : profile) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * M_PI * i / kAround;
      mesh.points.push_back({{radius * std::cos(angle), radius * std::sin(angle), height}});
    }
  }
  for (int ring = 0; ring + 1 < static_cast<int>(profile.size()); ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const int next = (i + 1) % kAround;
      const int low = ring * kAround;
      const int high = low + kAround;
      mesh.triangles.push_back({{low + i, low + next, high + next}});
      mesh.triangles.push_back({{low + i, high + next, high + i}});
    }
  }
  return mesh;
}

/// Rings of two half balls of `radius`, whose middles are `half_height` away from the origin.
std::vector<std::pair<double, double>> round_profile(double radius, double half_height) {
  constexpr int kHalf = kAround / 2;
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= kHalf; ++i) {
    const double angle = M_PI * i / kHalf;
    const double height = i * 4 < kAround ? -half_height : i * 4 > kAround ? half_height : 0;
    if (i * 4 == kAround && half_height > 0) {
      profile.emplace_back(-half_height, radius);
      profile.emplace_back(half_height, radius);
    } else {
      const bool is_end = i == 0 || i == kHalf;
      profile.emplace_back(height - radius * std::cos(angle),
                           is_end ? 0 : radius * std::sin(angle));
    }
  }
  return profile;
}

/// From an axis along Z to the one of a shape, without a change of handedness.
Vec3d along_axis(const Vec3d& p, scene::Axis axis) {
  return axis == scene::Axis::X   ? Vec3d{{p[2], p[0], p[1]}}
         : axis == scene::Axis::Y ? Vec3d{{p[1], p[2], p[0]}}
                                  : p;
}

TriangleMesh box_mesh(const Vec3d& half) {
  std::vector<Vec3d> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({{(i & 1) != 0 ? half[0] : -half[0], (i & 2) != 0 ? half[1] : -half[1],
                       (i & 4) != 0 ? half[2] : -half[2]}});
  }
  return {std::move(points),
          {{{0, 2, 1}},
           {{1, 2, 3}},
           {{4, 5, 6}},
           {{5, 7, 6}},
           {{0, 1, 4}},
           {{1, 5, 4}},
           {{2, 6, 3}},
           {{3, 6, 7}},
           {{0, 4, 2}},
           {{2, 4, 6}},
           {{1, 3, 5}},
           {{3, 7, 5}}},
          false};
}

TriangleMesh round_mesh(const Shape& shape) {
  const double r = shape.radius;
  const double h = shape.half_height;
  TriangleMesh mesh;
  switch (shape.kind) {
    case ShapeKind::Capsule:
      mesh = turned(round_profile(r, h));
      break;
    case ShapeKind::Cylinder:
      mesh = turned({{-h, 0}, {-h, r}, {h, r}, {h, 0}});
      break;
    case ShapeKind::Cone:
      mesh = turned({{-h, 0}, {-h, r}, {h, 0}});
      break;
    default:
      mesh = turned(round_profile(shape.kind == ShapeKind::Ellipsoid ? 1 : r, 0));
  }
  for (Vec3d& point : mesh.points) {
    if (shape.kind == ShapeKind::Ellipsoid) {
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] *= shape.half_extents[k];
      }
    } else {
      point = along_axis(point, shape.axis);
    }
  }
  return mesh;
}

}  // namespace

ShapeSurface surface_of(const Shape& shape) {
  ShapeSurface surface;
  switch (shape.kind) {
    case ShapeKind::Box:
      surface.parts.push_back(box_mesh(shape.half_extents));
      break;
    case ShapeKind::Sphere:
      surface.ball = scene::BoundingBall{{}, shape.radius};
      surface.parts.push_back(welded(round_mesh(shape)));
      break;
    case ShapeKind::Ellipsoid:
    case ShapeKind::Capsule:
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      surface.parts.push_back(welded(round_mesh(shape)));
      break;
    case ShapeKind::Spheres:
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        Shape ball;
        ball.kind = ShapeKind::Sphere;
        ball.radius = shape.sphere_radii[i];
        TriangleMesh mesh = welded(round_mesh(ball));
        for (Vec3d& point : mesh.points) {
          point += shape.sphere_centers[i];
        }
        surface.parts.push_back(std::move(mesh));
      }
      break;
    case ShapeKind::Plane:
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      break;
  }
  return surface;
}

namespace {

Vec3d first_place(const TriangleMesh& mesh) {
  return mesh.points.empty() ? Vec3d{} : mesh.points[0];
}

}  // namespace

SurfaceGap surface_gap(const TriangleMesh& mesh, const ShapeSurface& shape) {
  const double tolerance = kTolerance * diagonal_of(mesh);
  const MeshTarget mesh_target(mesh);
  Farthest<MeshTarget> outside(mesh_target, first_place(mesh), tolerance);
  for (const TriangleMesh& part : shape.parts) {
    outside.look_at(part);
  }
  outside.refine();
  const ShapeTarget shape_target(shape);
  const Vec3d of_shape = shape.parts.empty() ? Vec3d{} : first_place(shape.parts[0]);
  Farthest<ShapeTarget> inside(shape_target, of_shape, tolerance);
  inside.look_at(mesh);
  inside.refine();
  return {outside.best(), inside.best(), std::max(outside.error(), inside.error())};
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.flat = mesh.flat;
  std::map<std::array<double, 3>, std::int32_t> known;
  std::vector<std::int32_t> number;
  for (const Vec3d& point : mesh.points) {
    const auto [found, is_new] =
        known.try_emplace(point.v, static_cast<std::int32_t>(result.points.size()));
    if (is_new) {
      result.points.push_back(point);
    }
    number.push_back(found->second);
  }
  for (const Vec3i& t : mesh.triangles) {
    const Vec3i made{{number[static_cast<std::size_t>(t[0])],
                      number[static_cast<std::size_t>(t[1])],
                      number[static_cast<std::size_t>(t[2])]}};
    if (made[0] != made[1] && made[1] != made[2] && made[2] != made[0]) {
      result.triangles.push_back(made);
    }
  }
  return result;
}

}  // namespace tenon::approximate
