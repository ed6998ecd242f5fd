// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

/// Which numbers are enumerators, told by the compiler. They are less than kMaxEnumerators.
namespace tenon::wire {

inline constexpr std::size_t kMaxEnumerators = 32;

/// Compilers write a value that has no name as a cast: "(Kind)7".
template <class Enum, Enum kValue>
constexpr bool has_name() {
  constexpr std::string_view kText = __PRETTY_FUNCTION__;
  constexpr std::size_t kAt = kText.find("kValue = ") + std::string_view("kValue = ").size();
  return kText[kAt] != '(';
}

template <class Enum, std::size_t... At>
constexpr std::array<bool, sizeof...(At)> named(std::index_sequence<At...>) {
  return {has_name<Enum, static_cast<Enum>(At)>()...};
}

template <class Enum>
constexpr bool is_enumerator(std::underlying_type_t<Enum> number) {
  constexpr auto kNamed = named<Enum>(std::make_index_sequence<kMaxEnumerators>());
  static_assert(!kNamed.back(), "raise kMaxEnumerators");
  const auto at = static_cast<std::uint64_t>(number);
  return at < kNamed.size() && kNamed[static_cast<std::size_t>(at)];
}

}  // namespace tenon::wire
