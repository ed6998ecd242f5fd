// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/property.h"

#include <utility>

#include "tenon/stage/composed_fields.h"
#include "tenon/stage/property_facts.h"
#include "tenon/stage/stage_data.h"
#include "tenon/stage/targets/composed_targets.h"

namespace tenon::stage {

Path Property::path() const {
  return prim_ == nullptr ? Path() : property_path(*prim_, proxy_path_, name_);
}

bool Property::is_authored_as(layer::SpecKind kind) const {
  return prim_ != nullptr && stage::is_authored_as(*prim_, name_, kind);
}

std::vector<Path> Property::composed_targets() const {
  return prim_ == nullptr ? std::vector<Path>()
                          : stage::composed_targets(*stage_, *prim_, proxy_path_, name_);
}

std::map<std::string, layer::Value> Property::all_authored_metadata() const {
  return prim_ == nullptr ? std::map<std::string, layer::Value>()
                          : compose_metadata(*stage_, *prim_, property_opinions(*prim_, name_));
}

std::vector<SpecSite> Property::spec_stack() const {
  return prim_ == nullptr ? std::vector<SpecSite>() : property_sites(*prim_, name_);
}

Diagnostic Property::located(Severity severity, std::string rule, const Message& message,
                             StatementPart part) const {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.rule = std::move(rule);
  diagnostic.say(message);
  diagnostic.part = std::move(part);
  return located_property(prim_, path(), name_, std::move(diagnostic));
}

Diagnostic Property::located_target(Severity severity, std::string rule, const Message& message,
                                    Path target) const {
  Diagnostic diagnostic = located(severity, std::move(rule), message);
  if (prim_ != nullptr) {
    place_target(*stage_, *prim_, path(), target, diagnostic);
  }
  return diagnostic;
}

}  // namespace tenon::stage
