// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/units.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"
#include "tenon/physics/attribute_values.h"
#include "tenon/stage/stage_units.h"

namespace tenon::physics {
namespace {

namespace fields = layer::fields;

/// A finding at what `field` of a layer says.
Diagnostic finding_at(const layer::Layer& layer, Token field, const char* rule) {
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = rule;
  layer::place_finding(finding, layer, Path::absolute_root(), layer::field_part(field));
  return finding;
}

/// S-11: units are those of the stage; a layer that authors others means other sizes or masses.
void report_mixed(const stage::Stage& stage, Token field, double used, Diagnostics& diagnostics) {
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    const layer::Value* value = layer->root().find(field);
    const bool of_stage =
        layer.get() == &stage.root_layer() || layer.get() == stage.session_layer();
    if (of_stage || value == nullptr) {
      continue;
    }
    const double authored = number_of(*value).value_or(used);
    if (std::fabs(authored - used) <= 1e-5 * used) {
      continue;
    }
    Diagnostic finding = finding_at(*layer, field, "units.mixed");
    finding.message = "the layer says " + field.str() + " = " + shortest(authored) +
                      ", the stage " + shortest(used) + "; its numbers are not converted";
    finding.fix =
        "convert the layer, or scale where it is referenced and author masses again; the reading "
        "layer-units=layer converts its opinions";
    diagnostics.add(std::move(finding));
  }
}

/// What a rate that is none does. Composition converts by rates as OpenUSD does: by the quotient of
/// two of them where that is finite and not zero.
std::string effect_of(Token field, double rate, bool counts) {
  if (!counts) {
    return "which nothing can be played or sampled at";
  }
  const std::string instead = field == fields::framesPerSecond
                                  ? ", taken for timeCodesPerSecond, which is not authored"
                                  : "";
  if (rate < 0 && std::isfinite(rate)) {
    return "so its time runs backwards, in seconds and beside layers of positive rates" + instead;
  }
  return "so its time codes have no seconds and stay unconverted beside layers of other rates" +
         instead;
}

/// Rates of layers, those of value clips included, that are not positive numbers.
void report_rates(const stage::Stage& stage, Diagnostics& diagnostics) {
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    for (const Token field : {fields::timeCodesPerSecond, fields::framesPerSecond}) {
      const layer::Value* value = layer->root().find(field);
      const std::optional<double> rate = value == nullptr ? std::nullopt : number_of(*value);
      if (!rate || (*rate > 0 && std::isfinite(*rate))) {
        continue;
      }
      const bool counts =
          field == fields::timeCodesPerSecond || !layer->root().has(fields::timeCodesPerSecond);
      Diagnostic finding = finding_at(*layer, field, "units.time-codes-per-second");
      finding.message = "the layer says " + field.str() + " = " + shortest(*rate) + ", " +
                        effect_of(field, *rate, counts);
      finding.fix = "author a positive number, or remove it: 24 is the fallback";
      diagnostics.add(std::move(finding));
    }
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
  report_mixed(stage, fields::metersPerUnit, units.length, diagnostics);
  report_mixed(stage, fields::kilogramsPerUnit, units.mass, diagnostics);
  report_rates(stage, diagnostics);
  return units;
}

}  // namespace tenon::physics
