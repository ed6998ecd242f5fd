// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/physics_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tenon::physics {
namespace {

/// Place of `seconds` between two samples.
struct Place {
  std::size_t before = 0;
  std::size_t after = 0;
  double fraction = 0;
};

/// `times` is not empty and ascending; outside it the first or last sample holds.
Place place_of(const std::vector<double>& times, double seconds) {
  const auto above = std::upper_bound(times.begin(), times.end(), seconds);
  if (above == times.begin()) {
    return {};
  }
  const auto after = static_cast<std::size_t>(above - times.begin());
  if (above == times.end()) {
    return {after - 1, after - 1, 0};
  }
  const double span = times[after] - times[after - 1];
  return {after - 1, after, (seconds - times[after - 1]) / span};
}

bool groups_allow(const CollisionFilter& filter, Index a, Index b) {
  if (filter.group_paths.empty()) {
    return true;
  }
  const std::vector<Index>& of_a = filter.groups_of_collider[a];
  const std::vector<Index>& of_b = filter.groups_of_collider[b];
  const auto touches_ungrouped = [&](const std::vector<Index>& groups) {
    return std::none_of(groups.begin(), groups.end(),
                        [&](Index g) { return filter.ungrouped_off[g] != 0; });
  };
  if (of_a.empty() || of_b.empty()) {
    return touches_ungrouped(of_a) && touches_ungrouped(of_b);
  }
  // S-77: off when any pair of memberships is off.
  return std::none_of(of_a.begin(), of_a.end(), [&](Index g) {
    return std::any_of(of_b.begin(), of_b.end(), [&](Index h) {
      return filter.group_pair_off[g * filter.group_paths.size() + h] != 0;
    });
  });
}

/// Nothing but filters keeps the two apart.
bool could_touch(const Collider& a, const Collider& b) {
  return a.enabled && b.enabled && a.scene == b.scene && a.body != b.body;
}

}  // namespace

std::string_view mass_source_name(MassSource source) {
  constexpr std::array<std::string_view, 3> kNames{"authored", "density", "default"};
  return kNames[static_cast<std::size_t>(source)];
}

double combine(double a, CombineMode mode_a, double b, CombineMode mode_b) {
  switch (std::max(mode_a, mode_b)) {
    case CombineMode::Average:
      return (a + b) / 2;
    case CombineMode::Min:
      return std::fmin(a, b);
    case CombineMode::Multiply:
      return a * b;
    case CombineMode::Max:
      break;
  }
  return std::fmax(a, b);
}

std::string_view combine_name(CombineMode mode) {
  constexpr std::string_view kNames[] = {"average", "min", "multiply", "max"};
  return kNames[static_cast<std::size_t>(mode)];
}

