// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

/// What composition finds wrong with properties, in the order of prims: opinions of different kinds
/// on one property, targets and connections that arcs cannot bring to the stage. Opening a stage
/// does not look for them; this reads all properties of prims that arcs contribute to or that have
/// specs in several layers.
Diagnostics property_errors(const Stage& stage);

}  // namespace tenon::stage
