// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/engines/mujoco/build/build.h"

/// For those who add to a model before it becomes text (write_mjcf.h).
namespace tenon::engines::mujoco {

/// The model with the options that text has: those of the asset, not of simulations.
Result<SpecAndModel> writable_model(const scene::PhysicsScene& scene,
                                    const SimulationOptions& options, Diagnostics& diagnostics);

/// What runs choose for stiff drives and springs of `scene`, and a model made of it for text has
/// not; its actuators may be written elsewhere.
void report_choices_of_runs(const scene::PhysicsScene& scene, const SpecAndModel& built,
                            Diagnostics& diagnostics);

/// A compiled model as text.
Result<std::string> text_of(const mjSpec& spec);

}  // namespace tenon::engines::mujoco
