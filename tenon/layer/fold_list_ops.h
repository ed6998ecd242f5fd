// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/layer/list_op.h"

namespace tenon::layer {

/// Items of `list`, each once, where it stands first.
template <class T>
std::vector<T> unique_keeping_first(const std::vector<T>& list) {
  std::vector<T> result;
  append_absent(result, list);
  return result;
}

/// The one edit that does what applying `weaker` and then `stronger` does, whatever the list below
/// them; nothing where no edit can: `added` and `ordered` look at what is there. An item of
/// `stronger` stands in one list of the result (appended wins over prepended, that over deleted),
/// so `fold(op, {})` is `op` reduced; the lists of `weaker` are taken as they are.
template <class T>
std::optional<ListOp<T>> fold(const ListOp<T>& stronger, const ListOp<T>& weaker) {
  using List = std::vector<T>;
  if (stronger.is_explicit) {
    return ListOp<T>::make_explicit(unique_keeping_first(stronger.explicit_items));
  }
  const auto is_legacy = [](const ListOp<T>& op) {
    return !op.added.empty() || !op.ordered.empty();
  };
  if (is_legacy(stronger) || is_legacy(weaker)) {
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
  result.deleted.insert(result.deleted.end(), stronger.deleted.begin(), stronger.deleted.end());
  result.deleted = unique_keeping_first(result.deleted);
  const List front = unique_keeping_first(stronger.prepended);
  List back(stronger.appended.rbegin(), stronger.appended.rend());
  back = unique_keeping_first(back);  // where it stands last
  std::reverse(back.begin(), back.end());
  for (const List* moved : {&front, static_cast<const List*>(&back)}) {
    remove_items(result.deleted, *moved);
    remove_items(result.prepended, *moved);
    remove_items(result.appended, *moved);
    List& to = moved == &front ? result.prepended : result.appended;
    to.insert(moved == &front ? to.begin() : to.end(), moved->begin(), moved->end());
  }
  return result;
}

}  // namespace tenon::layer
