// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits and frame rotations are judged as the file has them, before units are converted and
// quaternions normalised. A round angle in radians, or three and more closed limits that all span
// at most 2 pi, look like radians; degrees times 57.3 look like a conversion too many. The other
// rules use the scene, where angles are compared modulo a turn. Driven joints without a root are
// counted by islands, the bodies that joints of trees and loops hold together.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"
#include "tenon/math/meant_degrees.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/scene/about_bodies.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/joint_freedom.h"
#include "tenon/scene/motion/fit_velocities.h"

namespace tenon::check {
namespace {

using scene::Index;
using scene::Joint;
using scene::JointKind;

constexpr double kPi2 = 6.2831853071795865;

const Token kLower("physics:lowerLimit");

stage::Prim prim_of(const Subject& subject, const Joint& joint) {
  return subject.stage.prim(joint.path);
}

/// A body that stands still because its transform is not made of numbers.
bool is_without_place(const Subject& subject, const std::optional<Index>& body) {
  return body && subject.has_finding("body.not-finite", subject.scene.bodies[*body].path.str());
}

bool is_bounded(const scene::Limit& limit) {
  return limit.locked() || std::isfinite(limit.lower) || std::isfinite(limit.upper);
}

/// A D6 or distance joint that leaves its bodies as free as without it.
bool holds_nothing(const Joint& joint) {
  if (joint.kind == JointKind::Distance) {
    return !(joint.lower > 0) && std::isinf(joint.upper);
  }
  const auto drives = [](const scene::Drive& d) { return d.stiffness != 0 || d.damping != 0; };
  return joint.kind == JointKind::D6 &&
         std::none_of(joint.limits.begin(), joint.limits.end(), is_bounded) &&
         std::none_of(joint.drives.begin(), joint.drives.end(), drives) && joint.mimics.empty() &&
         joint.stiffness == 0 && joint.damping == 0 && joint.friction == 0;
}

/// Authored limits in the file's own numbers.
struct AuthoredLimits {
  double lower = -INFINITY;
  double upper = INFINITY;
  bool closed() const { return std::isfinite(lower) && std::isfinite(upper); }
  /// Converted once more: of a hinge.
  bool are_degrees() const {
    return closed() && degrees_were_meant(lower * kRadians, upper * kRadians);
  }
};

AuthoredLimits limits_of(const stage::Prim& prim) {
  return {authored_number(prim, kLower).value_or(-INFINITY),
          authored_number(prim, "physics:upperLimit").value_or(INFINITY)};
}

/// A multiple of 30 or 45 degrees in radians, to half a percent.
bool is_round_in_radians(double value) {
  for (const double step : {kPi2 / 12, kPi2 / 8}) {
    const double count = std::fabs(value) / step;
    const double nearest = std::round(count);
    if (nearest >= 1 && nearest <= 12 && std::fabs(count - nearest) < 0.005 * nearest) {
      return true;
    }
  }
  return false;
}

/// Revolute joints whose closed limits span no more than a turn in radians.
struct NarrowJoints {
  std::size_t narrow = 0;
  std::size_t closed = 0;
};

NarrowJoints count_narrow(const Subject& subject) {
  NarrowJoints count;
  for (const Joint& joint : subject.scene.joints) {
    const AuthoredLimits limits = limits_of(prim_of(subject, joint));
    if (joint.kind == JointKind::Revolute && limits.closed() && limits.upper > limits.lower) {
      ++count.closed;
      count.narrow += limits.upper - limits.lower <= kPi2 + 0.01 ? 1u : 0u;
    }
  }
  return count;
}

}  // namespace

// S-98: legal, and means locked; nobody locks an axis by 30 and -30.
void check_crossed_limits(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (!has_one_axis(joint) || !joint.enabled) {
      continue;
    }
    const stage::Prim prim = prim_of(subject, joint);
    const AuthoredLimits limits = limits_of(prim);
    if (limits.closed() && limits.lower > limits.upper) {
      report.at(prim, kLower,
                "the lower limit " + digits(limits.lower) + " exceeds the upper limit " +
                    digits(limits.upper) + ": the joint is locked",
                "swap the limits, or use a PhysicsFixedJoint to lock the joint");
    }
  }
}

