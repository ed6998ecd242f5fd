// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/diagnostics.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {

enum class UpAxis : unsigned char { X, Y, Z };

/// How the numbers of a stage are to be read (S-7 to S-9 of docs/physics.md): metadata of the root
/// layer, overridden by the session layer.
struct StageUnits {
  double meters_per_unit = 0.01;  ///< OpenUSD's fallback is a centimetre
  double kilograms_per_unit = 1.0;
  UpAxis up_axis = UpAxis::Y;
};

/// Values that cannot be used (zero, negative, not finite, an unknown axis) are diagnosed as errors
/// "units.meters-per-unit", "units.kilograms-per-unit" and "units.up-axis" and the fallback is
/// taken.
StageUnits read_stage_units(const Stage& stage, Diagnostics& diagnostics);

}  // namespace tenon::stage
