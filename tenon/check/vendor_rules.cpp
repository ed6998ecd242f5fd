// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Settings of one vendor's schemas that do not act as they look: actuators, contacts and
// masses of MuJoCo's and Newton's. In MuJoCo a box of 20 cm at rest sinks in by 0.1 mm with its own
// time constant of contacts, 0.02 s, by 1.2 mm with 0.1 s and by 31 mm with 0.5 s.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tenon/check/joint_state.h"
#include "tenon/check/simready/reading.h"
#include "tenon/check/subject.h"
#include "tenon/layer/field_values.h"

namespace tenon::check {
namespace {

using scene::Joint;

constexpr double kSoft = 0.1;  ///< [s]

/// The first numbers of an array, and what is missing of `otherwise`.
template <std::size_t N>
std::array<double, N> leading(const stage::Prim& prim, const char* name,
                              std::array<double, N> otherwise) {
  const auto numbers = prim.attribute(name).get_as<layer::Array<double>>();
  for (std::size_t i = 0; numbers && i < std::min(N, numbers->size()); ++i) {
    otherwise[i] = (*numbers)[i];
  }
  return otherwise;
}

/// An actuator of MuJoCo whose control is a position of its joint, through a gear.
bool is_position_servo(const stage::Prim& prim) {
  const std::array<double, 3> bias = leading<3>(prim, "mjc:biasPrm", {0, 0, 0});
  return prim.type_name() == "MjcActuator" && simready::text(prim, "mjc:biasType") == "affine" &&
         bias[1] < 0;
}

bool has_gains(const Joint& joint) {
  return std::any_of(joint.drives.begin(), joint.drives.end(), [](const scene::Drive& drive) {
    return drive.stiffness != 0 || drive.damping != 0;
  });
}

}  // namespace

std::set<Path> actuated_joints(const Subject& subject) {
  std::set<Path> found;
  for (const stage::Prim& prim : subject.prims) {
    const bool of_newton = prim.type_name() == "NewtonActuator";
    if (of_newton || prim.type_name() == "MjcActuator") {
      const std::vector<Path> targets =
          simready::targets(prim, of_newton ? "newton:targets" : "mjc:target");
      found.insert(targets.begin(), targets.end());
    }
  }
  return found;
}

void check_control_range(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    const std::vector<Path> targets =
        is_position_servo(prim) ? simready::targets(prim, "mjc:target") : std::vector<Path>();
    const auto index = targets.size() == 1 ? subject.joint_at(targets.front()) : std::nullopt;
    if (!index || !has_one_axis(subject.scene.joints[*index])) {
      continue;
    }
    const Joint& joint = subject.scene.joints[*index];
    const bool angular = joint.kind == scene::JointKind::Revolute;
    const double gear = leading<1>(prim, "mjc:gear", {1})[0];
    const double unit = (angular ? 1 : subject.scene.meters_per_unit) / (gear == 0 ? 1 : gear);
    const double one = authored_number(prim, "mjc:ctrlRange:min").value_or(0) * unit;
    const double other = authored_number(prim, "mjc:ctrlRange:max").value_or(0) * unit;
    const double beyond =
        std::fmax(joint.lower - std::fmin(one, other), std::fmax(one, other) - joint.upper);
    const double travel = joint.upper - joint.lower;
    if (one != other && travel > 0 && std::isfinite(travel) && beyond > travel &&
        simready::text(prim, "mjc:ctrlLimited") != "false") {
      const double shown = angular ? kDegreesPerRadian : 1;
      report.at(prim, "mjc:ctrlRange:max",
                "the control reaches from " + digits(std::fmin(one, other) * shown) + " to " +
                    digits(std::fmax(one, other) * shown) + (angular ? " degrees" : " m") +
                    ", the joint " + named(joint.path, RelatedRole::Joint) + " from " +
                    digits(joint.lower * shown) + " to " + digits(joint.upper * shown) +
                    ": the actuator presses on the limit",
                "author mjc:ctrlRange:min and mjc:ctrlRange:max within the limits");
    }
  }
}

void check_soft_contact(const Subject& subject, Reporter& report) {
  for (const scene::Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    const double constant = leading<1>(prim, "mjc:solref", {0})[0];
    if (constant > kSoft) {
      report.at(prim, "mjc:solref",
                "contacts with a time constant of " + digits(constant) +
                    " s give way: in MuJoCo bodies sink in",
                "author mjc:solref = [0.02, 1], MuJoCo's own");
    }
  }
}

void check_parent_contacts(const Subject& subject, Reporter& report) {
  const auto& joints = subject.scene.joints;
  const bool jointed = std::any_of(joints.begin(), joints.end(), [](const Joint& joint) {
    return joint.enabled && joint.body0 && joint.body1 && !joint.collision_enabled;
  });
  for (const stage::Prim& prim : subject.prims) {
    const Token name("mjc:flag:filterparent");
    if (jointed && authored_flag(prim, name) == false) {
      report.at(prim, name,
                "in MuJoCo bodies collide with those that they are jointed to, against "
                "physics:collisionEnabled of the joints: what overlaps at a joint is pushed apart",
                "remove it, and author physics:collisionEnabled on joints whose bodies may touch");
    }
  }
}

void check_newton_actuator(const Subject& subject, Reporter& report) {
  for (const stage::Prim& prim : subject.prims) {
    if (!(prim.type_name() == "NewtonActuator")) {
      continue;
    }
    for (const Path& target : simready::targets(prim, "newton:targets")) {
      const auto index = subject.joint_at(target);
      if (index && !has_gains(subject.scene.joints[*index])) {
        report.at_target(prim, "newton:targets", target,
                         "actuators of Newton's schema are not read: in tenon's own runs nothing "
                         "drives the joint " +
                             named(target, RelatedRole::Joint),
                         "apply PhysicsDriveAPI with the gains to the joint");
      }
    }
  }
}

void check_shell_mass(const Subject& subject, Reporter& report) {
  for (const scene::Collider& collider : subject.scene.colliders) {
    const stage::Prim prim = subject.stage.prim(collider.path);
    if (!collider.body || simready::text(prim, "newton:massModel") != "shell" ||
        subject.scene.bodies[*collider.body].mass_source == scene::MassSource::Authored) {
      continue;
    }
    const scene::Body& body = subject.scene.bodies[*collider.body];
    report.at(prim, "newton:massModel",
              "shells are not read: the body " + named(body.path, RelatedRole::Body) + " weighs " +
                  digits(body.mass) + " kg with the shape as a solid, and less in Newton",
              "author physics:mass and physics:diagonalInertia of the body");
  }
}

}  // namespace tenon::check
