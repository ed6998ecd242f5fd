// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/layer/lists/item_set.h"

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

  /// Legacy edits do what depends on the weaker list.
  bool has_legacy() const { return !added.empty() || !ordered.empty(); }

  /// Applies this edit to `list`, the result of all weaker opinions.
  void apply_to(std::vector<T>& list) const;

  /// This without legacy edits: items to be added are appended and orders dropped, as OpenUSD does.
  ListOp without_legacy() const;

  /// Puts the items named in `order` into that order. Each takes along the unnamed items that
  /// follow it; unnamed items before the first named one stay in front.
  static void reorder(std::vector<T>& list, const std::vector<T>& order);
};

/// The places of a list as `ListOp::reorder` puts them. `ranks` says for each item where the order,
/// of `order_size` items, names it first, or ItemPositions::kNone.
std::vector<std::size_t> reordered(const std::vector<std::size_t>& ranks, std::size_t order_size);

template <class T>
void ListOp<T>::apply_to(std::vector<T>& list) const {
  if (is_explicit) {
    list.clear();
    append_absent(list, explicit_items);
    return;
  }
  remove_items(list, deleted);
  append_absent(list, added);
  if (!prepended.empty()) {
    std::vector<T> front = unique_keeping_first(prepended);
    remove_items(list, front);
    append_moved(front, list);
    list = std::move(front);
  }
  if (!appended.empty()) {
    std::vector<T> back = unique_keeping_last(appended);
    remove_items(list, back);
    append_moved(list, back);
  }
  reorder(list, ordered);
}

template <class T>
ListOp<T> ListOp<T>::without_legacy() const {
  ListOp result = *this;
  remove_items(result.added, appended);
  append_moved(result.appended, result.added);
  result.added.clear();
  result.ordered.clear();
  return result;
}

template <class T>
void ListOp<T>::reorder(std::vector<T>& list, const std::vector<T>& order) {
  if (order.empty()) {
    return;
  }
  const ItemPositions<T> named(order);
  std::vector<std::size_t> ranks;
  for (const T& item : list) {
    ranks.push_back(named.find(item));
  }
  std::vector<T> result;
  for (const std::size_t at : reordered(ranks, order.size())) {
    result.push_back(std::move(list[at]));
  }
  list = std::move(result);
}

struct Payload;
struct Reference;

/// Items of the list edits that apply to lists; edits of unregistered values do not.
#define TENON_LIST_ITEMS(X) \
  X(Token)                  \
  X(std::string)            \
  X(Path) X(Reference) X(Payload) X(std::int32_t) X(std::int64_t) X(std::uint32_t) X(std::uint64_t)

// Compiled once, in list_op.cpp.
#define TENON_DECLARE_LIST_OP(type) extern template struct ListOp<type>;
TENON_LIST_ITEMS(TENON_DECLARE_LIST_OP)
#undef TENON_DECLARE_LIST_OP

}  // namespace tenon::layer
