// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/composition_error.h"

#include <utility>

#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

std::string rule_of(std::string_view error_class) { return "compose." + std::string(error_class); }

}  // namespace

bool is_work_exceeded(const Diagnostic& found) {
  static const std::string rule = rule_of(error_class::kWorkExceeded);
  return found.rule == rule;
}

Diagnostic composition_error(std::string_view error_class, Severity severity, const AuthoredAt& at,
                             const Message& message, std::string fix) {
  Diagnostic found;
  found.severity = severity;
  found.rule = rule_of(error_class);
  found.say(message);
  found.fix = std::move(fix);
  if (!at.prim.empty()) {
    found.prim = at.prim.str();
  }
  if (at.layer == nullptr) {
    return found;
  }
  if (at.spec.is_property()) {
    found.property = at.spec.name().str();
  }
  layer::place_finding(found, *at.layer, at.spec, at.part);
  return found;
}

Message named_in(const layer::Layer& layer, Path path) {
  return named(path, path.is_property() ? RelatedRole::Property : RelatedRole::Prim,
               layer.identifier());
}

}  // namespace tenon::compose