std::string_view shape_name(ShapeKind kind) {
  constexpr std::array<std::string_view, 10> kNames{"box",      "sphere", "ellipsoid", "capsule",
                                                    "cylinder", "cone",   "plane",     "convexHull",
                                                    "mesh",     "spheres"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view approximation_name(Approximation approximation) {
  constexpr std::array<std::string_view, 6> kNames{
      "none",           "convexHull",  "convexDecomposition", "meshSimplification",
      "boundingSphere", "boundingCube"};
  return kNames[static_cast<std::size_t>(approximation)];
}

std::string_view joint_kind_name(JointKind kind) {
  constexpr std::array<std::string_view, 6> kNames{"revolute", "prismatic", "spherical",
                                                   "fixed",    "distance",  "d6"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view dof_name(Dof dof) {
  constexpr std::array<std::string_view, 7> kNames{"transX", "transY", "transZ",  "rotX",
                                                   "rotY",   "rotZ",   "distance"};
  return kNames[static_cast<std::size_t>(dof)];
}

Dof Joint::dof() const {
  if (kind == JointKind::Distance) {
    return Dof::Distance;
  }
  const Dof first = kind == JointKind::Prismatic ? Dof::TransX : Dof::RotX;
  return static_cast<Dof>(static_cast<unsigned>(first) + static_cast<unsigned>(axis));
}

double ScalarTrack::at(double seconds) const {
  if (times.empty()) {
    return 0;
  }
  const Place place = place_of(times, seconds);
  if (held || place.before == place.after) {
    return values[place.before];
  }
  return values[place.before] + (values[place.after] - values[place.before]) * place.fraction;
}

Pose PoseTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Place place = place_of(times, seconds);
  const Pose& a = poses[place.before];
  if (held || place.before == place.after) {
    return a;
  }
  const Pose& b = poses[place.after];
  return {a.position + (b.position - a.position) * place.fraction,
          normalized(slerp(a.orientation, b.orientation, place.fraction))};
}

bool SwitchTrack::at(double seconds) const {
  return !times.empty() && values[place_of(times, seconds).before] != 0;
}

namespace {

/// Between two bounds of which either may be open.
double between(double a, double b, double fraction) {
  return std::isfinite(a) && std::isfinite(b) ? a + (b - a) * fraction : a;
}

}  // namespace

JointBounds BoundsTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Place place = place_of(times, seconds);
  JointBounds now = bounds[place.before];
  const JointBounds& next = bounds[place.after];
  if (held || place.before == place.after) {
    return now;
  }
  now.lower = between(now.lower, next.lower, place.fraction);
  now.upper = between(now.upper, next.upper, place.fraction);
  now.cone_angle0 = between(now.cone_angle0, next.cone_angle0, place.fraction);
  now.cone_angle1 = between(now.cone_angle1, next.cone_angle1, place.fraction);
  for (std::size_t i = 0; i < now.limits.size() && i < next.limits.size(); ++i) {
    now.limits[i].lower = between(now.limits[i].lower, next.limits[i].lower, place.fraction);
    now.limits[i].upper = between(now.limits[i].upper, next.limits[i].upper, place.fraction);
  }
  return now;
}

std::size_t ShapesTrack::at(double seconds) const {
  return times.empty() ? 0 : place_of(times, seconds).before;
}

Vec3d GravityTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Place place = place_of(times, seconds);
  const Vec3d& a = gravity[place.before];
  return held || place.before == place.after ? a : a + (gravity[place.after] - a) * place.fraction;
}

void PhysicsScene::update_joint_pairs() {
  if (filter.joint_pairs.empty()) {
    return;
  }
  filter.pairs_off = filter.permanent_pairs;
  for (const JointPairs& own : filter.joint_pairs) {
    const Joint& joint = joints[own.joint];
    if (joint.enabled && !joint.collision_enabled) {
      filter.pairs_off.insert(filter.pairs_off.end(), own.pairs.begin(), own.pairs.end());
    }
  }
  std::sort(filter.pairs_off.begin(), filter.pairs_off.end());
  filter.pairs_off.erase(std::unique(filter.pairs_off.begin(), filter.pairs_off.end()),
                         filter.pairs_off.end());
}

bool PhysicsScene::may_collide(Index collider_a, Index collider_b) const {
  const Index low = std::min(collider_a, collider_b);
  const Index high = std::max(collider_a, collider_b);
  return could_touch(colliders[low], colliders[high]) && groups_allow(filter, low, high) &&
         !std::binary_search(filter.pairs_off.begin(), filter.pairs_off.end(),
                             std::pair(low, high));
}

std::vector<std::pair<Index, Index>> PhysicsScene::disabled_pairs() const {
  std::vector<std::pair<Index, Index>> result;
  for (const auto& [a, b] : filter.pairs_off) {
    if (could_touch(colliders[a], colliders[b])) {
      result.emplace_back(a, b);
    }
  }
  if (filter.group_paths.empty()) {
    return result;
  }
  const auto count = static_cast<Index>(colliders.size());
  for (Index a = 0; a < count; ++a) {
    for (Index b = a + 1; b < count; ++b) {
      if (could_touch(colliders[a], colliders[b]) && !groups_allow(filter, a, b)) {
        result.emplace_back(a, b);
      }
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace tenon::physics
