// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies, joints, articulations and filtered pairs of a scene in the form that the page draws. Of
// very many colliders the pairs are not shown, and a note says so.
#include <algorithm>
#include <cmath>
#include <map>

#include "tenon/math/inertia.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/view/drawn_shapes.h"

namespace tenon::view {
namespace {

constexpr std::size_t kMostColliders = 4000;  // whose pairs are looked at

/// Half extents of the box of even density that has these moments: of mass m and half extents a, b,
/// c the first is m (b^2 + c^2) / 3.
Vec3d inertia_box(double mass, const Vec3d& moments) {
  Vec3d half;
  for (std::size_t i = 0; i < 3; ++i) {
    const double others = moments[(i + 1) % 3] + moments[(i + 2) % 3] - moments[i];
    half[i] = mass > 0 ? std::sqrt(std::max(0.0, 1.5 * others / mass)) : 0;
  }
  return is_finite(half) ? half : Vec3d{};
}

ViewBody body_of(const scene::Body& body) {
  ViewBody result;
  result.path = body.path;
  result.pose = body.pose;
  result.mass = body.mass;
  result.center_of_mass = body.center_of_mass;
  const PrincipalInertia principal = principal_inertia(body.inertia);
  result.principal_axes = principal.axes;
  result.principal_moments = principal.moments;
  result.inertia_box = inertia_box(body.mass, principal.moments);
  result.kinematic = body.kinematic;
  result.enabled = body.enabled;
  return result;
}

std::optional<double> bound(double value) {
  return is_finite(value) ? std::optional(value) : std::nullopt;
}

void add_limit(const scene::Limit& limit, ViewJoint& joint) {
  if (is_finite(limit.lower) || is_finite(limit.upper)) {
    joint.limits.push_back({limit.dof, bound(limit.lower), bound(limit.upper)});
  }
}

/// How far the axis tilts toward the next one turns about the one after that, and the other way
/// round (S-96).
void add_cone(const scene::Joint& joint, ViewJoint& result) {
  const int axis = static_cast<int>(joint.axis);
  const auto turn = [](int about) {
    return static_cast<scene::Dof>(static_cast<int>(scene::Dof::RotX) + about % 3);
  };
  add_limit({turn(axis + 2), -joint.cone_angle0, joint.cone_angle0}, result);
  add_limit({turn(axis + 1), -joint.cone_angle1, joint.cone_angle1}, result);
}

ViewJoint joint_of(const scene::Joint& joint) {
  ViewJoint result;
  result.path = joint.path;
  result.kind = joint.kind;
  result.body0 = joint.body0;
  result.body1 = joint.body1;
  result.frame0 = joint.frame0;
  result.frame1 = joint.frame1;
  result.axis = joint.axis;
  result.drives = joint.drives;
  result.articulation = joint.articulation;
  result.enabled = joint.enabled;
  if (joint.kind == scene::JointKind::Distance) {
    add_limit({scene::Dof::Distance, joint.lower, joint.upper}, result);
    return result;
  }
  for (int i = 0; i <= static_cast<int>(scene::Dof::RotZ); ++i) {
    const auto dof = static_cast<scene::Dof>(i);
    if (!scene::is_locked(joint, dof)) {
      add_limit(scene::limit_of(joint, dof), result);
    }
  }
  if (joint.kind == scene::JointKind::Spherical) {
    add_cone(joint, result);
  }
  return result;
}

/// Pairs of bodies all of whose pairs of colliders are apart.
void add_filtered_pairs(const scene::PhysicsScene& scene, const ViewLimits& limits,
                        ViewScene& view) {
  const scene::ColliderPairs disabled = scene.colliders.size() > kMostColliders
                                            ? scene::ColliderPairs{{}, true}
                                            : scene.disabled_pairs();
  if (disabled.is_cut) {
    view.notes.push_back({{}, "pairs that do not touch are not shown of so many colliders"});
    return;
  }
  const auto body_of_collider = [&](Index collider) {
    return scene.colliders[collider].body.value_or(kWorld);
  };
  std::map<Index, std::size_t> colliders;  // of each body
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    ++colliders[body_of_collider(i)];
  }
  std::map<std::pair<Index, Index>, std::size_t> apart;
  for (const auto& [a, b] : disabled.pairs) {
    const Index first = body_of_collider(a);
    const Index second = body_of_collider(b);
    if (first != second) {
      ++apart[{std::min(first, second), std::max(first, second)}];
    }
  }
  for (const auto& [pair, count] : apart) {
    if (view.filtered_pairs.size() >= limits.pairs) {
      view.notes.push_back({{}, "there are more pairs that do not touch than can be shown"});
      return;
    }
    if (count >= colliders[pair.first] * colliders[pair.second]) {
      view.filtered_pairs.push_back(pair);
    }
  }
}

}  // namespace

void add_mechanism(const scene::PhysicsScene& scene, const ViewLimits& limits, ViewScene& view) {
  view.up = scene.up;
  for (const scene::Body& body : scene.bodies) {
    view.bodies.push_back(body_of(body));
  }
  for (const scene::Joint& joint : scene.joints) {
    view.joints.push_back(joint_of(joint));
  }
  for (std::size_t i = 0; i < scene.articulations.size(); ++i) {
    const scene::Articulation& articulation = scene.articulations[i];
    view.articulations.push_back(
        {articulation.path, articulation.fixed_base, articulation.links, articulation.joints});
    for (const Index link : articulation.links) {
      view.bodies[link].articulation = static_cast<Index>(i);
    }
    for (const Index joint : articulation.loop_joints) {
      view.joints[joint].closes_loop = true;
    }
  }
  add_filtered_pairs(scene, limits, view);
}

}  // namespace tenon::view
