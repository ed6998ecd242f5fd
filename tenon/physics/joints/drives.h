// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/read_state.h"

namespace tenon::physics {

/// Attribute names of one instance of the drive API.
struct DriveNames {
  Token type;
  Token max_force;
  Token target_position;
  Token target_velocity;
  Token stiffness;
  Token damping;
};
DriveNames drive_names(Token instance);

/// Factors from the stage's units to SI for one degree of freedom.
struct DriveUnits {
  double stiffness = 1;
  double damping = 1;
  double force = 1;  ///< of the largest force
  double position = 1;
  double velocity = 1;
};
DriveUnits drive_units(const ReadState& state, Dof dof, bool acceleration);

/// One instance of the drive API; nullopt where it drives nothing.
std::optional<Drive> read_drive(const ReadState& state, const PhysicsPrim& found,
                                const Joint& joint, Token instance);

}  // namespace tenon::physics
