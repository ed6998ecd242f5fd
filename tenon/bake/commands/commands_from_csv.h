// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/bake/commands/commands.h"

namespace tenon::bake {

/// Reads a table with commas: a header "time" and names such as "/hand/joint.target",
/// ".velocityTarget" and ".effort", with an axis or a number behind where a joint has several; then
/// rows in ascending time [s]. Lengths are in units of the stage, angles in degrees, efforts in N
/// and N m; an empty cell leaves what was there. Errors, with line and column (rule sim.commands):
/// NotFound for a name that the scene has not, Parse, Limit beyond limits::kCommandValues.
Result<Commands> commands_from_csv(std::string_view text, const scene::PhysicsScene& scene,
                                   const engines::Simulation& simulation);

}  // namespace tenon::bake
