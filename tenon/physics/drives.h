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
  double gain = 1;    ///< of stiffness and damping
  double force = 1;   ///< of the largest force
  double target = 1;  ///< of target position and velocity
};
DriveUnits drive_units(const Units& units, Dof dof, bool acceleration);

/// One instance of the drive API; nullopt where it drives nothing.
std::optional<Drive> read_drive(const ReadState& state, const stage::Prim& prim, const Joint& joint,
                                Token instance);

}  // namespace tenon::physics
