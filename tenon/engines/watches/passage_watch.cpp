// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Two rays decide: one along the way of the body's centre of mass in the step and one back. Where
// both meet the same collider, and what lies between is outside at both ends, the body has passed
// it, unless a contact pushes it back in the steps that follow. A collider that moves is passed as
// seen from its body. Planes have no other side.
#include "tenon/engines/watches/passage_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tenon/scene/shapes/ray_hit.h"

namespace tenon::engines {
namespace {

using scene::Index;
using scene::PhysicsScene;
using scene::Shape;
using scene::ShapeKind;

constexpr std::size_t kStepsBetween = 8;  // looks at all bodies,
constexpr std::size_t kCalmSteps = 32;    // where each is slower than this part of a fast one
constexpr double kCalm = 0.25;
constexpr int kStepsBehind = 2;  // until no contact pushes it back any more
constexpr std::size_t kMostTold = 100;
constexpr double kShortestWay = 1e-6;  // [m]

double thinnest_half(const std::vector<Vec3d>& points) {
  Vec3d low{kInfinity, kInfinity, kInfinity};
  Vec3d high = low * -1;
  for (const Vec3d& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  const Vec3d half = (high - low) * 0.5;
  return std::max(0.0, std::min({half[0], half[1], half[2]}));
}

/// Half of the thinnest side of a shape [m].
double thinnest_half(const Shape& shape, const std::vector<scene::TriangleMesh>& meshes) {
  switch (shape.kind) {
    case ShapeKind::Box:
    case ShapeKind::Ellipsoid:
      return std::min({shape.half_extents[0], shape.half_extents[1], shape.half_extents[2]});
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      return std::min(shape.radius, shape.half_height);
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      return thinnest_half(meshes[shape.mesh].points);
    case ShapeKind::Spheres:
      return shape.sphere_radii.empty()
                 ? 0
                 : *std::max_element(shape.sphere_radii.begin(), shape.sphere_radii.end());
    default:
      return shape.radius;
  }
}

std::vector<char> jointed_bodies(const PhysicsScene& scene) {
  std::vector<char> jointed(scene.bodies.size(), 0);
  for (const scene::Joint& joint : scene.joints) {
    for (const std::optional<Index>& body : {joint.body0, joint.body1}) {
      if (body && joint.enabled) {
        jointed[*body] = 1;
      }
    }
  }
  return jointed;
}

/// How far the body of a collider moved in the last step [m].
Vec3d step_of(const Simulation& simulation, const PhysicsScene& scene, Index collider) {
  const std::optional<Index>& body = scene.colliders[collider].body;
  return body ? simulation.body_state(*body).linear_velocity * simulation.time_step() : Vec3d{};
}

}  // namespace

Event passage_event(const PhysicsScene& scene, double time, Index body, Index collider,
                    double way) {
  const Path& other = scene.colliders[collider].path;
  char how[64];
  std::snprintf(how, sizeof how, " between two steps, in one of %.3g m", way);
  return {time, scene.bodies[body].path, "passed through <" + other.str() + ">" + how,
          EventKind::PassedThrough, other};
}

void PassageWatch::note(const Input& input) {
  fresh_ = fresh_ || input.kind == InputKind::BodyStates || input.kind == InputKind::JointStates;
}

void PassageWatch::begin(const Simulation& simulation, const PhysicsScene& scene) {
  if (!fresh_) {
    return;
  }
  fresh_ = false;
  steps_ = 0;
  list_bodies(scene);
  look_for_fast(simulation);
}

void PassageWatch::list_bodies(const PhysicsScene& scene) {
  bodies_.clear();
  fast_.clear();
  radii_.clear();
  open_.clear();
  const std::vector<char> jointed = jointed_bodies(scene);
  std::vector<Watched> by_body(scene.bodies.size());
  for (Index c = 0; c < scene.colliders.size(); ++c) {
    const scene::Collider& collider = scene.colliders[c];
    radii_.push_back(scene::bounding_radius(collider.shape, scene.meshes));
    if (collider.body && collider.enabled && !collider.settings.trigger) {
      Watched& watched = by_body[*collider.body];
      const double half = thinnest_half(collider.shape, scene.meshes);
      watched = {*collider.body, c, std::max(watched.way, half)};
    }
  }
  for (Index b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (by_body[b].way > 0 && jointed[b] == 0 && body.enabled && !body.kinematic) {
      bodies_.push_back(by_body[b]);
    }
  }
}

void PassageWatch::look_for_fast(const Simulation& simulation) {
  next_look_ = steps_ + kCalmSteps;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Watched& watched = bodies_[i];
    if (watched.fast) {
      continue;
    }
    const double way =
        length(simulation.body_state(watched.body).linear_velocity) * simulation.time_step();
    if (way > kCalm * watched.way) {
      next_look_ = steps_ + kStepsBetween;
    }
    if (way > watched.way) {
      watched.fast = true;
      watched.center = simulation.center_of_mass(watched.body);
      fast_.push_back(i);
    }
  }
}

std::vector<Event> PassageWatch::end(const Simulation& simulation, const PhysicsScene& scene) {
  std::vector<Event> found;
  std::erase_if(open_, [&](Passage& passage) {
    passage.from += step_of(simulation, scene, passage.collider);
    const Vec3d now = simulation.center_of_mass(passage.body);
    const bool behind = is_between(simulation, scene, passage.collider, passage.from, now);
    if (behind && ++passage.steps == kStepsBehind) {
      found.push_back(passage.event);
      told_.emplace_back(passage.body, passage.collider);
    }
    return !behind || passage.steps == kStepsBehind;
  });
  std::erase_if(fast_, [&](std::size_t i) {
    Watched& watched = bodies_[i];
    const Vec3d now = simulation.center_of_mass(watched.body);
    watched.fast = length(now - watched.center) > watched.way;
    if (watched.fast && told_.size() < kMostTold) {
      look_along(simulation, scene, watched, now);
    }
    watched.center = now;
    return !watched.fast;
  });
  if (++steps_ >= next_look_) {
    look_for_fast(simulation);
  }
  return found;
}

bool PassageWatch::is_between(const Simulation& simulation, const PhysicsScene& scene,
                              Index collider, const Vec3d& from, const Vec3d& to) const {
  const scene::Collider& source = scene.colliders[collider];
  const Pose place =
      source.body ? simulation.body_state(*source.body).pose * source.pose : source.pose;
  const Pose inward = inverse(place);
  const Vec3d start = transform_point(inward, from);
  const Vec3d end = transform_point(inward, to);
  const double way = length(end - start);
  if (way <= kShortestWay) {
    return false;
  }
  const Vec3d direction = (end - start) * (1 / way);
  return length(cross(start, direction)) <= radii_[collider] &&
         scene::ray_distance(source.shape, scene.meshes, start, direction) +
                 scene::ray_distance(source.shape, scene.meshes, end, direction * -1) <=
             way;
}

void PassageWatch::look_along(const Simulation& simulation, const PhysicsScene& scene,
                              const Watched& watched, const Vec3d& to) {
  for (Index c = 0; c < scene.colliders.size(); ++c) {
    const scene::Collider& collider = scene.colliders[c];
    const std::pair pair(watched.body, c);
    if (collider.shape.kind == ShapeKind::Plane || collider.body == watched.body ||
        !scene.may_collide(watched.collider, c) ||
        std::find(told_.begin(), told_.end(), pair) != told_.end() ||
        std::any_of(open_.begin(), open_.end(), [&](const Passage& passage) {
          return std::pair(passage.body, passage.collider) == pair;
        })) {
      continue;
    }
    const Vec3d from = watched.center + step_of(simulation, scene, c);
    if (is_between(simulation, scene, c, from, to)) {
      open_.push_back(
          {watched.body, c, from,
           passage_event(scene, simulation.time(), watched.body, c, length(to - watched.center))});
    }
  }
}

}  // namespace tenon::engines
