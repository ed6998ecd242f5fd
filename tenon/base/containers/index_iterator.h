// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <iterator>
#include <type_traits>

namespace tenon {

/// Goes through a list by its indices. `Reference` is what its operator[] gives: a reference, or a
/// value of its own.
template <class List, class Value, class Reference = const Value&>
class IndexIterator {
 public:
  using iterator_category = std::conditional_t<std::is_reference_v<Reference>,
                                               std::forward_iterator_tag, std::input_iterator_tag>;
  using value_type = Value;
  using difference_type = std::ptrdiff_t;
  using pointer = const Value*;
  using reference = Reference;

  IndexIterator() = default;
  IndexIterator(const List* list, std::size_t at) : list_(list), at_(at) {}
  Reference operator*() const { return (*list_)[at_]; }
  const Value* operator->() const
    requires std::is_reference_v<Reference>
  {
    return &**this;
  }
  IndexIterator& operator++() {
    ++at_;
    return *this;
  }
  IndexIterator operator++(int) { return {list_, at_++}; }
  bool operator==(const IndexIterator& other) const { return at_ == other.at_; }

 private:
  const List* list_ = nullptr;
  std::size_t at_ = 0;
};

}  // namespace tenon
