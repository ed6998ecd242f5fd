// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace tenon::compose {

/// A list whose one element may equal another one elsewhere, except for parts that are known
/// without it: the nodes of most prims equal those of their parent except for the path. Then the
/// list is a reference to that element, which has the size of one pointer. Otherwise it owns its
/// elements.
template <class T>
class LikeOrMany {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> &&
                alignof(T) <= alignof(std::uint64_t) && alignof(T) > 1);

 public:
  LikeOrMany() = default;
  LikeOrMany(const LikeOrMany&) = delete;
  LikeOrMany(LikeOrMany&& other) noexcept : at_(std::exchange(other.at_, nullptr)) {}
  LikeOrMany& operator=(const LikeOrMany&) = delete;
  LikeOrMany& operator=(LikeOrMany&& other) noexcept {
    std::swap(at_, other.at_);
    return *this;
  }
  ~LikeOrMany() { clear(); }

  std::size_t size() const {
    return at_ == nullptr ? 0 : is_like() ? 1 : static_cast<std::size_t>(block()->count);
  }
  bool empty() const { return at_ == nullptr; }

  /// What its one element is like; null where the elements are its own.
  const T* like() const {
    return is_like() ? std::launder(reinterpret_cast<const T*>(at_ - 1)) : nullptr;
  }
  /// The elements where they are its own.
  std::span<T> own() { return is_like() ? std::span<T>() : std::span<T>(elements(), size()); }
  std::span<const T> own() const {
    return is_like() ? std::span<const T>() : std::span<const T>(elements(), size());
  }

  /// One element, which is like this one; it lives as long as the list.
  void be_like(const T& like) {
    clear();
    at_ = reinterpret_cast<std::byte*>(const_cast<T*>(&like)) + 1;
  }
  /// Takes these elements in place of its own; they lie elsewhere.
  void assign(std::span<const T> elements) {
    clear();
    if (elements.empty()) {
      return;
    }
    at_ = static_cast<std::byte*>(::operator new(sizeof(Block) + elements.size_bytes()));
    ::new (static_cast<void*>(at_)) Block{elements.size()};
    std::uninitialized_copy_n(elements.data(), elements.size(), this->elements());
  }
  void clear() {
    if (at_ != nullptr && !is_like()) {
      ::operator delete(at_);
    }
    at_ = nullptr;
  }

 private:
  struct Block {
    std::uint64_t count = 0;  // the elements follow
  };

  // Addresses of what the element is like are odd.
  bool is_like() const { return (reinterpret_cast<std::uintptr_t>(at_) & 1u) != 0; }
  Block* block() const { return std::launder(reinterpret_cast<Block*>(at_)); }
  T* elements() const {
    return at_ == nullptr ? nullptr : std::launder(reinterpret_cast<T*>(at_ + sizeof(Block)));
  }

  std::byte* at_ = nullptr;
};

}  // namespace tenon::compose
