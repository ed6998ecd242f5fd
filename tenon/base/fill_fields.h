// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "tenon/base/path.h"
#include "tenon/base/wire.h"

/// For tests that walk every field of a value.
namespace tenon::wire {

/// Gives every leaf something that is not its default; lists get two items, optionals are set,
/// indices lead somewhere.
class FillFields {
 public:
  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = !value;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(1);
    } else if constexpr (std::is_same_v<T, std::uint32_t> || std::is_same_v<T, char> ||
                         std::is_same_v<T, int>) {
      value = static_cast<T>(++small_ % 2);
    } else if constexpr (std::is_arithmetic_v<T>) {
      value = static_cast<T>(++next_) / 4;
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "word" + std::to_string(100'000 + ++next_);
    } else if constexpr (std::is_same_v<T, Path>) {
      value = Path::from("/p" + std::to_string(++next_));
    } else if constexpr (kIsOptional<T>) {
      (*this)(value.emplace());
    } else if constexpr (kIsMap<T>) {
      (*this)(value["key " + std::to_string(++next_)]);
      (*this)(value["key " + std::to_string(++next_)]);
    } else if constexpr (kIsPair<T>) {
      (*this)(value.first);
      (*this)(value.second);
    } else if constexpr (kIsVector<T> || kIsArray<T>) {
      if constexpr (kIsVector<T>) {
        value.resize(2);
      }
      for (auto& item : value) {
        (*this)(item);
      }
    } else {
      with_fields(value, [&](auto&... field) { ((*this)(field), ...); });
    }
  }

 private:
  int next_ = 0;
  int small_ = 0;
};

}  // namespace tenon::wire
