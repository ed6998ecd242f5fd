// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// The default engine of a run, and the one that others are compared with.
inline constexpr const char* kUsualEngine = "mujoco";

/// The engine that an asset runs on: the requested one, else the one that the selected variants of
/// the variant sets "Physics" name: "physx" is PhysX, every other one MuJoCo. Where that is not
/// part of this build, or variants name several, it is MuJoCo, with a warning (rules
/// sim.engine-fallback, sim.engines-mixed).
std::string choose_engine(const std::string& asked, const stage::Stage& stage,
                          Diagnostics& diagnostics);

/// The names of the engines that this build has.
std::vector<std::string> available_engines();

/// The engines that are asked for: all of this build for "all", else choose_engine(). Errors:
/// Missing (engine.missing) for "all" in a build without any.
Result<std::vector<std::string>> chosen_engines(const std::string& asked, const stage::Stage& stage,
                                                Diagnostics& diagnostics);

/// The variant of the variant sets "Physics" that is the engine's own: the one of its name, else
/// "physics", where a set has it; "" else.
std::string own_variant(const std::string& engine, const stage::Stage& stage);

/// Lets `open` select the engine's own variant, where it selects none itself and there is one. The
/// variant that it selects then; "" where it selects none of them all.
std::string select_own_variant(const std::string& engine, const stage::Stage& stage,
                               OpenOptions& open);

}  // namespace tenon
