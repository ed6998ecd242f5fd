// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Round shapes are roots of a quadratic along the ray, each bounded to its part of the axis. The
// nearest of all that lie ahead counts. Triangles are met where the ray pierces their plane inside
// of all three sides (Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection",
// 1997), from both sides.
#include "tenon/scene/shapes/ray_hit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenon::scene {
namespace {

struct Ray {
  Vec3d origin;
  Vec3d direction;
  Vec3d at(double distance) const { return origin + direction * distance; }
};

/// The nearest distance ahead of those that are offered.
class Nearest {
 public:
  void offer(double distance) {
    if (distance >= 0 && distance < found_) {
      found_ = distance;
    }
  }
  double found() const { return found_; }

 private:
  double found_ = kInfinity;
};

/// The real roots of a t^2 + 2 b t + c.
struct Roots {
  std::array<double, 2> at{};
  int count = 0;
};
Roots quadratic_roots(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(a > 0) || discriminant < 0) {
    return {};
  }
  const double root = std::sqrt(discriminant);
  return {{(-b - root) / a, (-b + root) / a}, 2};
}

void offer_ball(const Ray& ray, const Vec3d& radii, Nearest& nearest) {
  Vec3d origin = ray.origin;
  Vec3d direction = ray.direction;
  for (std::size_t k = 0; k < 3; ++k) {
    origin[k] /= radii[k];
    direction[k] /= radii[k];
  }
  const Roots roots =
      quadratic_roots(dot(direction, direction), dot(origin, direction), dot(origin, origin) - 1);
  for (int i = 0; i < roots.count; ++i) {
    nearest.offer(roots.at[static_cast<std::size_t>(i)]);
  }
}

void offer_box(const Ray& ray, const Vec3d& half, Nearest& nearest) {
  double enters = -kInfinity;
  double leaves = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0) {
      if (std::fabs(ray.origin[k]) > half[k]) {
        return;
      }
      continue;
    }
    const double first = (-half[k] - ray.origin[k]) / ray.direction[k];
    const double second = (half[k] - ray.origin[k]) / ray.direction[k];
    enters = std::max(enters, std::min(first, second));
    leaves = std::min(leaves, std::max(first, second));
  }
  if (enters <= leaves) {
    nearest.offer(enters);
    nearest.offer(leaves);
  }
}

/// The disc of `radius` across Z at `height`.
void offer_disc(const Ray& ray, double height, double radius, Nearest& nearest) {
  if (ray.direction[2] == 0) {
    return;
  }
  const double distance = (height - ray.origin[2]) / ray.direction[2];
  const Vec3d point = ray.at(distance);
  if (point[0] * point[0] + point[1] * point[1] <= radius * radius) {
    nearest.offer(distance);
  }
}

/// x^2 + y^2 = (radius + slope z)^2 between two heights.
void offer_side(const Ray& ray, double radius, double slope, double half_height, Nearest& nearest) {
  const Vec3d& o = ray.origin;
  const Vec3d& d = ray.direction;
  const double start = radius + slope * o[2];
  const double change = slope * d[2];
  const double a = d[0] * d[0] + d[1] * d[1] - change * change;
  const double b = o[0] * d[0] + o[1] * d[1] - start * change;
  const double c = o[0] * o[0] + o[1] * o[1] - start * start;
  const double sign = a < 0 ? -1 : 1;
  Roots roots = quadratic_roots(sign * a, sign * b, sign * c);
  if (a == 0 && b != 0) {
    roots = {{-c / (2 * b), 0}, 1};
  }
  for (int i = 0; i < roots.count; ++i) {
    const double distance = roots.at[static_cast<std::size_t>(i)];
    const double height = o[2] + distance * d[2];
    if (std::fabs(height) <= half_height && radius + slope * height >= 0) {
      nearest.offer(distance);
    }
  }
}

void offer_capsule(const Ray& ray, double radius, double half_height, Nearest& nearest) {
  offer_side(ray, radius, 0, half_height, nearest);
  for (const double sign : {-1.0, 1.0}) {
    const Ray from_cap{ray.origin - Vec3d{{0, 0, sign * half_height}}, ray.direction};
    const double b = dot(from_cap.origin, ray.direction);
    const Roots roots =
        quadratic_roots(1, b, dot(from_cap.origin, from_cap.origin) - radius * radius);
    for (int i = 0; i < roots.count; ++i) {
      const double distance = roots.at[static_cast<std::size_t>(i)];
      if (sign * from_cap.at(distance)[2] >= 0) {  // outside of the cylinder
        nearest.offer(distance);
      }
    }
  }
}

