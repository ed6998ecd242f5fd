// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/relationship.h"

#include <algorithm>
#include <set>

#include "tenon/stage/composed_fields.h"
#include "tenon/stage/property_facts.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {

namespace fields = layer::fields;

bool Relationship::is_defined() const {
  if (prim_ == nullptr) {
    return false;
  }
  const schema::PropertyDefinition* declared = prim_->definition->find(name_);
  return (declared != nullptr && declared->is_relationship) || is_authored();
}

bool Relationship::is_authored() const {
  return prim_ != nullptr && is_authored_as(*prim_, name_, layer::SpecKind::Relationship);
}

Path Relationship::path() const {
  return prim_ == nullptr ? Path() : property_path(*prim_, proxy_path_, name_);
}

bool Relationship::is_custom() const {
  return prim_ != nullptr && prim_->definition->find_stock(name_) == nullptr &&
         any_opinion_is_custom(*prim_, name_);
}

bool Relationship::has_authored_targets() const {
  return prim_ != nullptr && has_field(*prim_, name_, fields::targetPaths);
}

std::vector<Path> Relationship::targets() const {
  return prim_ == nullptr ? std::vector<Path>()
                          : composed_targets(*stage_, *prim_, proxy_path_, name_);
}

// Depth first, in order; a relationship is followed once and is no target itself. This one counts
// like any other where a cycle leads back.
std::vector<Path> Relationship::forwarded_targets() const {
  std::vector<Path> result;
  std::set<Path> seen;   // relationships followed
  std::set<Path> found;  // what is in the result
  std::vector<Path> pending = targets();
  std::reverse(pending.begin(), pending.end());
  while (!pending.empty()) {
    const Path target = pending.back();
    pending.pop_back();
    if (target.kind() == PathKind::Property) {
      const Prim prim = stage_->find(target.parent());
      const Relationship next = prim.relationship(target.name());
      if (next.is_defined()) {
        if (seen.insert(target).second) {
          const std::vector<Path> further = next.targets();
          pending.insert(pending.end(), further.rbegin(), further.rend());
        }
        continue;
      }
    }
    if (found.insert(target).second) {
      result.push_back(target);
    }
  }
  return result;
}

layer::Value Relationship::metadata(Token field) const {
  return prim_ == nullptr ? layer::Value()
                          : compose_field(*stage_, *prim_, property_opinions(*prim_, name_), field);
}

std::map<std::string, layer::Value> Relationship::all_authored_metadata() const {
  return prim_ == nullptr ? std::map<std::string, layer::Value>()
                          : compose_metadata(*stage_, *prim_, property_opinions(*prim_, name_));
}

std::vector<SpecSite> Relationship::spec_stack() const {
  return prim_ == nullptr ? std::vector<SpecSite>() : property_sites(*prim_, name_);
}

Diagnostic Relationship::located(Severity severity, std::string rule, std::string message,
                                 StatementPart part) const {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.rule = std::move(rule);
  diagnostic.message = std::move(message);
  diagnostic.part = std::move(part);
  return located_property(prim_, path(), name_, std::move(diagnostic));
}

Diagnostic Relationship::located_target(Severity severity, std::string rule, std::string message,
                                        Path target) const {
  Diagnostic diagnostic = located(severity, std::move(rule), std::move(message));
  if (prim_ != nullptr) {
    place_target(*stage_, *prim_, path(), target, diagnostic);
  }
  return diagnostic;
}

}  // namespace tenon::stage
