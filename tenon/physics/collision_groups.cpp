// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/physics/filters.h"
#include "tenon/physics/read_state.h"
#include "tenon/stage/collection.h"

namespace tenon::physics {
namespace {

AuthoredGroup read_group(const ReadState& state, const PhysicsPrim& found,
                         const std::vector<Path>& paths) {
  AuthoredGroup group;
  const AttributeValues& values = state.values;
  group.inverted = values.authored_flag(found.prim, state.tokens.invert_groups).value_or(false);
  group.merge =
      values.get<std::string>(found.prim, state.tokens.merge_group).value_or(std::string());
  for (const Path& target : found.prim.relationship(state.tokens.filtered_groups).targets()) {
    const auto named = std::lower_bound(paths.begin(), paths.end(), target);
    if (named == paths.end() || !(*named == target)) {
      // S-80
      state.report(found.prim, state.tokens.filtered_groups, Severity::Warning,
                   "group.unknown-target",
                   "physics:filteredGroups names <" + target.str() +
                       ">, which is no collision group; it is ignored",
                   "name a PhysicsCollisionGroup");
      continue;
    }
    group.filtered.push_back(static_cast<Index>(named - paths.begin()));
  }
  return group;
}

/// Membership is asked of the colliders' own paths (S-76).
void find_members(ReadState& state, const PhysicsPrim& found, Index group) {
  const stage::Collection members = stage::Collection::read(found.prim, Token("colliders"));
  for (std::size_t i = 0; i < state.scene.colliders.size(); ++i) {
    if (members.contains(state.scene.colliders[i].path)) {
      state.scene.filter.groups_of_collider[i].push_back(group);
    }
  }
}

}  // namespace

void read_collision_groups(ReadState& state) {
  CollisionFilter& filter = state.scene.filter;
  filter.groups_of_collider.resize(state.scene.colliders.size());
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::CollisionGroup; });
  for (const std::uint32_t i : prims) {
    filter.group_paths.push_back(state.walk.prims[i].path);
  }
  std::vector<AuthoredGroup> groups;
  for (const std::uint32_t i : prims) {
    const auto index = static_cast<Index>(groups.size());
    groups.push_back(read_group(state, state.walk.prims[i], filter.group_paths));
    find_members(state, state.walk.prims[i], index);
  }
  GroupTable table = group_table(groups);
  filter.group_pair_off = std::move(table.pair_off);
  filter.ungrouped_off = std::move(table.ungrouped_off);
}

}  // namespace tenon::physics
