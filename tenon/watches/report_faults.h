// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/watches/run_watches.h"

namespace tenon::watches {

/// What is wrong with a run, as warnings, or infos where it is little: bodies that passed through
/// others (sim.passed-through, of `events`), joints that limits throw back (sim.limit-rebound, of
/// `events`), that shake or end outside of their limits
/// (sim.joint-shakes, sim.beyond-limit), drives that weight keeps away from their targets
/// (sim.drive-sags), energy that was lost where nothing takes any (sim.energy-drift), bodies that
/// turn faster than the steps resolve (sim.fast-spin). The worst is named, others are related.
/// `engine` is named where runs on several are told together; empty: it is not.
void report_faults(const scene::PhysicsScene& scene, const RunFaults& faults,
                   const std::vector<engines::Event>& events, Diagnostics& diagnostics,
                   const std::string& engine = "");

}  // namespace tenon::watches
