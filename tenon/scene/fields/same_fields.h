// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "tenon/base/path.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/scene_fields.h"

namespace tenon::scene {

/// Equal in every field, as deep as it lies; one not-a-number equals another, 0 equals -0.
template <class T>
bool same_fields(const T& a, const T& b) {
  if constexpr (std::is_floating_point_v<T>) {
    return a == b || (std::isnan(a) && std::isnan(b));
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Path> ||
                       std::is_same_v<T, std::string>) {
    return a == b;
  } else if constexpr (wire::kIsOptional<T>) {
    return a.has_value() == b.has_value() && (!a || same_fields(*a, *b));
  } else if constexpr (wire::kIsPair<T>) {
    return same_fields(a.first, b.first) && same_fields(a.second, b.second);
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
      same = same_fields(a[i], b[i]);
    }
    return same;
  } else if constexpr (HasTable<T>) {
    bool same = true;
    each_field_of_both(a, b, [&](const FieldInfo&, const auto& x, const auto& y) {
      same = same && same_fields(x, y);
    });
    return same;
  } else {
    return a == b;  // vectors, rotations, poses, matrices
  }
}

}  // namespace tenon::scene
