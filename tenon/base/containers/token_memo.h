// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "tenon/base/token.h"

namespace tenon {

/// Recent results for tokens; each token maps to one slot. For names that a scene has few of and
/// that are looked up at each prim.
template <class Made, std::size_t kPlaces>
class TokenMemo {
 public:
  /// `make(name)`, or what that gave.
  template <class Make>
  const Made& find_or_make(Token name, const Make& make) {
    Known& known = known_[std::hash<Token>()(name) >> 16U & (kPlaces - 1)];
    if (!known.is_made || known.name != name) {
      known = {name, make(name), true};
    }
    return known.made;
  }

 private:
  static_assert((kPlaces & (kPlaces - 1)) == 0);

  struct Known {
    Token name;
    Made made;
    bool is_made = false;
  };
  std::array<Known, kPlaces> known_;
};

}  // namespace tenon
