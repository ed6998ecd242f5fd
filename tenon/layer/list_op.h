// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

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
    remove(list, deleted);
    append_absent(list, added);
    if (!prepended.empty()) {
      std::vector<T> front;
      append_absent(front, prepended);
      remove(list, front);
      list.insert(list.begin(), front.begin(), front.end());
    }
    if (!appended.empty()) {
      std::vector<T> back = unique_keeping_last(appended);
      remove(list, back);
      list.insert(list.end(), back.begin(), back.end());
    }
    reorder(list, ordered);
  }

 private:
  static bool contains(const std::vector<T>& list, const T& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
  }
  static void append_absent(std::vector<T>& list, const std::vector<T>& items) {
    for (const T& item : items) {
      if (!contains(list, item)) {
        list.push_back(item);
      }
    }
  }
  static void remove(std::vector<T>& list, const std::vector<T>& items) {
    if (!items.empty()) {
      std::erase_if(list, [&](const T& item) { return contains(items, item); });
    }
  }
  static std::vector<T> unique_keeping_last(const std::vector<T>& items) {
    std::vector<T> result;
    for (auto it = items.rbegin(); it != items.rend(); ++it) {
      if (!contains(result, *it)) {
        result.push_back(*it);
      }
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

 public:
  /// Puts the items named in `order` into that order. Each takes along the unnamed items that
  /// follow it; unnamed items before the first named one stay in front.
  static void reorder(std::vector<T>& list, const std::vector<T>& order) {
    std::vector<T> keys;
    append_absent(keys, order);
    std::erase_if(keys, [&](const T& key) { return !contains(list, key); });
    if (keys.empty()) {
      return;
    }
    auto is_key = [&](const T& item) { return contains(keys, item); };
    std::vector<T> result(list.begin(), std::find_if(list.begin(), list.end(), is_key));
    for (const T& key : keys) {
      auto it = std::find(list.begin(), list.end(), key);
      do {
        result.push_back(*it);
        ++it;
      } while (it != list.end() && !is_key(*it));
    }
    list = std::move(result);
  }
};

}  // namespace tenon::layer
