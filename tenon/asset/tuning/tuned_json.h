// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/tuning/tune_asset.h"

/// Tuned drives for programs and for people.
namespace tenon {

/// {"drives": [{"joint", "axis", "type" ("force", "acceleration", null: no drive), "stiffness",
/// "damping", "authored": {"stiffness", "damping"}, "inertia", "frequency" [rad/s], "frequencyHz",
/// "dampingRatio", "regime", "passive": {"stiffness", "damping"}, "whyNot", "to": the same numbers
/// as they are to be, or null, "changes", "notes"}], "engines": [{"engine", "engineVersion",
/// "variant", "timeStep" [s], "test", "seed", "period" [s], "amplitude", "results": [{"joint",
/// "axis", "verdict", "reasons", "saturation", "limits": [{"target", "reached", "still",
/// "settlingTime", "meanHoldError", "maxHoldError", "at"}], "step": {"overshoot", "riseTime",
/// "settlingTime", "steadyError", "form": {"overshoot", "riseTime"}, "byForm", "causes", "without":
/// the first four without these causes}, "sine": {...}, "stress": {...}, "steps": [...]}]}],
/// "search": {"overshoot", "settlingTime", "payloads" [kg], "at", "poses", "seed", "engines",
/// "scenes", "interrupted", "drives": [{"joint", "axis", "met", "frequency", "frequencyHz",
/// "dampingRatio", "overshoot", "settlingTime", "worst", "tries", "reasons"}]} of a search,
/// "wished", "request": [JOINT=stiffness:..,damping:..]}. SI and radians except "authored"; null
/// where there is no such number. Results hold what the test has.
answers::Json tuned_json(const TunedAsset& tuned);
/// With what the edits did, as edited_json() has it.
answers::Json tuned_json(const TunedAsset& tuned, const std::vector<AssetEdit>& edits,
                         const EditedAsset& edited);

/// A row of "results" with "signal": {"time", "command", "position", "velocity", "effort"}, at most
/// `most` points of each, equally many steps apart; "effort" is empty where the engine tells none.
answers::Json tested_json(const TunedEngine& engine, const tuning::DriveTestResult& result,
                          std::size_t most);

/// Every drive or, of a test, every result as a row.
std::string tuned_csv(const TunedAsset& tuned);

/// One file for browsers, which asks for no other: the table, and of each joint command, response,
/// velocity and effort on every engine.
std::string tuned_html(const std::string& asset, const TunedAsset& tuned);

}  // namespace tenon
