// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tenon/base/parallel.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/literals.h"
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

/// Tuples of tuples.
template <class T>
constexpr bool kHasRows = false;
template <std::size_t N>
constexpr bool kHasRows<Matrix<N>> = true;

template <class T>
concept PlainElement = requires(const char*& at, T& value) { take_plain(at, at, value); };

/// Takes at most `most` elements between `at` and `end`, each with the comma behind it, up to the
/// first that looks otherwise or is the last of the list. -> where it stopped. With `to_end` the
/// list goes on behind `end`.
template <PlainElement T>
const char* take_run(const char* at, const char* end, std::vector<T>& elements, bool to_end = false,
                     std::size_t most = ~std::size_t{0}) {
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

/// Room for as many elements as the list will have when it goes on as it began. -> how many bytes
/// it has left.
template <class T>
std::size_t reserve_rest(std::vector<T>& elements, const char* start, const char* at,
                         const char* end) {
  const void* close = std::memchr(at, ']', static_cast<std::size_t>(end - at));
  if (close == nullptr) {
    return 0;
  }
  const auto left = static_cast<std::size_t>(static_cast<const char*>(close) - at);
  const std::size_t taken = static_cast<std::size_t>(at - start) / elements.size();
  const std::size_t each = std::max<std::size_t>(taken, 2);
  elements.reserve(elements.size() + left / each + left / each / 64);
  return left;
}

/// Where an element starts in the middle of a list that goes on as it began; nullptr when there is
/// no such place.
inline const char* middle_of(const char* at, const char* close) {
  const char* middle = at + (close - at) / 2;
  const void* last =
      std::memchr(middle, *at == '(' ? ')' : ',', static_cast<std::size_t>(close - middle));
  if (last == nullptr) {
    return nullptr;
  }
  middle = static_cast<const char*>(last);
  middle += *middle == ')' ? 1 : 0;
  return take_comma(middle, close) && middle != close ? middle : nullptr;
}

/// The rest of a long list, in two halves side by side.
template <PlainElement T>
const char* take_halves(const char* at, const char* end, std::vector<T>& elements) {
  const auto* close =
      static_cast<const char*>(std::memchr(at, ']', static_cast<std::size_t>(end - at)));
  const char* const middle = close == nullptr ? nullptr : middle_of(at, close);
  if (middle == nullptr) {
    return at;
  }
  std::vector<T> more;
  more.reserve(elements.capacity() / 2);
  const char* first_end = at;
  const char* second_end = middle;
  run_both([&] { second_end = take_run(middle, end, more); },
           [&] { first_end = take_run(at, middle, elements, true); });
  if (first_end != middle) {
    return first_end;
  }
  elements.insert(elements.end(), more.begin(), more.end());
  return second_end;
}

/// Takes the elements up to the first that looks otherwise or is the last. -> how many.
template <PlainElement T>
std::size_t take_plain_elements(Cursor& cursor, std::vector<T>& elements) {
  constexpr std::size_t kEnoughToTell = 64;
  constexpr std::size_t kWorthHalving = std::size_t{1} << 20;  // bytes
  const std::string_view rest = cursor.rest();
  const char* const start = rest.data();
  const char* const end = start + rest.size();
  const std::size_t before = elements.size();
  const char* at = take_run(start, end, elements, false, kEnoughToTell);
  if (elements.size() == before + kEnoughToTell) {
    const std::size_t length = reserve_rest(elements, start, at, end);
    if (!kHasRows<T> && length >= kWorthHalving && usable_processors() > 1) {
      at = take_halves(at, end, elements);
    }
    at = take_run(at, end, elements);
  }
  cursor.advance(static_cast<std::size_t>(at - start));
  return elements.size() - before;
}

}  // namespace tenon::formats::text