// S-98: legal as well; a robot of which nobody wrote the limits has them, 0 and 0.
void check_equal_limits(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (!has_one_axis(joint) || !joint.enabled || joint.lower != joint.upper) {
      continue;
    }
    report.at(prim_of(subject, joint), kLower,
              "both limits are " + digits(joint.lower * coordinate_unit(subject.scene, joint)) +
                  ": the joint is locked",
              "author limits that are apart, or use a PhysicsFixedJoint to lock the joint");
  }
}

// S-95, S-97
void check_holds_nothing(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const std::string path = joint.path.str();
    const bool told = subject.has_finding("attribute.api-missing", path) ||
                      subject.has_finding("limit.unknown-axis", path);
    if (!joint.enabled || told || !holds_nothing(joint)) {
      continue;
    }
    const bool distance = joint.kind == JointKind::Distance;
    const bool apart = joint.body0 && joint.body1 && !joint.collision_enabled;
    report.at(prim_of(subject, joint),
              about_bodies(subject.scene, joint,
                           std::string(distance ? "physics:minDistance and physics:maxDistance "
                                                  "leave every distance open"
                                                : "no limit and no drive acts on any of the six "
                                                  "axes") +
                               ": the joint holds nothing" +
                               (apart ? ", it only keeps its bodies from colliding" : "")),
              distance ? "author physics:maxDistance or physics:minDistance"
                       : "apply PhysicsLimitAPI to the axes that it is to hold, or remove it");
  }
}

// S-98: how UsdPhysics locks an axis of a D6 joint, so it is told and no fault.
void check_locked_axes(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    std::vector<std::string> locked;
    for (const scene::Limit& limit : joint.limits) {
      if (limit.locked()) {
        locked.emplace_back(dof_name(limit.dof));
      }
    }
    if (joint.kind != JointKind::D6 || !joint.enabled || locked.empty()) {
      continue;
    }
    const bool one = locked.size() == 1;
    std::string names;
    for (std::size_t i = 0; i < locked.size(); ++i) {
      names += (i == 0 ? "" : i + 1 == locked.size() ? " and " : ", ") + locked[i];
    }
    report.at(prim_of(subject, joint), Token("limit:" + locked[0] + ":physics:low"),
              (one ? "the limit of " : "the limits of ") + names + (one ? " has" : " have") +
                  " low above high, which locks " + (one ? "this axis" : "these axes"),
              "swap low and high where the axis should move");
  }
}

void check_radian_limits(const Subject& subject, Reporter& report) {
  const NarrowJoints count = count_narrow(subject);
  const bool all_narrow = count.closed >= 3 && count.narrow == count.closed;
  for (const Joint& joint : subject.scene.joints) {
    if (joint.kind != JointKind::Revolute) {
      continue;
    }
    const stage::Prim prim = prim_of(subject, joint);
    const AuthoredLimits limits = limits_of(prim);
    if (!limits.closed() || limits.upper <= limits.lower ||
        limits.upper - limits.lower > kPi2 + 0.01) {
      continue;
    }
    const bool round = is_round_in_radians(limits.lower) || is_round_in_radians(limits.upper);
    if (all_narrow || round) {
      report.at(prim, kLower,
                "the limits " + digits(limits.lower) + " and " + digits(limits.upper) +
                    " degrees look like radians",
                "author " + digits(limits.lower * kDegreesPerRadian) + " and " +
                    digits(limits.upper * kDegreesPerRadian) + " if radians were meant");
    }
  }
}

// S-13: the opposite, degrees that a converter took for radians.
void check_degree_limits(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const AuthoredLimits limits = limits_of(prim_of(subject, joint));
    if (joint.kind != JointKind::Revolute || !limits.are_degrees()) {
      continue;
    }
    const std::string lower = digits(limits.lower * kRadians);
    const std::string upper = digits(limits.upper * kRadians);
    report.at(prim_of(subject, joint), kLower,
              "the limits " + digits(limits.lower) + " and " + digits(limits.upper) +
                  " degrees are " + lower + " and " + upper +
                  " radians, which look like degrees that were converted once more",
              "author " + lower + " and " + upper + " if those degrees were meant");
  }
}

