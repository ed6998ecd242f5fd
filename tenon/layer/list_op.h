// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/layer/item_set.h"

namespace tenon::layer {

/// An authored edit of a list: either the whole list, or what to do to the weaker one.
/// Core Spec 1.0.1 section on list editing.
template <class T>
struct ListOp {
  bool is_explicit = false;
  std::vector<T> explicit_items;
  std::vector<T> prepended;
  std::vector<T> appended;
  std::vector<T> deleted;
  std::vector<T> added;    ///< legacy: appended where absent
  std::vector<T> ordered;  ///< legacy: reorders what is there

  static ListOp make_explicit(std::vector<T> items) {
    ListOp op;
    op.is_explicit = true;
    op.explicit_items = std::move(items);
    return op;
  }
  static ListOp make_prepended(std::vector<T> items) {
    ListOp op;
    op.prepended = std::move(items);
    return op;
  }

  bool operator==(const ListOp&) const = default;

  /// True when nothing is authored; an explicit empty list is something.
  bool empty() const {
    return !is_explicit && prepended.empty() && appended.empty() && deleted.empty() &&
           added.empty() && ordered.empty();
  }

  /// Applies this edit to `list`, the result of all weaker opinions.
  void apply_to(std::vector<T>& list) const {
    if (is_explicit) {
      list.clear();
      append_absent(list, explicit_items);
      return;
    }
    remove_items(list, deleted);
    append_absent(list, added);
    if (!prepended.empty()) {
      std::vector<T> front;
      append_absent(front, prepended);
      remove_items(list, front);
      list.insert(list.begin(), front.begin(), front.end());
    }
    if (!appended.empty()) {
      std::vector<T> back = unique_keeping_last(appended);
      remove_items(list, back);
      list.insert(list.end(), back.begin(), back.end());
    }
    reorder(list, ordered);
  }

 private:
  static std::vector<T> unique_keeping_last(const std::vector<T>& items) {
    std::vector<T> backwards;
    append_absent(backwards, std::vector<T>(items.rbegin(), items.rend()));
    return {backwards.rbegin(), backwards.rend()};
  }

 public:
  /// Puts the items named in `order` into that order. Each takes along the unnamed items that
  /// follow it; unnamed items before the first named one stay in front.
  static void reorder(std::vector<T>& list, const std::vector<T>& order) {
    if (order.empty()) {
      return;
    }
    const ItemPositions<T> positions(list);
    std::vector<T> keys;
    append_absent(keys, order);
    std::erase_if(keys, [&](const T& key) { return !positions.contains(key); });
    if (keys.empty()) {
      return;
    }
    const ItemPositions<T> named(keys);
    auto is_key = [&](const T& item) { return named.contains(item); };
    auto first = list.begin();
    while (!is_key(*first)) {  // one of the keys is in the list
      ++first;
    }
    std::vector<T> result(list.begin(), first);
    for (const T& key : keys) {
      std::size_t at = positions.find(key);
      do {
        result.push_back(list[at]);
        ++at;
      } while (at < list.size() && !is_key(list[at]));
    }
    list = std::move(result);
  }
};

}  // namespace tenon::layer
