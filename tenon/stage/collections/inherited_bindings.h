// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tenon/stage/collections/material_binding.h"
#include "tenon/stage/targets/target_memo.h"

namespace tenon::stage {

/// What find_material_binding() answers, for many prims of one stage that does not change
/// meanwhile: what the prims above them bind is looked at once.
class InheritedBindings {
 public:
  InheritedBindings(Token purpose, TargetMemo& targets) : purpose_(purpose), targets_(targets) {
    found_.emplace_back();
  }

  MaterialBinding find(const Prim& prim);

 private:
  /// The binding of one kind that holds at a prim and, without one of their own, below it.
  struct Winner {
    MaterialBinding binding;
    bool is_stronger = false;  ///< than all that is bound below
  };
  struct Found {
    Winner for_purpose;
    Winner for_all;
    bool has_collections = false;  ///< here or above: they hold for some prims and not for others
  };

  std::uint32_t number_of(const Prim& prim, std::uint32_t above);

  Token purpose_;
  TargetMemo& targets_;
  CollectionBindings of_collections_;
  std::vector<Found> found_;                           // the first is that of no binding at all
  std::unordered_map<Path, std::uint32_t> number_at_;  // of found_, for prims with others below
  std::vector<Prim> chain_;
};

}  // namespace tenon::stage