// S-99
void check_multi_turn(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const AuthoredLimits limits = limits_of(prim_of(subject, joint));
    const bool beyond = (std::isfinite(limits.lower) && limits.lower < -360) ||
                        (std::isfinite(limits.upper) && limits.upper > 360);
    if (joint.kind == JointKind::Revolute && beyond && !limits.are_degrees()) {
      report.at(prim_of(subject, joint), kLower,
                "the limits reach beyond a turn; PhysX clamps them to 360 degrees",
                "leave the limits open if the joint turns freely");
    }
  }
}

// S-89
void check_rotation_zero(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const char* name : {"physics:localRot0", "physics:localRot1"}) {
      const stage::Attribute rotation = prim.attribute(name);
      const auto value = rotation.has_authored_value() ? rotation.get_as<Quatf>() : std::nullopt;
      if (value && dot(to_double(*value), to_double(*value)) == 0) {
        report.at(prim, name, std::string(name) + " is zero, not a rotation; the identity is used",
                  "author (1, 0, 0, 0) or the rotation that is meant");
      }
    }
  }
}

// S-89
void check_rotation_length(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    for (const char* name : {"physics:localRot0", "physics:localRot1"}) {
      const stage::Attribute rotation = prim.attribute(name);
      const auto value = rotation.has_authored_value() ? rotation.get_as<Quatf>() : std::nullopt;
      const double norm = value ? std::sqrt(dot(to_double(*value), to_double(*value))) : 1;
      if (norm > 0 && std::fabs(norm - 1) > 1e-3) {
        report.at(prim, name,
                  std::string(name) + " has length " + digits(norm) + "; it is normalised",
                  "author a unit quaternion");
      }
    }
  }
}

void check_parallel_joints(const Subject& subject, Reporter& report) {
  const auto world = static_cast<Index>(subject.scene.bodies.size());
  std::map<std::pair<Index, Index>, const Joint*> first;
  std::map<std::pair<Index, Index>, const Joint*> first_of_tree;
  for (const Joint& joint : subject.scene.joints) {
    if (!joint.enabled || (!joint.body0 && !joint.body1)) {
      continue;
    }
    const Index side0 = joint.body0.value_or(world);
    const Index side1 = joint.body1.value_or(world);
    const std::pair pair{std::min(side0, side1), std::max(side0, side1)};
    const auto tell = [&](const Joint& other, const std::string& what, const std::string& advice) {
      report.at(prim_of(subject, joint),
                about_bodies(subject.scene, joint,
                             named(other.path, RelatedRole::Joint) + " joins the same two " + what),
                advice);
    };
    const Joint& one = *first.emplace(pair, &joint).first->second;
    if (&one != &joint && (can_break(one) || can_break(joint))) {
      tell(one, "sides: both hold at once, and one may take the whole load and break under it",
           "let one joint hold both, or only one that can break");
      continue;
    }
    if (joint.exclude_from_articulation || !joint.body0 || !joint.body1) {
      continue;
    }
    const Joint& tied = *first_of_tree.emplace(pair, &joint).first->second;
    if (&tied != &joint) {
      tell(tied, "bodies: both hold at once, and reduced solvers skip one",
           "make one PhysicsJoint with a limit per axis, or exclude one from articulations");
    }
  }
}

void check_joint_moves_something(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool judged =
        is_without_place(subject, joint.body0) || is_without_place(subject, joint.body1);
    if (joint.enabled && !judged && !subject.scene.is_dynamic(joint.body0) &&
        !subject.scene.is_dynamic(joint.body1)) {
      report.at(prim_of(subject, joint),
                about_bodies(subject.scene, joint,
                             "neither side of the joint moves freely: it has no effect"),
                "make one of its bodies dynamic, or remove the joint");
    }
  }
}

// S-93
void check_break_in_articulation(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.articulation && can_break(joint)) {
      report.at(prim_of(subject, joint),
                "the joint can break and is part of an articulation, where PhysX ignores that",
                "author excludeFromArticulation if it is to break in every engine");
    }
  }
}

