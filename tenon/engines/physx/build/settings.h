// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "tenon/engines/physx/build/build.h"

/// What the asset says of how PhysX is to solve it, and what counts where it says nothing.
namespace tenon::engines::physx {

using Settings = std::vector<scene::VendorSetting>;

/// The number of a setting by name; nullopt: not authored.
std::optional<double> number_of(const Settings& settings, std::string_view name);
/// The word of a setting; "": not authored.
std::string_view word_of(const Settings& settings, std::string_view name);

/// How a scene is solved, and how finely; what the caller asks for wins (Methods).
/// What the steps of a model are made with (Simulation::settings).
std::vector<scene::VendorSetting> run_settings(const Model& model);
void set_solver(Build& build, scene::Index scene, px::PxSceneDesc& wanted);

struct Iterations {
  px::PxU32 positions = 0;
  px::PxU32 velocities = 0;
};
/// Iterations of positions where the asset is silent: the fallbacks of PhysxRigidBodyAPI and
/// PhysxArticulationAPI.
inline constexpr double kBodyIterations = 16;
inline constexpr double kTreeIterations = 32;
/// Of a body or an articulation, within the bounds of its scene; `usual` where the settings do not
/// say how many of positions.
Iterations iterations_of(const Build& build, scene::Index scene, const Settings& settings,
                         double usual);
/// Kinetic energy by mass below which something may fall asleep [m^2/s^2]; 0: it never does.
float sleep_threshold_of(const Build& build, scene::Index scene, const Settings& settings);

/// What a body says of itself; a link has what its articulation says.
void set_body_settings(Build& build, scene::Index body, px::PxRigidBody& made);
/// The articulation whose link a body is; nullptr: of none.
const scene::Articulation* articulation_of(const Build& build, scene::Index body);

}  // namespace tenon::engines::physx
