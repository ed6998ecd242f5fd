// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
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

/// The variant of the variant sets "Physics" that is the engine's own: the one of its name, else
/// "physics", where a set has it; "" else.
std::string own_variant(const std::string& engine, const stage::Stage& stage);

}  // namespace tenon
