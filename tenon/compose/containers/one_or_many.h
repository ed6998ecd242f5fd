// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace tenon::compose {

/// A list that mostly has one element, which then lies within it: most prims have one node and one
/// opinion, and an allocation for each would take longer than to find them out. Longer lists lie in
/// memory of their own.
template <class T>
class OneOrMany {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> &&
                sizeof(T) >= sizeof(T*) && alignof(T) >= alignof(T*));

 public:
  OneOrMany() = default;
  OneOrMany(const OneOrMany&) = delete;
  OneOrMany(OneOrMany&& other) noexcept { take(other); }
  OneOrMany& operator=(const OneOrMany&) = delete;
  OneOrMany& operator=(OneOrMany&& other) noexcept {
    if (this != &other) {
      release();
      take(other);
    }
    return *this;
  }
  ~OneOrMany() { release(); }

  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  const T* data() const { return capacity_ == 0 ? within() : many(); }
  T* data() { return const_cast<T*>(std::as_const(*this).data()); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + count_; }
  T* begin() { return data(); }
  T* end() { return data() + count_; }
  const T& operator[](std::size_t at) const { return data()[at]; }
  T& operator[](std::size_t at) { return data()[at]; }
  const T& front() const { return data()[0]; }
  T& front() { return data()[0]; }

  void push_back(const T& element) {
    const T added = element;  // it may lie in what is left behind
    if (count_ != 0 && count_ >= capacity_) {
      move_out(count_ < kFew ? kFew : 2 * std::size_t{count_});
    }
    ::new (static_cast<void*>(data() + count_)) T(added);
    ++count_;
  }
  /// Takes these elements in place of its own; they lie elsewhere.
  void assign(std::span<const T> elements) {
    clear();
    if (elements.size() > 1) {
      move_out(elements.size());
    }
    std::uninitialized_copy_n(elements.data(), elements.size(), data());
    count_ = static_cast<std::uint32_t>(elements.size());
  }
  void clear() {
    release();
    count_ = capacity_ = 0;
  }

 private:
  static constexpr std::size_t kFew = 4;

  const T* within() const { return std::launder(reinterpret_cast<const T*>(storage_)); }
  T* many() const {
    T* elements = nullptr;
    std::memcpy(&elements, storage_, sizeof(elements));  // NOLINT: the bytes of the pointer
    return elements;
  }

  void move_out(std::size_t capacity) {
    T* const elements = static_cast<T*>(::operator new(capacity * sizeof(T)));
    std::uninitialized_copy_n(data(), count_, elements);
    release();
    std::memcpy(storage_, &elements, sizeof(elements));  // NOLINT: the bytes of the pointer
    capacity_ = static_cast<std::uint32_t>(capacity);
  }
  void release() {
    if (capacity_ != 0) {
      ::operator delete(many());
    }
  }
  void take(OneOrMany& other) {
    std::memcpy(storage_, other.storage_, sizeof(storage_));
    count_ = std::exchange(other.count_, 0);
    capacity_ = std::exchange(other.capacity_, 0);
  }

  alignas(T) std::byte storage_[sizeof(T)] = {};  // the one, or where the many are
  std::uint32_t count_ = 0;
  std::uint32_t capacity_ = 0;  // 0 where they lie within
};

}  // namespace tenon::compose
