// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/simulation.h"

#include <string>

namespace tenon::engines {

std::string_view ability_name(Ability ability) {
  switch (ability) {
    case Ability::DriveTargets:
      return "drive targets";
    case Ability::JointEfforts:
      return "joint efforts";
    case Ability::BodyWrenches:
      return "forces on bodies";
    case Ability::KinematicPoses:
      return "kinematic poses";
    case Ability::Gravity:
      return "gravity";
    case Ability::Parameters:
      return "parameters";
    case Ability::States:
      return "states";
    case Ability::SavedStates:
      return "saved states";
    case Ability::Contacts:
      return "contacts";
    case Ability::DriveEfforts:
      return "drive efforts";
    case Ability::JointReactions:
      return "joint reactions";
    case Ability::Accelerations:
      return "accelerations";
    case Ability::Work:
      break;
  }
  return "work";
}

std::string_view parameter_name(Parameter parameter) {
  switch (parameter) {
    case Parameter::BodyMass:
      return "bodyMass";
    case Parameter::ColliderFriction:
      return "colliderFriction";
    case Parameter::DriveStiffness:
      return "driveStiffness";
    case Parameter::DriveDamping:
      return "driveDamping";
    case Parameter::DriveMaxForce:
      return "driveMaxForce";
    case Parameter::JointDamping:
      return "jointDamping";
    case Parameter::JointFriction:
      return "jointFriction";
    case Parameter::JointArmature:
      break;
  }
  return "jointArmature";
}

Wrench wrench_at(const Vec3d& force, const Vec3d& point, const Vec3d& center) {
  return {force, cross(point - center, force)};
}

Error no_ability(Ability ability) {
  return Error(ErrorCode::Unsupported,
               "this engine does not offer " + std::string(ability_name(ability)))
      .with_rule("engine.no-ability");
}

Error output_off(std::string_view output) {
  return Error(ErrorCode::Invalid, "the output \"" + std::string(output) + "\" is not switched on")
      .with_rule("simulation.output-off")
      .with_fix("switch it on in SimulationOptions::outputs when the simulation is made");
}

}  // namespace tenon::engines
