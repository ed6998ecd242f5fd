// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each instance of the drive API names a degree of freedom and becomes one drive of the joint. All
// numbers go to SI by the factors of drive_units. Gains about an axis are authored per degree
// (S-13). Those of acceleration drives hold no mass, because they act on the effective inertia
// (S-104). A drive without an effect is kept and reported, but of a joint that follows another one
// it says the effort; one for an axis that the joint lacks is skipped.
#include "tenon/physics/joints/drives.h"

#include <cmath>

#include "tenon/base/containers/token_memo.h"
#include "tenon/physics/joints/joint_limits.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

/// S-103: "angular" and "linear" name the joint's own axis; the axis' own name is taken too.
std::optional<Dof> driven_dof(const ReadState& state, const stage::Prim& prim, const Joint& joint,
                              Token instance) {
  static const Token angular("angular");
  static const Token linear("linear");
  const auto api_name = [&] { return "PhysicsDriveAPI:" + instance.str(); };
  const std::optional<Dof> named = dof_of(instance.view());
  const bool one_axis = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
  const Token own = joint.kind == JointKind::Revolute ? angular : linear;
  if (one_axis && instance == own) {
    return joint.dof();
  }
  if (one_axis && named == joint.dof()) {
    state.report(
        prim, Severity::Info, "drive.axis-token",
        api_name() + " is taken as PhysicsDriveAPI:" + own.str() + ", the joint's own axis",
        "apply PhysicsDriveAPI:" + own.str(), api_part(api_name()));
    return named;
  }
  if (joint.kind == JointKind::D6 && named && *named != Dof::Distance) {
    return named;
  }
  // S-107
  state.report(prim, Severity::Warning, "drive.no-such-axis",
               api_name() + " is ignored: the joint does not move that way",
               one_axis ? "apply PhysicsDriveAPI:" + own.str() : "remove it", api_part(api_name()));
  return std::nullopt;
}

bool read_acceleration(const ReadState& state, const stage::Prim& prim, Token name) {
  static const Token force("force");
  const Token type = state.values.get<Token>(prim, name).value_or(force);
  if (!(type == force) && !(type == "acceleration")) {
    state.report(prim, name, Severity::Error, "drive.type-unknown",
                 name.str() + " is \"" + type.str() + "\"; force is used instead",
                 "use force or acceleration");
  }
  return type == "acceleration";
}

double read_max_force(const ReadState& state, const stage::Prim& prim, Token name, double unit) {
  const double force = state.values.number(prim, name).value_or(kUnlimited);
  if (force < 0) {
    // S-105
    state.report(prim, name, Severity::Error, "drive.negative-max-force",
                 name.str() + " is " + text_of_float(force) + "; the force is not limited",
                 "author a value that is not negative");
    return kUnlimited;
  }
  return force * unit;
}

/// A gain in the file's own unit, as it is: one below zero acts, and is reported (S-102).
double read_gain(const ReadState& state, const stage::Prim& prim, Token name) {
  const double gain = state.values.number(prim, name).value_or(0);
  if (gain < 0) {
    state.report(prim, name, Severity::Error, "drive.negative-gain",
                 name.str() + " is " + text_of_float(gain) + ": the drive feeds energy in",
                 "author a gain that is not negative");
  }
  return gain;
}

/// What PhysX says a motor can do at a speed; about an axis per degree.
DriveEnvelope read_envelope(const ReadState& state, const PhysicsPrim& found, Token instance,
                            Dof dof) {
  DriveEnvelope envelope;
  if (!found.roles.has(Api::PhysxDriveEnvelope)) {
    return envelope;
  }
  const std::string prefix = "physxDrivePerformanceEnvelope:" + instance.str() + ":";
  const auto number = [&](const char* name, double fallback) {
    const double value =
        state.values.authored_number(found.prim, Token(prefix + name)).value_or(fallback);
    return value >= 0 ? value : fallback;
  };
  const double velocity = is_angular(dof) ? kRadians : state.units.length;
  const double force = is_angular(dof) ? state.units.torque() : state.units.force();
  envelope.max_velocity = number("maxActuatorVelocity", kUnlimited) * velocity;
  envelope.speed_effort_gradient = number("speedEffortGradient", 0) * velocity / force;
  envelope.velocity_resistance = number("velocityDependentResistance", 0) * force / velocity;
  return envelope;
}

/// A drive of a joint that follows another one says what effort the joint takes.
bool follows_by(const PhysicsPrim& found) {
  return found.roles.has(Api::NewtonMimic) || found.roles.has(Api::PhysxMimicJoint) ||
         found.roles.has(Api::MjcEqualityJoint);
}

