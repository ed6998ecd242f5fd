// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "tenon/bytes/byte_writer.h"
#include "tenon/bytes/integer_coding.h"
#include "tenon/formats/crate/storage_form.h"
#include "tenon/formats/crate/table_writer.h"

namespace tenon::formats::crate {

struct EncodedArray {
  std::string bytes;
  bool packed = false;
};

template <class T>
void append_packed_integers(bytes::ByteWriter& out, std::span<const T> integers) {
  const std::string packed = bytes::encode_integers<T>(integers);
  out.write(std::uint64_t{packed.size()});
  out.write_text(packed);
}

/// The numbers as integers of 32 bits; empty when one of them is none (or a negative zero).
template <class T>
std::vector<std::int32_t> as_integers(std::span<const T> array) {
  std::vector<std::int32_t> integers;
  integers.reserve(array.size());
  for (const T element : array) {
    const auto number = static_cast<double>(element);
    const bool fits = number >= std::numeric_limits<std::int32_t>::min() &&
                      number <= std::numeric_limits<std::int32_t>::max() &&
                      std::trunc(number) == number && std::signbit(number) == (number < 0);
    if (!fits) {
      return {};
    }
    integers.push_back(static_cast<std::int32_t>(number));
  }
  return integers;
}

/// Distinct elements in order of first use, and for each element which one it is.
template <class T>
struct Distinct {
  std::vector<T> table;
  std::vector<std::uint32_t> indices;  ///< empty when there are too many to gain anything

  explicit Distinct(std::span<const T> array) {
    const std::size_t most = std::min<std::size_t>(array.size() / 4, 1024);
    std::unordered_map<std::uint64_t, std::uint32_t> known;  // by bits: -0 is not 0
    indices.reserve(array.size());
    for (const T element : array) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &element, sizeof(element));
      const auto [it, added] = known.try_emplace(bits, static_cast<std::uint32_t>(table.size()));
      if (added) {
        if (table.size() == most) {
          indices.clear();
          return;
        }
        table.push_back(element);
      }
      indices.push_back(it->second);
    }
  }
};

/// False, with nothing written, when packing gains nothing.
template <class T>
bool append_packed_reals(bytes::ByteWriter& out, std::span<const T> array) {
  if (const std::vector<std::int32_t> integers = as_integers(array); !integers.empty()) {
    out.write('i');
    append_packed_integers<std::int32_t>(out, integers);
    return true;
  }
  const Distinct<T> distinct(array);
  if (distinct.indices.empty()) {
    return false;
  }
  out.write('t');
  out.write(static_cast<std::uint32_t>(distinct.table.size()));
  out.write_array(std::span<const T>(distinct.table));
  append_packed_integers<std::uint32_t>(out, distinct.indices);
  return true;
}

/// The array as array_reader.cpp reads it from version 0.7.0 on; not for empty ones.
template <class T>
EncodedArray encode_array(const layer::Array<T>& array, TableWriter& tables) {
  bytes::ByteWriter out;
  out.write(std::uint64_t{array.size()});
  bool packed = false;
  if (array.size() >= kSmallestPacked) {
    if constexpr (kIsInteger<T>) {
      append_packed_integers<T>(out, array.span());
      packed = true;
    } else if constexpr (kIsReal<T>) {
      packed = append_packed_reals<T>(out, array.span());
    }
  }
  if (packed) {
    return {out.take(), true};
  }
  if constexpr (kIsText<T>) {
    for (const T& element : array) {
      if constexpr (std::is_same_v<T, Token>) {
        out.write(tables.token(element));
      } else if constexpr (std::is_same_v<T, std::string>) {
        out.write(tables.string(element));
      } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
        out.write(tables.string(element.authored));
      } else {
        out.write(tables.string(element.text));
      }
    }
  } else {
    out.write_array(std::span<const layer::ArrayElement<T>>(array.data(), array.size()));
  }
  return {out.take(), false};
}

}  // namespace tenon::formats::crate
