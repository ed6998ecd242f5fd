// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"
#include "tenon/physics/readings.h"

/// How every verb that prints, exports or simulates the physics of an asset opens and reads it, so
/// that all of them give the same numbers.
namespace tenon {

/// `options` for a stage whose physics is read with these readings (S-11).
OpenOptions with_readings(OpenOptions options, const physics::Readings& readings);

/// The readings, and the decomposition and simplification of meshes (S-62), with the user's cache.
physics::ReadOptions read_options(const physics::Readings& readings = {});

}  // namespace tenon
