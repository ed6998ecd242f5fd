// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>

namespace tenon {

/// A list for the duration of a function: up to `kWithin` elements are inline, more are in memory
/// of their own. Walks over paths and over composed prims take a few steps, and many are taken for
/// each prim: an allocation for each would be most of their cost.
template <class T, std::size_t kWithin>
class ShortList {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  ShortList() {}  // NOLINT(modernize-use-equals-default): numbers within are not set to zero
  explicit ShortList(T first) { push_back(first); }
  ShortList(const ShortList&) = delete;
  ShortList& operator=(const ShortList&) = delete;
  ShortList(ShortList&& other) noexcept { take(other); }
  ShortList& operator=(ShortList&& other) noexcept {
    if (this != &other) {
      take(other);
    }
    return *this;
  }
  ~ShortList() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* data() const { return apart_ == nullptr ? within_ : apart_.get(); }
  T* data() { return apart_ == nullptr ? within_ : apart_.get(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  auto rbegin() const { return std::reverse_iterator<const T*>(end()); }
  auto rend() const { return std::reverse_iterator<const T*>(begin()); }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T& operator[](std::size_t at) const { return data()[at]; }
  T& operator[](std::size_t at) { return data()[at]; }
  T& back() { return data()[size_ - 1]; }

  void push_back(T element) {
    if (size_ == capacity_) {
      grow(2 * size_);
    }
    data()[size_++] = element;
  }
  void pop_back() { --size_; }
  /// Takes so many equal elements in place of its own.
  void assign(std::size_t count, T element) {
    size_ = 0;
    resize(count, element);
  }
  /// Removes elements at the end, or appends copies of `element`.
  void resize(std::size_t count, T element) {
    if (count > capacity_) {
      grow(std::max(count, 2 * size_));
    }
    if (count > size_) {
      std::fill_n(data() + size_, count - size_, element);
    }
    size_ = count;
  }
  /// Removes the elements for which `is_out` is true.
  template <class Predicate>
  void erase_if(const Predicate& is_out) {
    size_ = static_cast<std::size_t>(std::remove_if(begin(), end(), is_out) - begin());
  }

 private:
  void grow(std::size_t capacity) {
    std::unique_ptr<T[]> more(new T[capacity]);
    std::copy_n(data(), size_, more.get());
    apart_ = std::move(more);
    capacity_ = capacity;
  }
  void take(ShortList& other) {
    apart_ = std::move(other.apart_);
    size_ = std::exchange(other.size_, 0);
    capacity_ = std::exchange(other.capacity_, kWithin);
    if (apart_ == nullptr) {
      std::copy_n(other.within_, size_, within_);
    }
  }

  std::size_t size_ = 0;
  std::size_t capacity_ = kWithin;
  std::unique_ptr<T[]> apart_;
  T within_[kWithin];
};

}  // namespace tenon
