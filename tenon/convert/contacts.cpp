// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/contacts.h"

namespace tenon::convert {

using layer::Value;

void write_mujoco_contact(LayerBuilder& builder, Path prim, const robot::MujocoContact& contact,
                          SchemaGeneration generation) {
  constexpr const char* kMujoco = "MjcCollisionAPI";
  const auto number = [&](const char* api, const char* name, const auto& value) {
    if (value) {
      builder.apply(prim, api);
      builder.set_number(prim, api, name, *value);
    }
  };
  const auto list = [&](const char* name, const std::vector<double>& values) {
    if (!values.empty()) {
      builder.apply(prim, kMujoco);
      builder.set_value(prim, kMujoco, name, Value(values));
    }
  };
  number(kMujoco, "mjc:condim", contact.condim);
  if (generation != SchemaGeneration::Current) {
    number(kMujoco, "mjc:gap", contact.gap);
    number(kMujoco, "mjc:margin", contact.margin);
  }
  number(kMujoco, "mjc:priority", contact.priority);
  list("mjc:solimp", contact.solimp);
  number(kMujoco, "mjc:solmix", contact.solmix);
  list("mjc:solref", contact.solref);
  if (generation != SchemaGeneration::Legacy) {
    number("NewtonCollisionAPI", "newton:contactGap", contact.gap);
    number("NewtonCollisionAPI", "newton:contactMargin", contact.margin);
  }
}

void write_contact_classes(PhysicsScope& physics, const std::vector<robot::ContactClass>& classes,
                           const std::vector<std::vector<Path>>& members) {
  std::vector<Path> groups;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const bool is_empty = members[i].empty();
    groups.push_back(is_empty ? Path()
                              : physics.define("collision_group", "PhysicsCollisionGroup"));
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].empty()) {
      continue;
    }
    physics.builder().set_relationship(groups[i], "collection:colliders:includes", members[i]);
    std::vector<Path> untouched;
    for (const robot::Index other : classes[i].untouched) {
      // Said once for each pair, by the first.
      if (other >= i && !groups[other].empty()) {
        untouched.push_back(groups[other]);
      }
    }
    if (!untouched.empty()) {
      physics.builder().set_targets(groups[i], "PhysicsCollisionGroup", "physics:filteredGroups",
                                    std::move(untouched));
    }
  }
}

}  // namespace tenon::convert
