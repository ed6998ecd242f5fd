// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/literals.h"
#include "tenon/layer/number_arrays.h"
#include "tenon/layer/scalar_types.h"
#include "tenon/math/half.h"
#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

/// Long lists of numbers and of tuples in the form in which programs write them. Whatever looks
/// otherwise is left to the reader of single elements, which also finds what is wrong with it.
namespace tenon::formats::text {

inline void skip_blanks(const char*& at, const char* end) {
  while (at != end && (*at == ' ' || *at == '\t')) {
    ++at;
  }
}
inline void skip_space(const char*& at, const char* end) {
  while (at != end && (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r')) {
    ++at;
  }
}
inline bool take_comma(const char*& at, const char* end) {
  skip_blanks(at, end);
  if (at == end || *at != ',') {
    return false;
  }
  ++at;
  skip_space(at, end);
  return true;
}

// take_plain(at, end, value): one element; false leaves `at` anywhere.
inline bool take_plain(const char*& at, const char* end, double& value) {
  return take_plain_double(at, end, value);
}
inline bool take_plain(const char*& at, const char* end, float& value) {
  double number = 0;
  const bool ok = take_plain_double(at, end, number);
  value = static_cast<float>(number);
  return ok;
}
inline bool take_plain(const char*& at, const char* end, Half& value) {
  double number = 0;
  const bool ok = take_plain_double(at, end, number);
  value = Half(static_cast<float>(number));
  return ok;
}
inline bool take_plain(const char*& at, const char* end, layer::TimeCode& value) {
  return take_plain_double(at, end, value.value);
}
inline bool take_plain(const char*& at, const char* end, layer::Duration& value) {
  return take_plain_double(at, end, value.value);
}
template <class Int>
  requires(std::is_integral_v<Int> && sizeof(Int) <= 4 && !std::is_same_v<Int, bool> &&
           !std::is_same_v<Int, char>)
bool take_plain(const char*& at, const char* end, Int& value) {
  std::int64_t number = 0;
  const bool ok = take_plain_integer(at, end, number) &&
                  number >= std::numeric_limits<Int>::min() &&
                  number <= std::numeric_limits<Int>::max();
  value = static_cast<Int>(number);
  return ok;
}

/// "(" item, ... ")"; `item(i)` takes one.
template <class Item>
bool take_plain_tuple(const char*& at, const char* end, std::size_t count, Item item) {
  if (at == end || *at != '(') {
    return false;
  }
  ++at;
  skip_space(at, end);
  for (std::size_t i = 0; i < count; ++i) {
    if ((i != 0 && !take_comma(at, end)) || !item(i)) {
      return false;
    }
  }
  skip_blanks(at, end);
  if (at == end || *at != ')') {
    return false;
  }
  ++at;
  return true;
}
template <class T, std::size_t N>
bool take_plain(const char*& at, const char* end, Vec<T, N>& value) {
  return take_plain_tuple(at, end, N, [&](std::size_t i) { return take_plain(at, end, value[i]); });
}
template <class T>
bool take_plain(const char*& at, const char* end, Quat<T>& value) {
  T* const parts[] = {&value.w, &value.x, &value.y, &value.z};
  return take_plain_tuple(at, end, 4,
                          [&](std::size_t i) { return take_plain(at, end, *parts[i]); });
}
template <std::size_t N>
bool take_plain(const char*& at, const char* end, Matrix<N>& value) {
  return take_plain_tuple(at, end, N, [&](std::size_t row) {
    return take_plain_tuple(
        at, end, N, [&](std::size_t column) { return take_plain(at, end, value[row][column]); });
  });
}

template <class T>
concept PlainElement = requires(const char*& at, T& value) { take_plain(at, at, value); };

/// Takes at most `most` elements between `at` and `end`, each with the comma behind it, up to the
/// first that looks otherwise or is the last of the list. -> where it stopped. With `to_end` the
/// list goes on behind `end`.
template <PlainElement T>
const char* take_run(const char* at, const char* end, layer::NumberBuffer& elements, bool to_end,
                     std::size_t most) {
  for (std::size_t i = 0; i < most; ++i) {
    const char* next = at;
    T element{};
    if (!take_plain(next, end, element) || !take_comma(next, end)) {
      return at;
    }
    if (next == end ? !to_end : *next == ']') {
      return at;
    }
    elements.push_back(element);
    at = next;
    if (at == end) {
      return at;
    }
  }
  return at;
}

/// What taking lists of one type of elements needs to know of it.
struct PlainType {
  decltype(&take_run<float>) take_run = nullptr;
  std::size_t size = 0;   ///< of an element in memory
  bool has_rows = false;  ///< elements are tuples of tuples
};
template <class T>
constexpr PlainType kPlainType{&take_run<T>, sizeof(T), false};
template <std::size_t N>
constexpr PlainType kPlainType<Matrix<N>>{&take_run<Matrix<N>>, sizeof(Matrix<N>), true};

/// Takes the elements up to the first that looks otherwise or is the last. -> how many.
std::size_t take_plain_elements(const PlainType& type, Cursor& cursor,
                                layer::NumberBuffer& elements);

}  // namespace tenon::formats::text
