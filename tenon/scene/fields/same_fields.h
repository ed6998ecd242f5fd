// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "tenon/base/wire.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::scene {

/// Two values have the same shape, and `agree(x, y)` holds for all numbers, words and places in
/// them, as deep as they lie.
template <class T, class Agree>
bool fields_agree(const T& a, const T& b, const Agree& agree) {
  if constexpr (wire::kIsOptional<T>) {
    return a.has_value() == b.has_value() && (!a || fields_agree(*a, *b, agree));
  } else if constexpr (wire::kIsPair<T>) {
    return fields_agree(a.first, b.first, agree) && fields_agree(a.second, b.second, agree);
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
      same = fields_agree(a[i], b[i], agree);
    }
    return same;
  } else if constexpr (HasTable<T>) {
    bool same = true;
    each_field_of_both(a, b, [&](const FieldInfo&, const auto& x, const auto& y) {
      same = same && fields_agree(x, y, agree);
    });
    return same;
  } else {
    return agree(a, b);
  }
}

/// Equal in every field, as deep as it lies; one not-a-number equals another, 0 equals -0.
template <class T>
bool same_fields(const T& a, const T& b) {
  return fields_agree(a, b, []<class Leaf>(const Leaf& x, const Leaf& y) {
    if constexpr (std::is_floating_point_v<Leaf>) {
      return x == y || (std::isnan(x) && std::isnan(y));
    } else {
      return x == y;
    }
  });
}

}  // namespace tenon::scene
