// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

#include "tenon/layer/value.h"

namespace tenon::layer {

/// How the elements of an array of numbers lie in memory.
struct NumberLayout {
  std::size_t size = 0;  ///< bytes of an element; 0 where arrays of the type are no NumberArrays
  ArrayBody::Equal equal = nullptr;
};

/// Elements of one type of numbers, one behind the other, until they make an array.
class NumberBuffer {
 public:
  template <class T>
  void push_back(const T& element) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (capacity_ - size_ < sizeof(T)) {
      reserve(2 * capacity_ + 8 * sizeof(T));
    }
    std::memcpy(bytes_.get() + size_, &element, sizeof(T));
    size_ += sizeof(T);
  }
  void append(const NumberBuffer& other);
  /// Room for so many bytes.
  void reserve(std::size_t bytes);

  std::size_t size() const { return size_; }  ///< in bytes, like capacity()
  std::size_t capacity() const { return capacity_; }
  std::span<const std::byte> bytes() const { return {bytes_.get(), size_}; }
  /// What keeps the bytes; the buffer is empty then.
  std::shared_ptr<const void> take_owner();

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Arrays of numbers as bytes, for what is the same with all types of numbers.
struct NumberArrays {
  static NumberLayout layout(ValueType type);

  /// An array of `type` with a copy of `elements`.
  static Value make(ValueType type, std::span<const std::byte> elements);
  static Value make(ValueType type, NumberBuffer&& elements);
  /// The same with elements that lie, aligned, in memory that `owner` keeps alive and unchanged.
  static Value borrow(ValueType type, std::span<const std::byte> elements,
                      std::shared_ptr<const void> owner);
  /// The elements of `value`; nothing where it is no array of numbers, or its data are corrupt.
  static std::optional<std::span<const std::byte>> elements(const Value& value);

 private:
  static Value value(ValueType type, ArrayBody* body);
};

}  // namespace tenon::layer
