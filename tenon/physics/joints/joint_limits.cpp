// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// An open side is infinite in memory, so that limits of the limit API narrow those of the joint by
// minimum and maximum. On a D6 joint each limit stays by itself, ordered by degree of freedom. A
// lower limit above the upper one is kept as it is, since it locks the axis (S-98). A minimum
// distance above the maximum is an error and is lowered to it (S-97).
#include "tenon/physics/joints/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

/// From the stage's units to SI for one degree of freedom.
double unit_of(const Units& units, Dof dof) { return is_angular(dof) ? kRadians : units.length; }

/// S-98: either infinity means that the side is open.
double bound(const ReadState& state, const stage::Prim& prim, Token name, double open,
             double unit) {
  const double value = state.values.number(prim, name).value_or(open);
  return std::isinf(value) ? open : value * unit;
}

/// S-96: negative means unlimited, each angle by itself.
double cone_angle(const ReadState& state, const stage::Prim& prim, Token name) {
  const double degrees = state.values.number(prim, name).value_or(-1);
  return degrees < 0 || std::isinf(degrees) ? kUnlimited : degrees * kRadians;
}

/// S-96, S-98
void report_one_sided(const ReadState& state, const stage::Prim& prim, const std::string& what) {
  const bool keep = state.readings.one_sided_limits == OneSidedLimits::Keep;
  state.report(prim, Severity::Info, "joint.one-sided-limit",
               what + " open on one side; the other " + (keep ? "holds" : "is dropped") +
                   ". OpenUSD's parser drops both",
               "author both sides for readers that want them");
}

void read_cone(const ReadState& state, const stage::Prim& prim, Joint& joint) {
  joint.cone_angle0 = cone_angle(state, prim, state.tokens.cone_angle0);
  joint.cone_angle1 = cone_angle(state, prim, state.tokens.cone_angle1);
  if (std::isinf(joint.cone_angle0) != std::isinf(joint.cone_angle1)) {
    report_one_sided(state, prim, "the cone is");
    if (state.readings.one_sided_limits == OneSidedLimits::Drop) {
      joint.cone_angle0 = kUnlimited;
      joint.cone_angle1 = kUnlimited;
    }
  }
}

/// S-97
void read_distances(const ReadState& state, const stage::Prim& prim, Joint& joint) {
  const double low = state.values.number(prim, state.tokens.min_distance).value_or(-1);
  const double high = state.values.number(prim, state.tokens.max_distance).value_or(-1);
  joint.lower = low < 0 || std::isinf(low) ? -kUnlimited : low * state.units.length;
  joint.upper = high < 0 || std::isinf(high) ? kUnlimited : high * state.units.length;
  if (joint.lower > joint.upper) {
    state.report(prim, state.tokens.min_distance, Severity::Error, "joint.distance-order",
                 "minDistance " + text_of_float(low) + " exceeds maxDistance " +
                     text_of_float(high) + "; the distance is held at the maximum",
                 "author a minDistance that is at most maxDistance");
    joint.lower = joint.upper;
  }
}

/// S-98: lower > upper locks; open sides stay open.
void read_own_limits(const ReadState& state, const stage::Prim& prim, Joint& joint) {
  const double unit = unit_of(state.units, joint.dof());
  joint.lower = bound(state, prim, state.tokens.lower_limit, -kUnlimited, unit);
  joint.upper = bound(state, prim, state.tokens.upper_limit, kUnlimited, unit);
  if (joint.kind == JointKind::Revolute && std::isinf(joint.lower) != std::isinf(joint.upper)) {
    report_one_sided(state, prim, "the limit is");
    if (state.readings.one_sided_limits == OneSidedLimits::Drop) {
      joint.lower = -kUnlimited;
      joint.upper = kUnlimited;
    }
  }
}

struct NamedLimit {
  Token instance;
  std::optional<Dof> dof;
  Limit limit;
};

NamedLimit read_limit(const ReadState& state, const stage::Prim& prim, Token instance) {
  NamedLimit named{instance, dof_of(instance.view()), {}};
  if (!named.dof) {
    return named;
  }
  const std::string prefix = "limit:" + instance.str() + ":physics:";
  const double unit = unit_of(state.units, *named.dof);
  named.limit.dof = *named.dof;
  named.limit.lower = bound(state, prim, Token(prefix + "low"), -kUnlimited, unit);
  named.limit.upper = bound(state, prim, Token(prefix + "high"), kUnlimited, unit);
  return named;
}

/// S-100: on a D6 joint every axis; on others only the joint's own one, where it narrows.
void apply_limit(const ReadState& state, const stage::Prim& prim, const NamedLimit& named,
                 Joint& joint) {
  const std::string name = "PhysicsLimitAPI:" + named.instance.str();
  if (!named.dof) {
    state.report(prim, Severity::Warning, "limit.unknown-axis",
                 name + " names no degree of freedom; it is ignored",
                 "use transX, transY, transZ, rotX, rotY, rotZ or distance", api_part(name));
    return;
  }
  if (joint.kind == JointKind::D6) {
    joint.limits.push_back(named.limit);
    return;
  }
  if (!has_one_dof(joint) || joint.dof() != *named.dof) {
    state.report(prim, Severity::Warning, "limit.other-axis",
                 name + " is ignored: the joint does not move along it", "remove it",
                 api_part(name));
    return;
  }
  joint.lower = std::max(joint.lower, named.limit.lower);
  joint.upper = std::min(joint.upper, named.limit.upper);
}

}  // namespace

void read_joint_limits(const ReadState& state, const PhysicsPrim& found, Joint& joint) {
  switch (joint.kind) {
    case JointKind::Revolute:
    case JointKind::Prismatic:
      read_own_limits(state, found.prim, joint);
      break;
    case JointKind::Spherical:
      read_cone(state, found.prim, joint);
      break;
    case JointKind::Distance:
      read_distances(state, found.prim, joint);
      break;
    case JointKind::Fixed:
    case JointKind::D6:
      break;
  }
  if (!found.roles.has(Api::Limit)) {
    return;
  }
  for (const Token& instance : found.prim.api_instances("PhysicsLimitAPI")) {
    apply_limit(state, found.prim, read_limit(state, found.prim, instance), joint);
  }
  std::stable_sort(joint.limits.begin(), joint.limits.end(),
                   [](const Limit& a, const Limit& b) { return a.dof < b.dof; });
}

}  // namespace tenon::physics
