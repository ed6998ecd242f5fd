// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <type_traits>

#ifndef __cpp_lib_to_chars
#include <cmath>

#include <fast_float/fast_float.h>
#endif

namespace tenon {

/// std::from_chars: correctly rounded, in no locale. LLVM's library has it for integers alone;
/// there fast_float reads what has a fraction.
template <class T>
std::from_chars_result number_from_text(const char* first, const char* last, T& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_floating_point_v<T>) {
    const auto [end, error] = fast_float::from_chars(first, last, value);
    const char* const start = first != last && *first == '-' ? first + 1 : first;
    const bool is_word = start != last && *start >= 'A';
    // Some versions give infinity for what is too large.
    const bool too_large = error == std::errc() && std::isinf(value) && !is_word;
    return {end, too_large ? std::errc::result_out_of_range : error};
  } else {
    return std::from_chars(first, last, value);
  }
#else
  return std::from_chars(first, last, value);
#endif
}

}  // namespace tenon
