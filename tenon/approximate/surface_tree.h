// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::approximate {

/// The triangles of a mesh in a tree of boxes, for questions about places. Lengths are those of
/// the mesh [m].
class SurfaceTree {
 public:
  explicit SurfaceTree(const scene::TriangleMesh& mesh);

  bool empty() const { return triangles_.empty(); }
  struct Nearest {
    double distance = kInfinity;
    std::uint32_t triangle = 0;  ///< for distance_to
    std::size_t work = 0;        ///< boxes and triangles looked at
  };
  Nearest nearest(const Vec3d& point) const;
  double distance_to(std::uint32_t triangle, const Vec3d& point) const;
  /// The point is inside of the surface, which has to be closed; parts may lie in each other.
  bool contains(const Vec3d& point) const;

 private:
  struct Triangle {
    Vec3d a;
    Vec3d b;
    Vec3d c;
  };
  struct Box {
    Vec3d low{{kInfinity, kInfinity, kInfinity}};
    Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};
  };
  struct Node {
    Box box;
    std::uint32_t begin = 0;  ///< of a leaf, into triangles_
    std::uint32_t end = 0;    ///< the same; begin == end: it has two children
    std::uint32_t right = 0;  ///< the left one is next
  };

  void build();
  double distance_to(const Box& box, const Vec3d& point) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace tenon::approximate
