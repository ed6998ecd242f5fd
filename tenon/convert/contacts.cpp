// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;

/// What MuJoCo's contacts of a collider are like, each number in the schema that holds it.
void Conversion::write_mujoco_contact(Path prim, const robot::MujocoContact& contact) {
  constexpr const char* kMujoco = "MjcCollisionAPI";
  const auto number = [&](const char* api, const char* name, const auto& value) {
    if (value) {
      builder_.apply(prim, api);
      builder_.set_number(prim, api, name, *value);
    }
  };
  const auto list = [&](const char* name, const std::vector<double>& values) {
    if (!values.empty()) {
      builder_.apply(prim, kMujoco);
      builder_.set_value(prim, kMujoco, name, Value(values));
    }
  };
  number(kMujoco, "mjc:condim", contact.condim);
  if (options_.schema != SchemaGeneration::Current) {
    number(kMujoco, "mjc:gap", contact.gap);
    number(kMujoco, "mjc:margin", contact.margin);
  }
  number(kMujoco, "mjc:priority", contact.priority);
  list("mjc:solimp", contact.solimp);
  number(kMujoco, "mjc:solmix", contact.solmix);
  list("mjc:solref", contact.solref);
  if (options_.schema != SchemaGeneration::Legacy) {
    number("NewtonCollisionAPI", "newton:contactGap", contact.gap);
    number("NewtonCollisionAPI", "newton:contactMargin", contact.margin);
  }
}

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
