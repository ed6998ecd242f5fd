// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How PhysX measures angles of drives, and what it makes of rebounds of limits. Found as the rules
// of portability_physx.cpp are.
#include <algorithm>
#include <cmath>
#include <string>

#include "tenon/check/joint_state.h"
#include "tenon/check/subject.h"

namespace tenon::check {
namespace {

using scene::Dof;
using scene::Joint;
using scene::JointKind;

constexpr double kWeakerDrive = 0.97;  ///< share of its spring's moment that is reported
constexpr double kTurn = 2 * kPi;      ///< [rad]

bool pulls(const scene::Drive& drive) {
  return drive.stiffness > 0 && scene::is_angular(drive.dof);
}

/// What PhysX takes for an angle between axes and target: for turning about X of the joint (and a
/// hinge's axis) twice the sine of its half, for tilting about Y and Z its sine.
double measured_angle(const Joint& joint, Dof dof, double angle) {
  const bool tilts = joint.kind == JointKind::D6 && dof != Dof::RotX;
  return tilts ? std::sin(angle) : 2 * std::sin(angle / 2);
}

}  // namespace

void check_physx_drive_angle(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool angular = joint.kind == JointKind::Revolute || joint.kind == JointKind::D6;
    if (joint.articulation || !joint.enabled || !angular) {
      continue;
    }
    const double start =
        joint.kind == JointKind::Revolute ? start_coordinate(subject.scene, joint) : 0;
    for (const scene::Drive& drive : joint.drives) {
      const double angle = std::fabs(drive.target_position - start);
      const double measured = measured_angle(joint, drive.dof, std::fmin(angle, kPi));
      if (pulls(drive) && measured < kWeakerDrive * angle) {
        report.at(subject.stage.prim(drive.source),
                  "outside of articulations PhysX measures how far a drive is from its target by "
                  "sines: at the start it pulls as if from " +
                      digits(measured * kDegreesPerRadian) + " degrees there, from " +
                      digits(angle * kDegreesPerRadian) + " here",
                  "make the joint part of an articulation, or move the target in small steps");
      }
    }
  }
}

void check_physx_drive_turns(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool open = std::isinf(joint.lower) && std::isinf(joint.upper);
    if (!joint.articulation || !joint.enabled || joint.kind != JointKind::Revolute || !open) {
      continue;
    }
    for (const scene::Drive& drive : joint.drives) {
      if (pulls(drive) && std::fabs(drive.target_position) > kTurn) {
        report.at(subject.stage.prim(drive.source),
                  "PhysX takes the target of a joint without limits within a turn: it goes to " +
                      digits(std::fmod(drive.target_position, kTurn) * kDegreesPerRadian) +
                      " degrees there, to " + digits(drive.target_position * kDegreesPerRadian) +
                      " here",
                  "author limits beyond the target");
      }
    }
  }
}

void check_physx_rebound(const Subject& subject, Reporter& report) {
  for (const Joint& joint : subject.scene.joints) {
    const bool rebounds =
        std::any_of(joint.limit_springs.begin(), joint.limit_springs.end(),
                    [](const scene::LimitSpring& spring) { return spring.restitution > 0; });
    if (joint.enabled && rebounds) {
      report.at(
          subject.stage.prim(joint.path),
          "PhysX's own solver (TGS) does not rebound from limits: the joint stays on its bound "
          "there",
          "leave the restitution out, or give the limit a stiffness");
    }
  }
}

}  // namespace tenon::check
