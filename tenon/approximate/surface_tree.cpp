// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Triangles are halved at the median of their middles along the longest side of their box, down to
// four of them. The nearest point of a triangle is found by the region of its plane that the point
// lies over (Ericson, Real-Time Collision Detection, 2005, section 5.1.5). Inside is where a ray
// leaves more often than it enters, which also holds where closed parts overlap.
#include "tenon/approximate/surface_tree.h"

#include <algorithm>
#include <cmath>

namespace tenon::approximate {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

/// The place on a triangle that is next to `p`.
Vec3d nearest_place(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  const double d1 = dot(ab, p - a);
  const double d2 = dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) {
    return a;
  }
  const double d3 = dot(ab, p - b);
  const double d4 = dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    return a + ab * (d1 - d3 > 0 ? d1 / (d1 - d3) : 0);
  }
  const double d5 = dot(ab, p - c);
  const double d6 = dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    return a + ac * (d2 - d6 > 0 ? d2 / (d2 - d6) : 0);
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double along = (d4 - d3) + (d5 - d6);
    return b + (c - b) * (along > 0 ? (d4 - d3) / along : 0);
  }
  const double all = va + vb + vc;
  return all > 0 ? a + ab * (vb / all) + ac * (vc / all) : a;
}

/// How often a ray from `point` leaves through a triangle: -1 where it enters (Moeller and
/// Trumbore, 1997).
int crossing(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& point,
             const Vec3d& direction) {
  const Vec3d normal = cross(b - a, c - a);
  const double along = dot(normal, direction);
  const double sign = along > 0 ? 1 : -1;
  const Vec3d away = point - a;
  const Vec3d turned = cross(away, direction);
  const double u = -sign * dot(c - a, turned);
  const double v = sign * dot(b - a, turned);
  const bool meets =
      along != 0 && u >= 0 && v >= 0 && u + v <= std::fabs(along) && -sign * dot(normal, away) > 0;
  return !meets ? 0 : along > 0 ? 1 : -1;
}

/// No edge of a mesh that people make runs along it.
const Vec3d kDirection = normalized(Vec3d{{0.5773191, 0.6180341, 0.5336497}});

}  // namespace

SurfaceTree::SurfaceTree(const scene::TriangleMesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const Vec3i& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    triangles_.push_back({corner(0), corner(1), corner(2)});
  }
  if (!triangles_.empty()) {
    build();
  }
}

void SurfaceTree::build() {
  struct Part {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t parent;  // whose right child it is; that of the root: none
  };
  constexpr auto kNoParent = static_cast<std::uint32_t>(-1);
  std::vector<Part> pending{{0, static_cast<std::uint32_t>(triangles_.size()), kNoParent}};
  while (!pending.empty()) {
    const Part part = pending.back();
    pending.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    if (part.parent != kNoParent) {
      nodes_[part.parent].right = index;
    }
    Node& node = nodes_.emplace_back();
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
      for (const Vec3d* corner : {&triangles_[i].a, &triangles_[i].b, &triangles_[i].c}) {
        for (std::size_t k = 0; k < 3; ++k) {
          node.box.low[k] = std::min(node.box.low[k], (*corner)[k]);
          node.box.high[k] = std::max(node.box.high[k], (*corner)[k]);
        }
      }
    }
    if (part.end - part.begin <= kLeaf) {
      node.begin = part.begin;
      node.end = part.end;
      continue;
    }
    const Vec3d size = node.box.high - node.box.low;
    const std::size_t longest = size[0] >= size[1] && size[0] >= size[2] ? 0
                                : size[1] >= size[2]                     ? 1
                                                                         : 2;
    const std::uint32_t middle = part.begin + (part.end - part.begin) / 2;
    const auto place = [longest](const Triangle& t) {
      return t.a[longest] + t.b[longest] + t.c[longest];
    };
    const auto first = triangles_.begin();
    std::nth_element(first + part.begin, first + middle, first + part.end,
                     [&](const Triangle& x, const Triangle& y) { return place(x) < place(y); });
    pending.push_back({middle, part.end, index});
    pending.push_back({part.begin, middle, kNoParent});
  }
}

double SurfaceTree::distance_to(const Box& box, const Vec3d& point) const {
  Vec3d apart;
  for (std::size_t k = 0; k < 3; ++k) {
    apart[k] = std::max({box.low[k] - point[k], point[k] - box.high[k], 0.0});
  }
  return length(apart);
}

double SurfaceTree::distance_to(std::uint32_t triangle, const Vec3d& point) const {
  const Triangle& t = triangles_[triangle];
  return length(point - nearest_place(t.a, t.b, t.c, point));
}

SurfaceTree::Nearest SurfaceTree::nearest(const Vec3d& point) const {
  Nearest found;
  if (nodes_.empty()) {
    return found;
  }
  std::vector<std::uint32_t> pending{0};
  while (!pending.empty()) {
    const std::uint32_t index = pending.back();
    pending.pop_back();
    const Node& node = nodes_[index];
    found.work += 1 + node.end - node.begin;
    if (distance_to(node.box, point) >= found.distance) {
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const double distance = distance_to(i, point);
      if (distance < found.distance) {
        found.distance = distance;
        found.triangle = i;
      }
    }
    if (node.begin == node.end) {
      const bool left_first =
          distance_to(nodes_[index + 1].box, point) <= distance_to(nodes_[node.right].box, point);
      pending.push_back(left_first ? node.right : index + 1);
      pending.push_back(left_first ? index + 1 : node.right);
    }
  }
  return found;
}

bool SurfaceTree::contains(const Vec3d& point) const {
  int leaves = 0;
  std::vector<std::uint32_t> pending;
  if (!nodes_.empty()) {
    pending.push_back(0);
  }
  while (!pending.empty()) {
    const std::uint32_t index = pending.back();
    pending.pop_back();
    const Node& node = nodes_[index];
    double from = 0;
    double to = kInfinity;
    for (std::size_t k = 0; k < 3; ++k) {  // the direction goes up along each axis
      from = std::max(from, (node.box.low[k] - point[k]) / kDirection[k]);
      to = std::min(to, (node.box.high[k] - point[k]) / kDirection[k]);
    }
    if (from > to) {
      continue;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const Triangle& t = triangles_[i];
      leaves += crossing(t.a, t.b, t.c, point, kDirection);
    }
    if (node.begin == node.end) {
      pending.push_back(index + 1);
      pending.push_back(node.right);
    }
  }
  return leaves != 0;
}

}  // namespace tenon::approximate
