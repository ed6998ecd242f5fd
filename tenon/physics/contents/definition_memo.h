// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "tenon/base/token.h"
#include "tenon/stage/prim.h"

namespace tenon::physics {

/// What follows from the definition of a prim and the name of a property alone, found out once for
/// all prims of one stage that have the definition in common.
class DefinitionMemo {
 public:
  DefinitionMemo() = default;
  DefinitionMemo(const DefinitionMemo&) = delete;
  DefinitionMemo& operator=(const DefinitionMemo&) = delete;

  /// `found(prim, name)` the first time, later what it answered.
  template <class Found>
  bool ask(const stage::Prim& prim, Token name, Found found) {
    if (prim.definition() != last_) {
      last_ = prim.definition();
      names_ = &known_[last_];
    }
    const auto known = names_->find(name);
    return known != names_->end() ? known->second
                                  : names_->emplace(name, found(prim, name)).first->second;
  }

 private:
  using Names = std::unordered_map<Token, bool>;
  std::unordered_map<const schema::PrimDefinition*, Names> known_;
  const schema::PrimDefinition* last_ = nullptr;
  Names* names_ = &known_[nullptr];
};

}  // namespace tenon::physics
