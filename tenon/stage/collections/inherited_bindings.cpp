// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Walking up from a prim, a direct binding replaces what was found below only when it says
// strongerThanDescendants. Seen from above: the topmost binding that says so holds, else the prim's
// own, else what holds at its parent. So the answer for a prim follows from that for its parent.
// Collections name the prims that they hold for, and are looked at for each of them.
#include "tenon/stage/collections/inherited_bindings.h"

#include <algorithm>

#include "tenon/stage/collections/binding_rules.h"

namespace tenon::stage {

MaterialBinding InheritedBindings::find(const Prim& prim) {
  chain_.clear();
  std::uint32_t number = 0;
  for (Prim at = prim.parent(); at && !at.is_pseudo_root(); at = at.parent()) {
    if (const auto known = number_at_.find(at.path()); known != number_at_.end()) {
      number = known->second;
      break;
    }
    chain_.push_back(at);
  }
  for (auto at = chain_.rbegin(); at != chain_.rend(); ++at) {
    number = number_of(*at, number);
    number_at_.emplace(at->path(), number);
  }
  const Found& found = found_[number_of(prim, number)];
  if (found.has_collections) {
    return find_material_binding(prim, purpose_, of_collections_);
  }
  const bool bound = !found.for_purpose.binding.material.empty();
  return (bound ? found.for_purpose : found.for_all).binding;
}

/// The number of what holds at a prim; that of the prim above where it binds nothing itself.
std::uint32_t InheritedBindings::number_of(const Prim& prim, std::uint32_t above) {
  const std::vector<Token>& names = prim.unordered_property_names();
  if (std::none_of(names.begin(), names.end(), is_any_binding)) {
    return above;
  }
  Found found = found_[above];
  found.has_collections =
      found.has_collections || std::any_of(names.begin(), names.end(), is_any_collection_binding);
  const auto take = [&](Token purpose, Winner& winner) {
    const Token name = direct_binding_name(purpose);
    if (winner.is_stronger || !prim.has_property(name)) {
      return;
    }
    const Relationship binding = prim.relationship(name);
    const std::optional<Path> material = direct_material(prim, targets_.targets(binding));
    if (material) {
      winner = {made_binding(prim, binding, *material), is_stronger(binding)};
    }
  };
  take(purpose_, found.for_purpose);
  if (!purpose_.empty()) {
    take(Token(), found.for_all);
  }
  found_.push_back(found);
  return static_cast<std::uint32_t>(found_.size() - 1);
}

}  // namespace tenon::stage
