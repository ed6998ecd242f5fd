// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// The error of every read that leaves its bytes: ErrorCode::Corrupt, with the offset.
Error out_of_bounds(std::uint64_t offset, std::uint64_t wanted, std::uint64_t size);

/// A cursor over little-endian bytes that never leaves them: every read that would is an Error.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> span() const { return bytes_; }
  std::size_t offset() const { return offset_; }
  std::size_t size() const { return bytes_.size(); }
  std::size_t remaining() const { return bytes_.size() - offset_; }

  /// Moves to `offset` from the start; the end itself is allowed.
  Result<void> seek(std::uint64_t offset) {
    if (offset > bytes_.size()) {
      return out_of_bounds(offset, 0, bytes_.size());
    }
    offset_ = static_cast<std::size_t>(offset);
    return {};
  }

  template <class T>
  Result<T> read() {
    static_assert(std::is_trivially_copyable_v<T>);
    if (sizeof(T) > remaining()) {
      return out_of_bounds(offset_, sizeof(T), bytes_.size());
    }
    T value;
    std::memcpy(static_cast<void*>(&value), bytes_.data() + offset_, sizeof(T));
    offset_ += sizeof(T);
    return value;
  }

  /// The next `size` bytes themselves.
  Result<std::span<const std::byte>> take(std::uint64_t size) {
    if (size > remaining()) {
      return out_of_bounds(offset_, size, bytes_.size());
    }
    const auto taken = bytes_.subspan(offset_, static_cast<std::size_t>(size));
    offset_ += static_cast<std::size_t>(size);
    return taken;
  }

  /// `count` values; nothing is allocated when they are not there.
  template <class T>
  Result<std::vector<T>> read_array(std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > remaining() / sizeof(T)) {
      return out_of_bounds(offset_, count, bytes_.size());
    }
    std::vector<T> values(static_cast<std::size_t>(count));
    if (count != 0) {
      std::memcpy(static_cast<void*>(values.data()), bytes_.data() + offset_,
                  values.size() * sizeof(T));
    }
    offset_ += values.size() * sizeof(T);
    return values;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t offset_ = 0;
};

}  // namespace tenon::bytes
