// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A track holds samples in ascending time: outside of them the first or the last one counts,
// between two of them numbers are blended unless the track is held, and switches and shapes hold. A
// bound that is infinite at one of the two is not blended.
// Filters only remove pairs. Two colliders may touch unless they are off, both static, of one body
// or of different scenes, or unless their groups (S-77) or the pairs of sets say no. Pairs of
// joints that may break or be switched are kept by joint, so that the list can be rebuilt.
#include "tenon/scene/physics_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/fields/enum_names.h"
#include "tenon/scene/filter_sets.h"

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
  return filter.group_paths.empty() ||
         filter.groups_allow(filter.groups_of_collider[a], filter.groups_of_collider[b]);
}

/// Nothing but filters keeps the two apart.
bool could_touch(const Collider& a, const Collider& b) {
  return a.enabled && b.enabled && a.scene == b.scene && a.body != b.body;
}

}  // namespace

bool CollisionFilter::groups_allow(const std::vector<Index>& a, const std::vector<Index>& b) const {
  if (a.empty() || b.empty()) {
    const auto touches_ungrouped = [&](Index group) { return ungrouped_off[group] == 0; };
    return (a.empty() && b.empty()) ||
           std::all_of((a.empty() ? b : a).begin(), (a.empty() ? b : a).end(), touches_ungrouped);
  }
  // S-77: off when any pair of memberships is off.
  return std::none_of(a.begin(), a.end(), [&](Index g) {
    return std::any_of(b.begin(), b.end(),
                       [&](Index h) { return group_pair_off[g * group_paths.size() + h] != 0; });
  });
}

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
  SetPairs& off = filter.sets_off;
  off = filter.permanent_sets_off;
  for (const JointPairs& own : filter.joint_pairs) {
    const Joint& joint = joints[own.joint];
    if (joint.enabled && !joint.collision_enabled) {
      off.insert(off.end(), own.sets.begin(), own.sets.end());
    }
  }
  std::sort(off.begin(), off.end());
  off.erase(std::unique(off.begin(), off.end()), off.end());
}

bool PhysicsScene::may_collide(Index collider_a, Index collider_b) const {
  const auto exerts = [this](const Collider& c) {
    return !c.settings.trigger && (!c.body || bodies[*c.body].settings.solves_contacts);
  };
  return exerts(colliders[collider_a]) && exerts(colliders[collider_b]) &&
         may_meet(collider_a, collider_b);
}

bool PhysicsScene::may_meet(Index collider_a, Index collider_b) const {
  return could_touch(colliders[collider_a], colliders[collider_b]) &&
         groups_allow(filter, collider_a, collider_b) &&
         !are_apart(sets_of(filter, collider_a), sets_of(filter, collider_b), filter.sets_off);
}

namespace {

/// Walks over the pairs of colliders that pairs of sets keep apart, also of one body.
class SetWalk {
 public:
  SetWalk(const CollisionFilter& filter, const SetPairs& off)
      : filter_(filter),
        members_(members_of_sets(filter)),
        partners_(members_.size()),
        found_for_(filter.sets_of_collider.size()) {
    for (const auto& [a, b] : off) {
      partners_[a].push_back(b);
      if (a != b) {
        partners_[b].push_back(a);
      }
    }
  }

  /// Adds the colliders above `collider` that are kept apart from it, each once.
  void add_above(Index collider, std::vector<Index>& list) {
    for (const Index set : sets_of(filter_, collider)) {
      for (const Index partner : partners_[set]) {
        const std::vector<Index>& members = members_[partner];
        auto at = std::upper_bound(members.begin(), members.end(), collider);
        work_ += 1 + static_cast<std::size_t>(members.end() - at);
        for (; at != members.end(); ++at) {
          if (found_for_[*at] != collider) {
            found_for_[*at] = collider;
            list.push_back(*at);
          }
        }
      }
    }
  }
  std::size_t work() const { return work_; }

 private:
  const CollisionFilter& filter_;
  std::vector<std::vector<Index>> members_;      // of each set
  std::vector<std::vector<Index>> partners_;     // sets that each set is apart from
  std::vector<std::optional<Index>> found_for_;  // of each collider: the last one it was found for
  std::size_t work_ = 0;
};

/// Walks over the pairs of colliders whose groups keep them apart. Colliders of the same groups are
/// looked at together.
class GroupWalk {
 public:
  explicit GroupWalk(const PhysicsScene& scene) : filter_(scene.filter) {
    if (filter_.group_paths.empty()) {
      return;
    }
    std::map<std::vector<Index>, Index> classes;
    for (Index i = 0; i < scene.colliders.size(); ++i) {
      const auto [entry, is_new] =
          classes.try_emplace(filter_.groups_of_collider[i], static_cast<Index>(members_.size()));
      if (is_new) {
        members_.emplace_back();
      }
      members_[entry->second].push_back(i);
      class_of_.push_back(entry->second);
    }
    partners_.resize(members_.size());
  }

  /// Adds the colliders above `collider` that are kept apart from it.
  void add_above(Index collider, std::vector<Index>& list) {
    if (members_.empty()) {
      return;
    }
    for (const Index partner : partners_of(class_of_[collider])) {
      const std::vector<Index>& members = members_[partner];
      const auto above = std::upper_bound(members.begin(), members.end(), collider);
      work_ += 1 + static_cast<std::size_t>(members.end() - above);
      list.insert(list.end(), above, members.end());
    }
  }
  std::size_t work() const { return work_; }

 private:
  const std::vector<Index>& partners_of(Index own) {
    std::optional<std::vector<Index>>& partners = partners_[own];
    if (!partners) {
      partners.emplace();
      for (Index other = 0; other < members_.size(); ++other) {
        const Index a = members_[own].front();
        const Index b = members_[other].front();
        work_ += filter_.groups_of_collider[a].size() + 1;
        if (!groups_allow(filter_, a, b)) {
          partners->push_back(other);
        }
      }
    }
    return *partners;
  }

  const CollisionFilter& filter_;
  std::vector<std::vector<Index>> members_;                  // of each class
  std::vector<Index> class_of_;                              // of each collider
  std::vector<std::optional<std::vector<Index>>> partners_;  // classes; unset: not looked at yet
  std::size_t work_ = 0;
};

}  // namespace

ColliderPairs PhysicsScene::disabled_pairs() const { return pairs_apart(filter.sets_off); }

ColliderPairs PhysicsScene::pairs_apart(const SetPairs& off) const {
  ColliderPairs result;
  SetWalk sets(filter, off);
  GroupWalk groups(*this);
  for (Index a = 0; a < colliders.size(); ++a) {
    std::vector<Index> others;
    sets.add_above(a, others);
    groups.add_above(a, others);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const Index b : others) {
      if (could_touch(colliders[a], colliders[b])) {
        result.pairs.emplace_back(a, b);
      }
    }
    if (result.pairs.size() > limits::kDisabledPairs ||
        sets.work() + groups.work() > limits::kDisabledPairWork) {
      result.is_cut = true;
      result.pairs.resize(std::min(result.pairs.size(), limits::kDisabledPairs));
      break;
    }
  }
  return result;
}

}  // namespace tenon::scene
