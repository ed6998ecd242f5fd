// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A spec says something about the prims that have it among their opinions, which a table finds. A
// new child is composed as any other below its parent, whose index has all that may bring opinions
// to it. What else could depend on a new spec is an arc that leads to it and found nothing so far:
// no arc does so as long as none of the layers has the name in the target of one (arc_names.h).
// Instances and prototypes take a new stage, since prims move between prototypes.
#include "tenon/stage/edited/spec_follower.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "tenon/compose/child_names.h"
#include "tenon/compose/prim_index.h"
#include "tenon/stage/composed_type.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

/// The records of a stage that may be changed: it made them as such.
StageData& records(Stage& stage) { return const_cast<StageData&>(stage.data()); }

/// An index of the stage's own cache, which made it as what may be changed.
compose::PrimIndex& index_of(const PrimData& prim) {
  return const_cast<compose::PrimIndex&>(*prim.index);
}

bool has_own_children(const PrimData& prim) {
  return prim.active && !prim.in_prototype && !prim.is_instance();
}

bool begins_with(const std::vector<Token>& names, const std::vector<Token>& head) {
  return names.size() >= head.size() && std::equal(head.begin(), head.end(), names.begin());
}

}  // namespace

bool SpecFollower::can_follow() const { return stage_.data().clip_sets.empty(); }

bool SpecFollower::follow(const std::vector<SpecNews>& news) {
  StageData& data = records(stage_);
  known_ = data.prims.size();
  for (const SpecNews& one : news) {
    if (may_be_waited_for(one.new_children)) {
      return false;
    }
    const std::vector<std::uint32_t> prims = prims_of(one.spec);
    for (const std::uint32_t number : prims) {
      PrimData& prim = *data.numbered(number);
      compose::compose_property_names(index_of(prim));
      if (number != 1) {  // the pseudo-root has no type
        prim.definition = &data.definitions.get(composed_type_name(*prim.index),
                                                composed_api_schemas(*prim.index));
      }
      if (!one.new_children.empty() && !add_children(number, one.new_children)) {
        return false;
      }
    }
  }
  return true;
}

/// By number, those that have the spec among their opinions.
const std::vector<std::uint32_t>& SpecFollower::prims_of(const layer::Spec* spec) {
  static const std::vector<std::uint32_t> none;
  if (prims_of_.empty()) {
    for (std::uint32_t number = 1; number <= stage_.data().prims.size(); ++number) {
      note_prim(number);
    }
  }
  const auto prims = prims_of_.find(spec);
  return prims == prims_of_.end() ? none : prims->second;
}

void SpecFollower::note_prim(std::uint32_t number) {
  for (const compose::Opinion& opinion : stage_.data().numbered(number)->index->opinions()) {
    prims_of_[opinion.spec].push_back(number);
  }
}

/// Some arc may lead to a prim of one of these names, wherever it is.
bool SpecFollower::may_be_waited_for(const std::vector<Token>& names) {
  if (!names.empty() && !arc_names_) {
    arc_names_.emplace(stage_.used_layers());
  }
  return std::any_of(names.begin(), names.end(),
                     [this](Token name) { return arc_names_->may_have(name); });
}

/// What is there already was added in this call, with the prim above it.
bool SpecFollower::add_children(std::uint32_t parent, const std::vector<Token>& names) {
  const StageData& data = stage_.data();
  const PrimData& prim = *data.numbered(parent);
  if (!has_own_children(prim) || !data.options.mask.empty()) {
    return false;
  }
  const compose::NameList before = prim.index->child_names;
  compose::compose_child_names(index_of(prim));
  if (!begins_with(prim.index->child_names.list(), before.list())) {
    return false;
  }
  return std::all_of(names.begin(), names.end(), [&](Token name) {
    const std::uint32_t there = data.by_path.find(prim.path.child(name), data.path_of());
    return there == 0 ? add_child(parent, name) : there > known_;
  });
}

/// The child with all that is below it.
bool SpecFollower::add_child(std::uint32_t parent, Token name) {
  StageData& data = records(stage_);
  std::deque<std::pair<std::uint32_t, Token>> open{{parent, name}};
  for (; !open.empty(); open.pop_front()) {
    const auto [above, next] = open.front();
    const std::uint32_t number = add_plain_child(data, above, next);
    if (number == 0) {
      return false;
    }
    link(above, number);
    note_prim(number);
    const PrimData& added = *data.numbered(number);
    for (const Token below : added.active ? added.index->child_names : compose::NameList()) {
      open.emplace_back(number, below);
    }
  }
  return true;
}

/// Behind the other children.
void SpecFollower::link(std::uint32_t parent, std::uint32_t child) {
  StageData& data = records(stage_);
  const auto [last, first_time] = last_child_.try_emplace(parent, 0);
  if (first_time) {
    for (std::uint32_t at = data.numbered(parent)->first_child; at != 0;
         at = data.numbered(at)->next_sibling) {
      last->second = at;
    }
  }
  (last->second == 0 ? data.numbered(parent)->first_child
                     : data.numbered(last->second)->next_sibling) = child;
  last->second = child;
}

}  // namespace tenon::stage
