// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tenon/layer/lists/list_op.h"

namespace tenon::layer {

/// Takes `items` out of what the edit does to a weaker list.
template <class T>
void remove_from_edits(ListOp<T>& op, const std::vector<T>& items) {
  remove_items(op.deleted, items);
  remove_items(op.prepended, items);
  remove_items(op.appended, items);
}

/// The one edit that does what applying `weaker` and then `stronger` does, whatever the list below
/// them; nothing where no edit can: `added` and `ordered` look at what is there. An item of
/// `stronger` is in one list of the result (appended wins over prepended, that over deleted), so
/// `fold(op, {})` is `op` reduced; the lists of `weaker` are taken as they are.
template <class T>
std::optional<ListOp<T>> fold(const ListOp<T>& stronger, const ListOp<T>& weaker) {
  using List = std::vector<T>;
  if (stronger.is_explicit) {
    return ListOp<T>::make_explicit(unique_keeping_first(stronger.explicit_items));
  }
  if (stronger.has_legacy() || weaker.has_legacy()) {
    return std::nullopt;
  }
  if (weaker.is_explicit) {
    List items = unique_keeping_first(weaker.explicit_items);
    stronger.apply_to(items);
    return ListOp<T>::make_explicit(std::move(items));
  }
  ListOp<T> result = weaker;
  remove_items(result.prepended, stronger.deleted);
  remove_items(result.appended, stronger.deleted);
  result.deleted = unique_keeping_first(result.deleted);
  append_absent(result.deleted, stronger.deleted);
  List front = unique_keeping_first(stronger.prepended);
  remove_from_edits(result, front);
  append_moved(front, result.prepended);
  result.prepended = std::move(front);
  List back = unique_keeping_last(stronger.appended);
  remove_from_edits(result, back);
  append_moved(result.appended, back);
  return result;
}

// Compiled once, in list_op.cpp.
#define TENON_DECLARE_FOLD(type) \
  extern template std::optional<ListOp<type>> fold(const ListOp<type>&, const ListOp<type>&);
TENON_LIST_ITEMS(TENON_DECLARE_FOLD)
#undef TENON_DECLARE_FOLD

}  // namespace tenon::layer
