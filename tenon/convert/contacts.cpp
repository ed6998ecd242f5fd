// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;

/// A collision group for each class of colliders that does not touch all others.
void Conversion::write_contact_classes() {
  std::vector<Path> groups;
  for (std::size_t i = 0; i < model_.contact_classes.size(); ++i) {
    const bool is_empty = contact_members_[i].empty();
    groups.push_back(is_empty ? Path() : define_joint("collision_group", "PhysicsCollisionGroup"));
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) {
      continue;
    }
    builder_.set_relationship(groups[i], "collection:colliders:includes",
                              std::move(contact_members_[i]));
    std::vector<Path> untouched;
    for (const robot::Index other : model_.contact_classes[i].untouched) {
      // Said once for each pair, by the first.
      if (other >= i && !groups[other].empty()) {
        untouched.push_back(groups[other]);
      }
    }
    if (!untouched.empty()) {
      builder_.set_targets(groups[i], "PhysicsCollisionGroup", "physics:filteredGroups",
                           std::move(untouched));
    }
  }
}

}  // namespace tenon::convert
