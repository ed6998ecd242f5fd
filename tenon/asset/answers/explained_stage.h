// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/explain.h"
#include "tenon/base/diagnostics.h"
#include "tenon/physics/readings.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// The physics of a stage, which has to outlive the result, and where it comes from.
answers::Explained explained_stage(const stage::Stage& stage, const physics::Readings& readings,
                                   Diagnostics& diagnostics);

}  // namespace tenon
