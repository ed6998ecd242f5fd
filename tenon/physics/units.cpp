// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/units.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "tenon/base/text_number.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/stage_units.h"

namespace tenon::physics {
namespace {

/// S-11: units are those of the stage; a layer that authors others means other sizes or masses.
void report_mixed(const stage::Stage& stage, const char* field, double used,
                  Diagnostics& diagnostics) {
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    const layer::Value* value = layer->root().find(Token(field));
    const bool of_stage =
        layer.get() == &stage.root_layer() || layer.get() == stage.session_layer();
    if (of_stage || value == nullptr) {
      continue;
    }
    const double authored = number_of(*value).value_or(used);
    if (std::fabs(authored - used) <= 1e-5 * used) {
      continue;
    }
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.rule = "units.mixed";
    finding.file = layer->identifier();
    finding.message = std::string("the layer says ") + field + " = " + shortest(authored) +
                      ", the stage " + shortest(used) + "; its numbers are not converted";
    finding.fix =
        "convert the layer, or scale where it is referenced and author masses anew; the reading "
        "layer-units=layer converts its opinions";
    diagnostics.add(std::move(finding));
  }
}

}  // namespace

Units read_units(const stage::Stage& stage, Diagnostics& diagnostics) {
  const stage::StageUnits authored = stage::read_stage_units(stage, diagnostics);
  Units units;
  units.length = authored.meters_per_unit;
  units.mass = authored.kilograms_per_unit;
  units.up = {};
  units.up[static_cast<std::size_t>(authored.up_axis)] = 1;
  report_mixed(stage, "metersPerUnit", units.length, diagnostics);
  report_mixed(stage, "kilogramsPerUnit", units.mass, diagnostics);
  return units;
}

}  // namespace tenon::physics
