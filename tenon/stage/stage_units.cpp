// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/stage_units.h"

#include <cmath>
#include <optional>

#include "tenon/base/text/text_number.h"
#include "tenon/layer/finding_place.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

// The strongest layer of session and root that authors `field`.
Diagnostic diagnostic_at(const Stage& stage, Token field, std::string rule, std::string message,
                         std::string fix) {
  const layer::Layer* session = stage.session_layer();
  const bool in_session = session != nullptr && session->root().has(field);
  Diagnostic diagnostic;
  diagnostic.severity = Severity::Error;
  diagnostic.rule = std::move(rule);
  diagnostic.message = std::move(message);
  layer::place_finding(diagnostic, in_session ? *session : stage.root_layer(),
                       Path::absolute_root(), layer::field_part(field));
  diagnostic.fix = std::move(fix);
  return diagnostic;
}

std::optional<double> any_number(const layer::Value& value) {
  if (const auto* x = value.get<double>()) {
    return *x;
  }
  if (const auto* x = value.get<float>()) {
    return static_cast<double>(*x);
  }
  return std::nullopt;
}

double positive(const Stage& stage, Token field, double fallback, const char* rule,
                Diagnostics& diagnostics) {
  const std::optional<double> value = any_number(stage.metadata(field));
  if (value && *value > 0 && std::isfinite(*value)) {
    return *value;
  }
  diagnostics.add(diagnostic_at(
      stage, field, rule,
      field.str() + " is " + (value ? shortest(*value) : std::string("no number")) +
          ", which is not a unit of length or mass; " + shortest(fallback) + " is taken",
      "author a positive number"));
  return fallback;
}

}  // namespace

StageUnits read_stage_units(const Stage& stage, Diagnostics& diagnostics) {
  StageUnits units;
  units.meters_per_unit = positive(stage, fields::metersPerUnit, units.meters_per_unit,
                                   "units.meters-per-unit", diagnostics);
  units.kilograms_per_unit = positive(stage, fields::kilogramsPerUnit, units.kilograms_per_unit,
                                      "units.kilograms-per-unit", diagnostics);
  const Token axis = stage.metadata(fields::upAxis).get_or<Token>(Token());
  if (axis == "X") {
    units.up_axis = UpAxis::X;
  } else if (axis == "Z") {
    units.up_axis = UpAxis::Z;
  } else if (axis != "Y") {
    diagnostics.add(diagnostic_at(stage, fields::upAxis, "units.up-axis",
                                  "upAxis is \"" + axis.str() + "\", not X, Y or Z; Y is used",
                                  "author \"Y\" or \"Z\""));
  }
  return units;
}

}  // namespace tenon::stage