void check_velocity_limit(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (joint.velocity_limit == 0) {
      report.at(prim_of(subject, joint), "the velocity limit of the joint is 0: it cannot move",
                "author a positive limit, or remove it");
    }
  }
}

// What starts to move as the joints let it loses energy where the bodies' velocities say otherwise.
void check_velocities_apart(const Subject& subject, Reporter& report) {
  constexpr double kFirstStep = 0.002;  // [s] over which kinematic bodies show their speed
  const scene::PhysicsScene& scene = subject.scene;
  const std::vector<scene::BodyState> states = scene::states_at_start(scene, kFirstStep);
  if (!scene::anything_moves(scene, states)) {
    return;
  }
  const std::vector<scene::FreeRotations> rotations = scene::wanted_rotations(scene);
  std::vector<scene::JointDofs> dofs;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    dofs.push_back(scene::joint_dofs(scene.joints[j], rotations[j]));
  }
  const scene::FittedVelocities fitted = scene::fit_velocities(
      scene, scene::joint_forest(scene), dofs, states, scene::LinkVelocities::OfJoints);
  for (const scene::LostEnergy& loss : fitted.losses) {
    report.at(prim_of(subject, scene.joints[loss.joint]),
              about_bodies(scene, scene.joints[loss.joint], scene::words_of(loss)),
              "give the bodies velocities with which the joint's frames stay together");
  }
}

void check_joint_state(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    if (!joint.enabled || !joint.initial_position || !has_one_axis(joint)) {
      continue;
    }
    const double posed = coordinate_from_poses(subject.scene, joint);
    const bool angular = joint.kind == JointKind::Revolute;
    double gap = std::fabs(*joint.initial_position - posed);
    gap = angular ? std::fabs(std::remainder(gap, kPi2)) : gap;
    if (gap > (angular ? 1e-2 : 1e-3)) {
      const double unit = coordinate_unit(subject.scene, joint);
      report.at(prim_of(subject, joint),
                about_bodies(subject.scene, joint,
                             "the joint state says " + digits(*joint.initial_position * unit) +
                                 ", the poses of the bodies say " + digits(posed * unit)),
                "author the state that the poses have, or move the bodies");
    }
  }
}

void check_physx_joint_api(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const bool has_newer =
        prim.has_api("NewtonJointAPI") || !prim.api_instances("PhysxJointAxisAPI").empty();
    if (prim.has_api("PhysxJointAPI") && !has_newer) {
      report.at(prim,
                "PhysxJointAPI is applied; newer PhysX releases ignore its attributes silently",
                "apply PhysxJointAxisAPI or NewtonJointAPI beside it",
                physics::api_part("PhysxJointAPI"));
    }
  }
}

// Isaac: robots have an articulation root.
void check_articulation_missing(const Subject& subject, Reporter& report) {
  const scene::PhysicsScene& scene = subject.scene;
  const scene::JointForest forest = scene::joint_forest(scene);
  std::set<Index> taken;
  for (const scene::Articulation& articulation : scene.articulations) {
    taken.insert(articulation.links.begin(), articulation.links.end());
  }
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    if (is_without_place(subject, i)) {
      taken.insert(i);  // the root that it may be has no articulation for that reason
    }
  }
  std::map<Index, std::vector<Index>> driven;  // island -> its driven joints
  for (Index i = 0; i < scene.joints.size(); ++i) {
    const Joint& joint = scene.joints[i];
    const std::optional<Index> body = joint.body1 ? joint.body1 : joint.body0;
    const bool known = !body || taken.contains(*body) || taken.contains(forest.bodies[*body].root);
    if (joint.enabled && !joint.drives.empty() && !known) {
      driven[forest.bodies[*body].island].push_back(i);
    }
  }
  for (const auto& [island, joints] : driven) {
    if (joints.size() >= 3) {
      report.at(prim_of(subject, scene.joints[joints.front()]),
                std::to_string(joints.size()) +
                    " driven joints hang together without an articulation root: engines simulate "
                    "them less precisely, and robot tools do not find them",
                "apply PhysicsArticulationRootAPI to the prim above the robot's bodies");
    }
  }
}

}  // namespace tenon::check
