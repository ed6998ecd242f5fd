// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/simulating/simulate_asset.h"

namespace tenon {

/// The state at the end of a run: {"engine", "engineVersion", "dt" [s], "steps", "time" [s],
/// "realTimeFactor" (with `timing`), "unstable", "bodies": {PATH: {"position", "orientation" (w, x,
/// y, z), "linearVelocity", "angularVelocity"}}, "joints": {PATH: {"position", "velocity"}},
/// "energy": {"initial", "final"} [J], "contacts", "events": [{"time", "prim", "what"}],
/// "notMapped": [{"prim", "property", "why"}]}. Bodies and joints in units of the stage and
/// degrees. Of what was asked for: "begin" [s] and "stateIn", "commands": {"file", "rows",
/// "columns"}, "rest": {"reached", "since" [s]}, "log": names of outputs.
answers::Json simulated_json(const SimulatedAsset& simulated, bool timing);

/// [{"prim", "property", "why"}]: what was not taken over.
answers::Json not_mapped_json(const std::vector<scene::NotRead>& list);

/// {"output", "frames", "bodies", "time"}: what a layer of motion holds.
answers::Json motion_json(const SimulatedAsset& simulated, const std::string& output);

}  // namespace tenon
