// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A track holds samples in ascending time: outside of them the first or the last one counts,
// between two of them numbers are blended unless the track is held, and switches and shapes hold. A
// bound that is infinite at one of the two is not blended.
// Filters only remove pairs. Two colliders may touch unless they are off, both static, of one body
// or of different scenes, or unless their groups (S-77) or the sorted list of pairs say no. Pairs
// of joints that may break or be switched are kept by joint, so that the list can be rebuilt.
#include "tenon/scene/physics_scene.h"

#include <algorithm>
#include <cmath>

#include "tenon/scene/fields/enum_names.h"

namespace tenon::scene {
namespace {

/// The two samples that a time lies between, and how far it is from the first to the second.
struct Between {
  std::size_t before = 0;
  std::size_t after = 0;
  double fraction = 0;
};

/// `times` is not empty and ascending; outside it the first or last sample holds.
Between between_samples(const std::vector<double>& times, double seconds) {
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

std::string_view mass_source_name(MassSource source) { return name_of(source); }

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

std::string_view combine_name(CombineMode mode) { return name_of(mode); }

std::string_view shape_name(ShapeKind kind) { return name_of(kind); }

std::string_view approximation_name(Approximation approximation) { return name_of(approximation); }

std::string_view sensor_kind_name(SensorKind kind) { return name_of(kind); }
std::string_view joint_kind_name(JointKind kind) { return name_of(kind); }

std::string_view dof_name(Dof dof) { return name_of(dof); }

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
  const Between span = between_samples(times, seconds);
  if (held || span.before == span.after) {
    return values[span.before];
  }
  return values[span.before] + (values[span.after] - values[span.before]) * span.fraction;
}

Pose PoseTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Between span = between_samples(times, seconds);
  const Pose& a = poses[span.before];
  if (held || span.before == span.after) {
    return a;
  }
  const Pose& b = poses[span.after];
  return {a.position + (b.position - a.position) * span.fraction,
          normalized(slerp(a.orientation, b.orientation, span.fraction))};
}

bool SwitchTrack::at(double seconds) const {
  return !times.empty() && values[between_samples(times, seconds).before] != 0;
}

namespace {

/// Between two bounds, either of which may be open.
double between(double a, double b, double fraction) {
  return std::isfinite(a) && std::isfinite(b) ? a + (b - a) * fraction : a;
}

}  // namespace

JointBounds BoundsTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Between span = between_samples(times, seconds);
  JointBounds now = bounds[span.before];
  const JointBounds& next = bounds[span.after];
  if (held || span.before == span.after) {
    return now;
  }
  now.lower = between(now.lower, next.lower, span.fraction);
  now.upper = between(now.upper, next.upper, span.fraction);
  now.cone_angle0 = between(now.cone_angle0, next.cone_angle0, span.fraction);
  now.cone_angle1 = between(now.cone_angle1, next.cone_angle1, span.fraction);
  for (std::size_t i = 0; i < now.limits.size() && i < next.limits.size(); ++i) {
    now.limits[i].lower = between(now.limits[i].lower, next.limits[i].lower, span.fraction);
    now.limits[i].upper = between(now.limits[i].upper, next.limits[i].upper, span.fraction);
  }
  return now;
}

std::size_t ShapesTrack::at(double seconds) const {
  return times.empty() ? 0 : between_samples(times, seconds).before;
}

Vec3d GravityTrack::at(double seconds) const {
  if (times.empty()) {
    return {};
  }
  const Between span = between_samples(times, seconds);
  const Vec3d& a = gravity[span.before];
  return held || span.before == span.after ? a : a + (gravity[span.after] - a) * span.fraction;
}

PhysicsScene::PhysicsScene() = default;
PhysicsScene::PhysicsScene(const PhysicsScene&) = default;
PhysicsScene::PhysicsScene(PhysicsScene&&) noexcept = default;
PhysicsScene& PhysicsScene::operator=(const PhysicsScene&) = default;
PhysicsScene& PhysicsScene::operator=(PhysicsScene&&) noexcept = default;
PhysicsScene::~PhysicsScene() = default;

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
  const auto exerts = [this](const Collider& c) {
    return !c.settings.trigger && (!c.body || bodies[*c.body].settings.solves_contacts);
  };
  return exerts(colliders[collider_a]) && exerts(colliders[collider_b]) &&
         may_meet(collider_a, collider_b);
}

bool PhysicsScene::may_meet(Index collider_a, Index collider_b) const {
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

}  // namespace tenon::scene
