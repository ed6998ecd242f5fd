// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/paths/path_numbers.h"

namespace tenon {

/// Small values by path: no allocation for each of them, and those of paths that are added one
/// after another lie side by side. They stay where they are until more is added.
template <class Item>
class PathTable {
 public:
  std::size_t size() const { return rows_.size(); }

  /// What is there for `path`; nullptr for nothing, and for the empty path.
  const Item* find(Path path) const {
    const std::uint32_t number = numbers_.find(path, path_of());
    return number == 0 ? nullptr : &rows_[number - 1].item;
  }
  Item* find(Path path) { return const_cast<Item*>(std::as_const(*this).find(path)); }

  /// The same, made where there is nothing yet. The empty path has no place.
  Item& operator[](Path path) {
    const auto next = static_cast<std::uint32_t>(rows_.size() + 1);
    const std::uint32_t number = numbers_.find_or_put(path, next, path_of());
    if (number == next) {
      rows_.push_back({path, {}});
    }
    return rows_[number - 1].item;
  }

 private:
  struct Row {
    Path path;
    Item item{};
  };

  auto path_of() const {
    return [this](std::uint32_t number) { return rows_[number - 1].path; };
  }

  std::vector<Row> rows_;
  PathNumbers numbers_;
};

}  // namespace tenon
