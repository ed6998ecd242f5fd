// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "tenon/base/wire.h"

namespace tenon::guard {

/// Whether a number in a value, as deep as it may lie, is none.
template <class T>
bool has_not_a_number(const T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::isnan(value);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                       std::is_same_v<T, std::string>) {
    return false;
  } else if constexpr (wire::kIsOptional<T>) {
    return value && has_not_a_number(*value);
  } else if constexpr (wire::kIsMap<T>) {
    for (const auto& [key, item] : value) {
      if (has_not_a_number(item)) {
        return true;
      }
    }
    return false;
  } else if constexpr (wire::kIsVector<T> || wire::kIsArray<T>) {
    for (const auto& item : value) {
      if (has_not_a_number(item)) {
        return true;
      }
    }
    return false;
  } else {
    return wire::with_fields(value,
                             [](const auto&... field) { return (has_not_a_number(field) || ...); });
  }
}

}  // namespace tenon::guard
