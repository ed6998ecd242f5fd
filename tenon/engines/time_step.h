// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/simulation_values.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::engines {

/// The time step that is asked for; else that of the asset, divided until it is at most 4 ms; else
/// 2 ms [s]. That it is divided is told: `engine` in words ("MuJoCo"), `rule` of the finding.
double choose_time_step(const scene::PhysicsScene& scene, const SimulationOptions& options,
                        std::string_view engine, std::string_view rule, Diagnostics& diagnostics);

/// On engines whose drives pull to where the step ends: an info about the drive whose spring k the
/// step damps most, where k dt is more than the authored damping. Arguments as above; the others
/// are related.
void report_spring_damping(const scene::PhysicsScene& scene, double time_step,
                           std::string_view engine, std::string_view rule,
                           Diagnostics& diagnostics);

}  // namespace tenon::engines
