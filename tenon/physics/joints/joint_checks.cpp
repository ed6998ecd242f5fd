// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/joints/joint_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tenon/base/text/rounded_text.h"
#include "tenon/scene/about_bodies.h"

namespace tenon::physics {
namespace {

constexpr double kGap = 1e-4;    ///< [m] that frames may be apart
constexpr double kAngle = 1e-2;  ///< [rad] that frames may be rotated

/// Three digits are enough for a message.
std::string text(double value) { return rounded_text(value, 3); }

Pose in_world(const ReadState& state, const std::optional<Index>& body, const Pose& frame) {
  return body ? state.scene.bodies[*body].pose * frame : frame;
}

/// How far frame 1 is from where the joint lets it be, seen from frame 0.
struct Misfit {
  double gap = 0;    ///< [m]
  double angle = 0;  ///< [rad]
};

Misfit misfit_of(const Joint& joint, const Pose& relative) {
  const auto along = static_cast<std::size_t>(joint.axis);
  Vec3d offset = relative.position;
  Vec3d axis;
  axis[along] = 1;
  switch (joint.kind) {
    case JointKind::Fixed:
      return {length(offset), length(rotation_vector(relative.orientation))};
    case JointKind::Revolute: {
      const Vec3d rotated = rotate(relative.orientation, axis);
      return {length(offset), std::atan2(length(cross(axis, rotated)), dot(axis, rotated))};
    }
    case JointKind::Prismatic:
      offset[along] = 0;
      return {length(offset), length(rotation_vector(relative.orientation))};
    case JointKind::Spherical:
      return {length(offset), 0};
    case JointKind::Distance:
    case JointKind::D6:
      break;
  }
  return {};
}

/// The coordinate of a revolute or prismatic joint, or the distance of a distance joint.
double coordinate_of(const Joint& joint, const Pose& relative) {
  const auto along = static_cast<std::size_t>(joint.axis);
  if (joint.kind == JointKind::Distance) {
    return length(relative.position);
  }
  if (joint.kind == JointKind::Prismatic) {
    return relative.position[along];
  }
  const Quatd& q = relative.orientation;
  const Vec3d imaginary{{q.x, q.y, q.z}};
  const double angle = 2 * std::atan2(imaginary[along], q.w);
  return angle > kPi ? angle - 2 * kPi : (angle < -kPi ? angle + 2 * kPi : angle);
}

void check_limits(const ReadState& state, const stage::Prim& prim, const Joint& joint,
                  const Pose& relative) {
  const double at = joint.initial_position.value_or(coordinate_of(joint, relative));
  const bool angular = joint.kind == JointKind::Revolute;
  const double slack = angular ? kAngle : kGap;
  const bool below = at < joint.lower - slack;
  if (joint.lower > joint.upper || (!below && at <= joint.upper + slack)) {
    return;
  }
  const double unit = angular ? kRadians : state.units.length;
  const std::string what = joint.kind == JointKind::Distance ? "distance" : "coordinate";
  const std::string bound = joint.kind == JointKind::Distance
                                ? (below ? "minDistance" : "maxDistance")
                                : (below ? "lower limit" : "upper limit");
  const std::string degrees = angular ? " degrees" : "";
  state.report(prim, Severity::Warning, "joint.outside-limit",
               about_bodies(state.scene, joint,
                            "the " + what + " at the start, " + text(at / unit) + degrees +
                                ", is " + (below ? "below" : "above") + " the " + bound + ", " +
                                text((below ? joint.lower : joint.upper) / unit) + degrees),
               "move the bodies or widen the limit");
}

// Of what is fixed to the world.
bool stays(const ReadState& state, const Joint& joint) {
  const auto moves = [&](const scene::PoseTrack& track) {
    return track.joint && &state.scene.joints[*track.joint] == &joint;
  };
  return joint.kind == JointKind::Fixed && joint.body0.has_value() != joint.body1.has_value() &&
         state.readings.fixed_to_world == FixedToWorld::Stay &&
         std::none_of(state.scene.pose_tracks.begin(), state.scene.pose_tracks.end(), moves);
}

}  // namespace

void let_fixed_roots_stay(ReadState& state) {
  for (Joint& joint : state.scene.joints) {
    if (!joint.enabled || !stays(state, joint)) {
      continue;
    }
    const Pose at0 = in_world(state, joint.body0, joint.frame0);
    const Pose at1 = in_world(state, joint.body1, joint.frame1);
    const Misfit misfit = misfit_of(joint, inverse(at0) * at1);
    if (misfit.gap > kGap || misfit.angle > kAngle) {
      (joint.body0 ? joint.frame1 : joint.frame0) = joint.body0 ? at0 : at1;
    }
  }
}

void check_joint_start(const ReadState& state, const stage::Prim& prim, const Joint& joint) {
  const auto is_lost = [&](const std::optional<Index>& body) {
    return body && !state.has_place(*body);
  };
  if (!joint.enabled || is_lost(joint.body0) || is_lost(joint.body1)) {
    return;
  }
  const Pose relative = inverse(in_world(state, joint.body0, joint.frame0)) *
                        in_world(state, joint.body1, joint.frame1);
  const Misfit misfit = misfit_of(joint, relative);
  if (misfit.gap > kGap || misfit.angle > kAngle) {
    state.report(prim, Severity::Warning, "joint.frames-apart",
                 about_bodies(state.scene, joint,
                              "the frames of the joint are " +
                                  text(misfit.gap / state.units.length) + " units and " +
                                  text(misfit.angle / kRadians) + " degrees apart at the start; " +
                                  (stays(state, joint) ? "the body is fixed in place"
                                                       : "the bodies are moved together")),
                 "correct physics:localPos0, localRot0, localPos1, localRot1 or the bodies' poses");
  }
  if (joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic ||
      joint.kind == JointKind::Distance) {
    check_limits(state, prim, joint, relative);
  }
}

}  // namespace tenon::physics
