// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/bake/run_simulation.h"
#include "tenon/base/diagnostics.h"

namespace tenon::bake {

/// What is wrong with a run though it went to its end, as warnings, or infos where it is little:
/// bodies that passed through others (sim.passed-through), joints that shake or end outside of
/// their limits (sim.joint-shakes, sim.beyond-limit), energy that was lost where nothing takes any
/// (sim.energy-drift), bodies that turn faster than the steps resolve (sim.fast-spin). The worst is
/// named, others are related.
/// `engine` is named where runs on several are told together; empty: it is not.
void report_run(const scene::PhysicsScene& scene, const Run& run, Diagnostics& diagnostics,
                const std::string& engine = "");

}  // namespace tenon::bake
