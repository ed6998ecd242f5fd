// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is drawn of a body beside what collides, as boxes along the world's axes at the start. Boxes
// far apart tell of a shape in another place or unit. Of others nothing is said, since many
// colliders cover a part of a body; in 61 published robots with 805 such bodies the widest gap
// is a fifth of the larger box, at the hips of a quadruped.
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "tenon/check/extents.h"
#include "tenon/check/simready/reading.h"
#include "tenon/check/subject.h"
#include "tenon/layer/field_values.h"
#include "tenon/math/matrix.h"
#include "tenon/stage/transform_at.h"

namespace tenon::check {
namespace {

constexpr double kApart = 0.25;  ///< of the diagonal of the larger of two boxes

struct Box {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};

  bool is_usable() const {
    return low[0] <= high[0] && std::isfinite(length(low)) && std::isfinite(length(high));
  }
  double diagonal() const { return length(high - low); }
  void add(const Vec3d& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::fmin(low[i], point[i]);
      high[i] = std::fmax(high[i], point[i]);
    }
  }
};

double size_of(const stage::Prim& prim, const char* name) {
  return std::fabs(simready::number(prim, name).value_or(0));
}

/// Of a shape that is round about an axis: half its height, and its radius.
Box round_box(const stage::Prim& prim, double half_height) {
  const double radius = size_of(prim, "radius");
  Vec3d half{{radius, radius, radius}};
  const std::string axis = simready::text(prim, "axis");
  half[axis == "X" ? 0 : axis == "Y" ? 1 : 2] = half_height;
  return {-half, half};
}

/// Around a gprim in its own frame, in stage units; none for planes and what has no points.
Box own_box(const stage::Prim& prim) {
  const Token type = prim.type_name();
  const double half_height = size_of(prim, "height") / 2;
  if (type == "Cube") {
    const double half = size_of(prim, "size") / 2;
    return {{{-half, -half, -half}}, {{half, half, half}}};
  }
  if (type == "Sphere") {
    return round_box(prim, size_of(prim, "radius"));
  }
  if (type == "Cylinder" || type == "Cone") {
    return round_box(prim, half_height);
  }
  if (type == "Capsule") {
    return round_box(prim, half_height + size_of(prim, "radius"));
  }
  const stage::Attribute extent = prim.attribute("extent");
  auto corners = extent.has_authored_value() ? extent.get_as<layer::Array<Vec3f>>() : std::nullopt;
  if (!corners && prim.is_a("PointBased")) {
    corners = prim.attribute("points").get_as<layer::Array<Vec3f>>();
  }
  Box box;
  for (const Vec3f& corner : corners.value_or(layer::Array<Vec3f>())) {
    box.add(to_double(corner));
  }
  return box;
}

void add_placed(const Box& own, const Mat4d& world, double unit, Box& box) {
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d corner{{(i & 1u) != 0 ? own.high[0] : own.low[0],
                        (i & 2u) != 0 ? own.high[1] : own.low[1],
                        (i & 4u) != 0 ? own.high[2] : own.low[2]}};
    box.add(transform_point(corner, world) * unit);
  }
}

/// Around the gprims that are drawn at and below a body, without those of other bodies [m].
class DrawnBoxes {
 public:
  explicit DrawnBoxes(const Subject& subject)
      : unit_(subject.scene.meters_per_unit), worlds_(stage::Time(subject.scene.start_time_code)) {
    for (const scene::Body& body : subject.scene.bodies) {
      bodies_.insert(body.path);
    }
  }

  Box of(const stage::Prim& body) {
    Box box;
    std::vector<stage::Prim> pending{body};
    while (!pending.empty()) {
      const stage::Prim at = pending.back();
      pending.pop_back();
      if (!at.is_active() || !at.is_loaded() || !at.is_defined() || at.is_abstract() ||
          (!(at == body) && bodies_.contains(at.path()))) {
        continue;
      }
      if (simready::is_rendered(at) && !simready::is_invisible(at)) {
        const Box own = own_box(at);
        if (own.is_usable()) {
          add_placed(own, worlds_.local_to_world(at), unit_, box);
        }
      }
      const std::vector<stage::Prim> children = at.children();
      pending.insert(pending.end(), children.begin(), children.end());
    }
    return box;
  }

 private:
  double unit_;
  stage::TransformCache worlds_;
  std::unordered_set<Path> bodies_;
};

/// The widest gap between two boxes along an axis of the world; below 0 where they meet [m].
double gap_between(const Box& a, const Box& b) {
  double gap = -kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    gap = std::fmax(gap, std::fmax(a.low[i] - b.high[i], b.low[i] - a.high[i]));
  }
  return gap;
}

/// What collides where it is drawn cannot be away from that.
bool is_drawn_itself(const Subject& subject, scene::Index collider) {
  const stage::Prim prim = subject.stage.prim(subject.scene.colliders[collider].path);
  return prim && simready::is_rendered(prim) && !simready::is_invisible(prim);
}

}  // namespace

void check_away_from_visual(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  DrawnBoxes drawn(subject);
  for (scene::Index i = 0; i < scene.bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    const stage::Prim prim = subject.stage.prim(body.path);
    const std::vector<scene::Index>& colliders = subject.colliders_of_body[i];
    const auto is_drawn = [&](scene::Index at) { return is_drawn_itself(subject, at); };
    if (!prim || colliders.empty() || std::any_of(colliders.begin(), colliders.end(), is_drawn)) {
      continue;
    }
    Box solid;
    for (const scene::Index collider : colliders) {
      const auto [low, high] = world_bounds(scene, scene.colliders[collider]);
      solid.add(low);
      solid.add(high);
    }
    const Box seen = solid.is_usable() ? drawn.of(prim) : Box{};
    const double gap = seen.is_usable() ? gap_between(solid, seen) : -kInfinity;
    if (gap > kApart * std::fmax(solid.diagonal(), seen.diagonal())) {
      Message message = "the colliders of the body are " + digits(gap) +
                        " m away from what is drawn of it: it touches where nothing is seen";
      message.about(body.path, RelatedRole::Body);
      report.at(subject.stage.prim(scene.colliders[colliders.front()].path), message,
                "move the colliders or the shapes that are drawn, whichever are in another place "
                "or unit");
    }
  }
}

}  // namespace tenon::check
