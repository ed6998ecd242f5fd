// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// The engine that an asset is to run on: the one that is asked for, else the one that the selected
/// variants of the variant sets "Physics" name: "physx" is PhysX, every other one MuJoCo. Where
/// that is not part of this build, or variants name several, it is MuJoCo, with a warning (rules
/// sim.engine-fallback, sim.engines-mixed).
std::string choose_engine(const std::string& asked, const stage::Stage& stage,
                          Diagnostics& diagnostics);

}  // namespace tenon
