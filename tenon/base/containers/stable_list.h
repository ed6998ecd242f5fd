// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tenon/base/containers/index_iterator.h"

namespace tenon {

/// A list whose elements stay where they are while it grows. Its rows have a power of two of
/// places, so that the place of an index costs a shift, which std::deque needs a division for.
template <class T>
class StableList {
 public:
  static constexpr std::size_t kRow = 16;

  using Iterator = IndexIterator<StableList, T>;

  StableList() = default;
  StableList(const StableList& other) {
    for (const T& element : other) {
      emplace_back() = element;
    }
  }
  StableList(StableList&& other) noexcept
      : rows_(std::move(other.rows_)), size_(std::exchange(other.size_, 0)) {
    other.rows_.clear();
  }
  StableList& operator=(StableList other) noexcept {
    std::swap(rows_, other.rows_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~StableList() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t at) const { return rows_[at / kRow][at % kRow]; }
  T& operator[](std::size_t at) { return rows_[at / kRow][at % kRow]; }
  const T& back() const { return (*this)[size_ - 1]; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size_}; }
  /// What lies in a row from `at` on, up to `end`.
  std::span<const T> row(std::size_t at, std::size_t end) const {
    const std::size_t left = kRow - at % kRow;
    return {&(*this)[at], at + left < end ? left : end - at};
  }

  T& emplace_back() {
    if (size_ == rows_.size() * kRow) {
      rows_.push_back(std::make_unique<T[]>(kRow));
    }
    return (*this)[size_++];
  }
  void pop_back() { (*this)[--size_] = T(); }

  /// Takes over what `other` has, which stays where it is. The index of the first of it; between
  /// that and what was there before may be elements that are as they were made.
  std::size_t take_rows(StableList&& other) {
    const std::size_t first = other.empty() ? size_ : rows_.size() * kRow;
    for (std::unique_ptr<T[]>& row : other.rows_) {
      rows_.push_back(std::move(row));
    }
    size_ = first + std::exchange(other.size_, 0);
    other.rows_.clear();
    return first;
  }

 private:
  std::vector<std::unique_ptr<T[]>> rows_;
  std::size_t size_ = 0;
};

}  // namespace tenon
