// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// How wide the differences of lists of 4 and of 8 byte integers are stored.
template <std::size_t kWidth>
struct IntegerWidths;
template <>
struct IntegerWidths<4> {
  using Signed = std::int32_t;
  using Unsigned = std::uint32_t;
  using Short = std::int8_t;
  using Middle = std::int16_t;
};
template <>
struct IntegerWidths<8> {
  using Signed = std::int64_t;
  using Unsigned = std::uint64_t;
  using Short = std::int16_t;
  using Middle = std::int32_t;
};

/// The bytes of the codes of so many integers.
constexpr std::size_t integer_codes_size(std::size_t count) { return (count + 3) / 4; }

/// The integers of a packed list (see integer_coding.h), one after the other. Sums wrap around.
template <class T>
class IntegerStream {
  using W = IntegerWidths<sizeof(T)>;
  using Unsigned = typename W::Unsigned;

 public:
  /// Checks that all `count` integers are there, so that a count that is not true costs no memory
  /// beyond the unpacked codes: an Error when they are not.
  static Result<IntegerStream> open(std::span<const std::byte> compressed, std::uint64_t count);

  /// The next integer; only as often as the list has one.
  T next() {
    if (at_ == kGroup) {
      read_group(group_.data());
      at_ = 0;
    }
    return group_[at_++];
  }
  /// The next ones, as many as `out` has room for: a multiple of four, except for the last ones.
  /// `next` must not have been called before.
  void read(std::span<T> out) {
    std::size_t at = 0;
    for (; at + kGroup <= out.size(); at += kGroup) {
      read_group(out.data() + at);
    }
    for (; at < out.size(); ++at) {
      out[at] = next();
    }
  }

 private:
  static constexpr std::size_t kGroup = 4;  // integers of one byte of codes

  /// The length of the tail that one byte of codes describes.
  static constexpr std::size_t tail_of(unsigned codes) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < kGroup; ++i) {
      const unsigned code = (codes >> (2 * i)) & 3u;
      size += code == 0 ? 0 : sizeof(typename W::Short) << (code - 1);
    }
    return size;
  }
  static std::size_t tail_size(std::span<const char> codes);

  void read_group(T* out) {
    const auto codes = static_cast<unsigned char>(*codes_++);
    if (codes == 0) {
      for (std::size_t i = 0; i < kGroup; ++i) {
        out[i] = static_cast<T>(value_ += common_);
      }
      return;
    }
    for (std::size_t i = 0; i < kGroup; ++i) {
      out[i] = static_cast<T>(value_ += difference((codes >> (2 * i)) & 3u));
    }
  }
  Unsigned difference(unsigned code) {
    return code == 0   ? common_
           : code == 1 ? take<typename W::Short>()
           : code == 2 ? take<typename W::Middle>()
                       : take<typename W::Signed>();
  }
  template <class Stored>
  Unsigned take() {
    Stored stored;
    std::memcpy(&stored, tail_, sizeof(stored));
    tail_ += sizeof(stored);
    return static_cast<Unsigned>(static_cast<typename W::Signed>(stored));
  }

  std::unique_ptr<const std::string> data_;  // unpacked; its address survives a move of this object
  const char* codes_ = nullptr;
  const char* tail_ = nullptr;
  Unsigned common_ = 0;
  Unsigned value_ = 0;
  std::array<T, kGroup> group_{};
  std::size_t at_ = kGroup;
};

}  // namespace tenon::bytes
