// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tenon::fuzz {

/// The input of a target, taken from the front piece by piece; zeros when none are left.
class TakenBytes {
 public:
  TakenBytes(const std::uint8_t* data, std::size_t size)
      : left_(reinterpret_cast<const char*>(data), size) {}

  bool empty() const { return left_.empty(); }
  std::string_view rest() const { return left_; }

  template <class T>
  T take() {
    T value{};
    const std::size_t size = left_.size() < sizeof(T) ? left_.size() : sizeof(T);
    std::memcpy(&value, left_.data(), size);
    left_.remove_prefix(size);
    return value;
  }
  /// A number below `limit`.
  unsigned below(unsigned limit) { return take<std::uint8_t>() % limit; }

  /// What stands before the next `separator`, which is taken too.
  std::string_view until(char separator) {
    const std::size_t end = left_.find(separator);
    const std::string_view head = left_.substr(0, end);
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end + 1);
    return head;
  }

 private:
  std::string_view left_;
};

}  // namespace tenon::fuzz
