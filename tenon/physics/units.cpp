// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/units.h"

#include "tenon/stage/stage_units.h"

namespace tenon::physics {

Units read_units(const stage::Stage& stage, Diagnostics& diagnostics) {
  const stage::StageUnits authored = stage::read_stage_units(stage, diagnostics);
  Units units;
  units.length = authored.meters_per_unit;
  units.mass = authored.kilograms_per_unit;
  units.up = {};
  units.up[static_cast<std::size_t>(authored.up_axis)] = 1;
  return units;
}

}  // namespace tenon::physics