void offer_triangle(const Ray& ray, const Vec3d& a, const Vec3d& b, const Vec3d& c,
                    Nearest& nearest) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  const Vec3d across = cross(ray.direction, ac);
  const double determinant = dot(ab, across);
  if (determinant == 0) {
    return;
  }
  const Vec3d from = ray.origin - a;
  const double u = dot(from, across) / determinant;
  const Vec3d turned = cross(from, ab);
  const double v = dot(ray.direction, turned) / determinant;
  if (u >= 0 && v >= 0 && u + v <= 1) {
    nearest.offer(dot(ac, turned) / determinant);
  }
}

void offer_mesh(const Ray& ray, const TriangleMesh& mesh, Nearest& nearest) {
  for (const Vec3i& triangle : mesh.triangles) {
    const auto point = [&](std::size_t k) -> const Vec3d& {
      return mesh.points[static_cast<std::size_t>(triangle[k])];
    };
    offer_triangle(ray, point(0), point(1), point(2), nearest);
  }
}

/// The ray in axes whose Z is the axis of a shape.
Ray along_axis(const Ray& ray, Axis axis) {
  const auto z = static_cast<std::size_t>(axis);
  const auto turned = [z](const Vec3d& v) { return Vec3d{{v[(z + 1) % 3], v[(z + 2) % 3], v[z]}}; };
  return {turned(ray.origin), turned(ray.direction)};
}

void offer_plane(const Ray& ray, Nearest& nearest) {
  if (ray.direction[2] != 0) {
    nearest.offer(-ray.origin[2] / ray.direction[2]);
  }
}

void offer_round(const Ray& ray, const Shape& shape, Nearest& nearest) {
  switch (shape.kind) {
    case ShapeKind::Capsule:
      return offer_capsule(ray, shape.radius, shape.half_height, nearest);
    case ShapeKind::Cylinder:
      offer_side(ray, shape.radius, 0, shape.half_height, nearest);
      offer_disc(ray, -shape.half_height, shape.radius, nearest);
      return offer_disc(ray, shape.half_height, shape.radius, nearest);
    case ShapeKind::Cone:
      offer_side(ray, shape.radius / 2, -shape.radius / (2 * shape.half_height), shape.half_height,
                 nearest);
      return offer_disc(ray, -shape.half_height, shape.radius, nearest);
    default:
      return offer_plane(ray, nearest);
  }
}

}  // namespace

double ray_distance(const Shape& shape, const std::vector<TriangleMesh>& meshes,
                    const Vec3d& origin, const Vec3d& direction) {
  const Ray ray{origin, direction};
  Nearest nearest;
  switch (shape.kind) {
    case ShapeKind::Box:
      offer_box(ray, shape.half_extents, nearest);
      break;
    case ShapeKind::Sphere:
      offer_ball(ray, {{shape.radius, shape.radius, shape.radius}}, nearest);
      break;
    case ShapeKind::Ellipsoid:
      offer_ball(ray, shape.half_extents, nearest);
      break;
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      offer_mesh(ray, meshes[shape.mesh], nearest);
      break;
    case ShapeKind::Spheres:
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        const double radius = shape.sphere_radii[i];
        offer_ball({origin - shape.sphere_centers[i], direction}, {{radius, radius, radius}},
                   nearest);
      }
      break;
    default:
      offer_round(along_axis(ray, shape.axis), shape, nearest);
  }
  return nearest.found();
}

double bounding_radius(const Shape& shape, const std::vector<TriangleMesh>& meshes) {
  double radius = 0;
  switch (shape.kind) {
    case ShapeKind::Box:
      return length(shape.half_extents);
    case ShapeKind::Sphere:
      return shape.radius;
    case ShapeKind::Ellipsoid:
      return length(shape.half_extents);
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      for (const Vec3d& point : meshes[shape.mesh].points) {
        radius = std::max(radius, length(point));
      }
      return radius;
    case ShapeKind::Spheres:
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        radius = std::max(radius, length(shape.sphere_centers[i]) + shape.sphere_radii[i]);
      }
      return radius;
    case ShapeKind::Plane:
      return kInfinity;
    default:
      return shape.radius + shape.half_height;
  }
}

}  // namespace tenon::scene
