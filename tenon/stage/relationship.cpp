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

bool Relationship::is_custom() const {
  return prim_ != nullptr && prim_->definition->find_stock(name_) == nullptr &&
         any_opinion_is_custom(*prim_, name_);
}

bool Relationship::has_authored_targets() const {
  return prim_ != nullptr && has_field(*prim_, name_, fields::targetPaths);
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

}  // namespace tenon::stage
