// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "tenon/base/assert.h"

namespace tenon::bytes {

/// Appends little-endian values to a growing string of bytes.
class ByteWriter {
 public:
  std::size_t offset() const { return out_.size(); }

  template <class T>
  void write(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&value, sizeof(T));
  }
  template <class T>
  void write_array(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(values.data(), values.size_bytes());
  }
  void write_text(std::string_view text) { out_.append(text); }

  /// Fills with zeros up to a multiple of `alignment`; the offset there.
  std::size_t align(std::size_t alignment) {
    out_.resize((out_.size() + alignment - 1) / alignment * alignment, '\0');
    return out_.size();
  }
  /// Overwrites what was written at `offset`.
  template <class T>
  void patch(std::size_t offset, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    TENON_ASSERT(offset + sizeof(T) <= out_.size());
    std::memcpy(out_.data() + offset, &value, sizeof(T));
  }

  const std::string& bytes() const { return out_; }
  std::string take() { return std::move(out_); }

 private:
  void append(const void* data, std::size_t size) {
    if (size != 0) {
      out_.append(static_cast<const char*>(data), size);
    }
  }

  std::string out_;
};

}  // namespace tenon::bytes
