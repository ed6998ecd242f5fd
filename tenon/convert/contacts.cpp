// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/contacts.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;

namespace {

/// Bodies that no other body carries.
std::size_t tree_count(const Source& source, const LinkPrims& links) {
  const auto& above = source.tree.joint_to_parent;
  std::size_t count = 0;
  for (Index link = 0; link < source.model.links.size(); ++link) {
    const bool is_carried =
        above[link] && links.host(source.model.joints[*above[link]].parent).role == LinkRole::Body;
    count += links[link].role == LinkRole::Body && !is_carried ? 1U : 0U;
  }
  return count;
}

bool has_static_colliders(const Source& source, const LinkPrims& links) {
  for (Index link = 0; link < source.model.links.size(); ++link) {
    if (links.host(link).role == LinkRole::Static && !source.model.links[link].colliders.empty()) {
      return true;
    }
  }
  return false;
}

}  // namespace

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

void write_robot_apart(const Source& source, const LinkPrims& links, PhysicsScope& physics) {
  if (source.options.self_collision.value_or(source.model.self_collision)) {
    return;
  }
  const std::size_t trees = source.model.joints.empty() ? 0 : tree_count(source, links);
  if (trees < 2 && !(trees == 1 && has_static_colliders(source, links))) {
    return;
  }
  const Path group = physics.define("self_collision_off", "PhysicsCollisionGroup");
  physics.builder().set_relationship(group, "collection:colliders:includes",
                                     {physics.layer().robot()});
  physics.builder().set_targets(group, "PhysicsCollisionGroup", "physics:filteredGroups", {group});
}

}  // namespace tenon::convert