void check_effect(const ReadState& state, const PhysicsPrim& found, const Joint& joint,
                  const Drive& drive, Token instance) {
  const stage::Prim& prim = found.prim;
  const bool is_idle = drive.stiffness == 0 && drive.damping == 0;
  if (!is_idle && !drive.acceleration && !is_locked(joint, drive.dof)) {
    return;
  }
  const StatementPart api = api_part("PhysicsDriveAPI:" + instance.str());
  const std::string name = "the drive of " + std::string(dof_name(drive.dof));
  if (drive.acceleration && is_angular(drive.dof)) {
    state.report(prim, Severity::Info, "drive.angular-acceleration",
                 name +
                     " is an angular acceleration drive: its gains are taken per degree, as "
                     "PhysX does; read literally they are 57.3 times weaker",
                 "use a force drive, whose gains all readers take alike", api);
  }
  if (is_idle) {
    if (follows_by(found)) {
      return;
    }
    // S-106
    state.report(prim, Severity::Info, "drive.no-effect",
                 name + " has neither stiffness nor damping: no force", "author gains", api);
  } else if (is_locked(joint, drive.dof)) {
    // S-107
    state.report(prim, Severity::Warning, "drive.locked-axis",
                 name + " has no effect: limits lock that axis",
                 "open the limit or remove the drive", api);
  }
}

}  // namespace

DriveNames drive_names(Token instance) {
  thread_local TokenMemo<DriveNames, 16> known;
  return known.find_or_make(instance, [](Token name) {
    const std::string prefix = "drive:" + name.str() + ":physics:";
    return DriveNames{Token(prefix + "type"),           Token(prefix + "maxForce"),
                      Token(prefix + "targetPosition"), Token(prefix + "targetVelocity"),
                      Token(prefix + "stiffness"),      Token(prefix + "damping")};
  });
}

DriveUnits drive_units(const ReadState& state, Dof dof, bool acceleration) {
  const Units& units = state.units;
  const bool angular = is_angular(dof);
  // S-12, S-13: gains are per degree; S-104: those of acceleration drives hold no mass.
  const double inertia = acceleration ? 1 : (angular ? units.inertia() : units.mass);
  const bool literal =
      acceleration && state.readings.angular_acceleration == AngularAcceleration::Literal;
  const double gain = angular && !literal ? inertia / kRadians : inertia;
  DriveUnits result;
  result.stiffness = gain * units.rate * units.rate;
  result.damping = gain * units.rate;
  result.force = (angular ? units.torque() : units.force()) * units.rate * units.rate;
  result.position = angular ? kRadians : units.length;
  result.velocity = result.position * units.rate;
  return result;
}

std::optional<Drive> read_drive(const ReadState& state, const PhysicsPrim& found,
                                const Joint& joint, Token instance) {
  const stage::Prim& prim = found.prim;
  const std::optional<Dof> dof = driven_dof(state, prim, joint, instance);
  if (!dof) {
    return std::nullopt;
  }
  const DriveNames names = drive_names(instance);
  const AttributeValues& values = state.values;
  Drive drive;
  drive.source = joint.path;
  drive.dof = *dof;
  drive.acceleration = read_acceleration(state, prim, names.type);
  const DriveUnits unit = drive_units(state, *dof, drive.acceleration);
  drive.stiffness = read_gain(state, prim, names.stiffness) * unit.stiffness;
  drive.damping = read_gain(state, prim, names.damping) * unit.damping;
  drive.max_force = read_max_force(state, prim, names.max_force, unit.force);
  drive.target_position = values.number(prim, names.target_position).value_or(0) * unit.position;
  drive.target_velocity = values.number(prim, names.target_velocity).value_or(0) * unit.velocity;
  check_effect(state, found, joint, drive, instance);
  return drive;
}

void read_drives(ReadState& state) {
  for (Index i = 0; i < state.scene.joints.size(); ++i) {
    const PhysicsPrim& found = state.prim_of_joint(i);
    if (!found.roles.has(Api::Drive)) {
      continue;
    }
    Joint& joint = state.scene.joints[i];
    for (const Token& instance : found.prim.api_instances("PhysicsDriveAPI")) {
      std::optional<Drive> drive = read_drive(state, found, joint, instance);
      if (drive) {
        drive->envelope = read_envelope(state, found, instance, drive->dof);
        state.drive_instances.push_back({i, static_cast<Index>(joint.drives.size()), instance});
        joint.drives.push_back(*std::move(drive));
      }
    }
  }
}

}  // namespace tenon::physics
