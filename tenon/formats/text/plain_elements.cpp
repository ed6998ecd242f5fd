// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/plain_elements.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "tenon/base/parallel.h"

namespace tenon::formats::text {
namespace {

constexpr std::size_t kNoEnd = ~std::size_t{0};

/// Room for as many elements as the list will have when it goes on as it began. -> how many bytes
/// it has left.
std::size_t reserve_rest(std::size_t element_size, layer::NumberBuffer& elements, const char* start,
                         const char* at, const char* end) {
  const void* close = std::memchr(at, ']', static_cast<std::size_t>(end - at));
  if (close == nullptr) {
    return 0;
  }
  const auto left = static_cast<std::size_t>(static_cast<const char*>(close) - at);
  const std::size_t count = elements.size() / element_size;
  const std::size_t taken = static_cast<std::size_t>(at - start) / count;
  const std::size_t each = std::max<std::size_t>(taken, 2);
  elements.reserve((count + left / each + left / each / 64) * element_size);
  return left;
}

/// Where an element starts in the middle of a list that goes on as it began; nullptr when there is
/// no such place.
const char* middle_of(const char* at, const char* close) {
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
const char* take_halves(const PlainType& type, const char* at, const char* end,
                        layer::NumberBuffer& elements) {
  const auto* close =
      static_cast<const char*>(std::memchr(at, ']', static_cast<std::size_t>(end - at)));
  const char* const middle = close == nullptr ? nullptr : middle_of(at, close);
  if (middle == nullptr) {
    return at;
  }
  layer::NumberBuffer more;
  more.reserve(elements.capacity() / 2);
  const char* first_end = at;
  const char* second_end = middle;
  run_both([&] { second_end = type.take_run(middle, end, more, false, kNoEnd); },
           [&] { first_end = type.take_run(at, middle, elements, true, kNoEnd); });
  if (first_end != middle) {
    return first_end;
  }
  elements.append(more);
  return second_end;
}

}  // namespace

std::size_t take_plain_elements(const PlainType& type, Cursor& cursor,
                                layer::NumberBuffer& elements) {
  constexpr std::size_t kEnoughToTell = 64;
  constexpr std::size_t kWorthHalving = std::size_t{1} << 20;  // bytes
  const std::string_view rest = cursor.rest();
  const char* const start = rest.data();
  const char* const end = start + rest.size();
  const char* at = type.take_run(start, end, elements, false, kEnoughToTell);
  if (elements.size() == kEnoughToTell * type.size) {
    const std::size_t length = reserve_rest(type.size, elements, start, at, end);
    if (!type.has_rows && length >= kWorthHalving && usable_processors() > 1) {
      at = take_halves(type, at, end, elements);
    }
    at = type.take_run(at, end, elements, false, kNoEnd);
  }
  cursor.advance(static_cast<std::size_t>(at - start));
  return elements.size() / type.size;
}

}  // namespace tenon::formats::text
