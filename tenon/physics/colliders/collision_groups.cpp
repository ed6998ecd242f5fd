// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Groups, and which colliders each has (S-76 to S-80). Whether two groups touch is a table of
// groups by groups (filters.h), at the start and at each later sample. Membership is decided by
// asking a group's collection for each collider; expressions of all groups together may compare so
// many names (kMatchWork).
#include <algorithm>
#include <string>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/base/limits/work_limits.h"
#include "tenon/physics/colliders/filters.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/sample_codes.h"
#include "tenon/stage/collections/collection.h"

namespace tenon::physics {
namespace {

/// PhysX turns the pairs of all groups around: those that are named touch, no others do.
bool scenes_invert(const ReadState& state, const Walk& walk) {
  return std::any_of(walk.prims.begin(), walk.prims.end(), [&](const PhysicsPrim& found) {
    return found.roles.kind == PrimKind::Scene && found.roles.has(Api::PhysxScene) &&
           state.values.authored_flag(found.prim, "physxScene:invertCollisionGroupFilter")
               .value_or(false);
  });
}

GroupTable table_of(const ReadState& state, const Walk& walk,
                    const std::vector<AuthoredGroup>& groups) {
  GroupTable table = group_table(groups, state.readings.ungrouped);
  if (scenes_invert(state, walk)) {
    for (char& off : table.pair_off) {
      off = off == 0 ? 1 : 0;
    }
  }
  return table;
}

AuthoredGroup read_group(const ReadState& state, const PhysicsPrim& found,
                         const std::vector<Path>& paths) {
  AuthoredGroup group;
  const AttributeValues& values = state.values;
  group.inverted = values.authored_flag(found.prim, state.tokens.invert_groups).value_or(false);
  group.merge =
      values.get<std::string>(found.prim, state.tokens.merge_group).value_or(std::string());
  for (const Path& target : state.targets(found.prim, state.tokens.filtered_groups)) {
    const auto group_at = std::lower_bound(paths.begin(), paths.end(), target);
    if (group_at == paths.end() || !(*group_at == target)) {
      // S-80
      values.report_target(found.prim, state.tokens.filtered_groups, target, Severity::Warning,
                           "group.unknown-target",
                           "physics:filteredGroups names " + named(target, RelatedRole::Target) +
                               ", which is not a collision group; it is ignored",
                           "name a PhysicsCollisionGroup");
      continue;
    }
    group.filtered.push_back(static_cast<Index>(group_at - paths.begin()));
  }
  return group;
}

/// S-116: tables of later times where what groups say is animated; relationships cannot be.
void read_group_states(ReadState& state, const std::vector<std::uint32_t>& prims) {
  std::vector<stage::Attribute> flags;
  for (const std::uint32_t i : prims) {
    for (const Token name : {state.tokens.invert_groups, state.tokens.merge_group}) {
      flags.push_back(state.walk.prims[i].prim.attribute(name));
      state.follow(state.walk.prims[i].prim, name);
    }
  }
  const std::vector<double> codes = sample_codes(flags);
  for (const double code : codes.size() > 1 ? codes : std::vector<double>()) {
    Diagnostics silent;  // what there is to say was said at the start
    const ReadState later = state.at(code, silent);
    std::vector<AuthoredGroup> groups;
    for (const std::uint32_t i : prims) {
      groups.push_back(read_group(later, state.walk.prims[i], state.scene.filter.group_paths));
    }
    GroupTable table = table_of(later, state.walk, groups);
    state.scene.group_states.push_back(
        {state.seconds(code), std::move(table.pair_off), std::move(table.ungrouped_off)});
  }
}

/// Of all groups so far.
struct GroupWork {
  std::size_t read = 0;     ///< kCollisionGroupWork
  std::size_t matched = 0;  ///< kMatchWork
};

/// Membership is asked of the colliders' own paths (S-76).
void find_members(ReadState& state, const PhysicsPrim& found, Index group, GroupWork& work) {
  const stage::Collection members = stage::Collection::read(
      found.prim, Token("colliders"),
      limits::kCollisionGroupWork - std::min(work.read, limits::kCollisionGroupWork));
  work.read += members.work();
  const auto is_exhausted = [&] {
    return members.rules().empty() && work.matched + members.match_work() > limits::kMatchWork;
  };
  for (std::size_t i = 0; i < state.scene.colliders.size() && !is_exhausted(); ++i) {
    // Instances of point instancers are members where their prototypes are, too.
    const PhysicsPrim& prim = state.prim_of_collider(static_cast<Index>(i));
    if (members.contains(prim.path) ||
        (prim.instance != kNone && members.contains(prim.prim.path()))) {
      state.scene.filter.groups_of_collider[i].push_back(group);
    }
  }
  if (members.is_cut() || is_exhausted()) {
    state.not_read(found.prim, "collection:colliders",
                   "the collection, or all of groups together, are too large "
                   "(kCollisionGroupWork, kCollectionItems, kMatchWork); some of its colliders are "
                   "not in the group");
  }
  work.matched += members.match_work();
}

/// S-78
void report_ungrouped(const ReadState& state, const std::vector<std::uint32_t>& prims,
                      const std::vector<AuthoredGroup>& groups) {
  const std::vector<std::vector<Index>>& of = state.scene.filter.groups_of_collider;
  const auto alone = [](const std::vector<Index>& list) { return list.empty(); };
  if (std::none_of(of.begin(), of.end(), alone)) {
    return;
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].inverted) {
      state.report(state.walk.prims[prims[i]].prim, state.tokens.invert_groups, Severity::Info,
                   "group.inverted-and-ungrouped",
                   "colliders in no group do not touch this inverted group; in OpenUSD's table of "
                   "groups they do",
                   "put every collider into a group");
    }
  }
}

}  // namespace

void read_collision_groups(ReadState& state) {
  CollisionFilter& filter = state.scene.filter;
  filter.groups_of_collider.resize(state.scene.colliders.size());
  auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::CollisionGroup; });
  if (prims.size() > limits::kCollisionGroups) {
    state.not_read(state.walk.prims[prims[limits::kCollisionGroups]].prim, "",
                   "there are more than " + std::to_string(limits::kCollisionGroups) +
                       " collision groups (kCollisionGroups); this one and those that follow it "
                       "by path are skipped");
    prims.resize(limits::kCollisionGroups);
  }
  for (const std::uint32_t i : prims) {
    filter.group_paths.push_back(state.walk.prims[i].path);
  }
  std::vector<AuthoredGroup> groups;
  GroupWork work;
  for (const std::uint32_t i : prims) {
    const auto index = static_cast<Index>(groups.size());
    groups.push_back(read_group(state, state.walk.prims[i], filter.group_paths));
    find_members(state, state.walk.prims[i], index, work);
  }
  GroupTable table = table_of(state, state.walk, groups);
  filter.group_pair_off = std::move(table.pair_off);
  filter.ungrouped_off = std::move(table.ungrouped_off);
  report_ungrouped(state, prims, groups);
  if (state.values.stage_is_animated()) {
    read_group_states(state, prims);
  }
}

}  // namespace tenon::physics
