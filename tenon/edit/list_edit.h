// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tenon/layer/list_op.h"

/// Edits of list edits: what is added to or taken from the opinion of one layer.
namespace tenon::edit {

enum class ListPosition : unsigned char {
  FrontOfPrependList,
  BackOfPrependList,
  FrontOfAppendList,
  BackOfAppendList,
};

template <class T>
struct ListEdit {
  enum class Kind : unsigned char { Add, Remove, Set, Clear };

  Kind kind = Kind::Clear;
  std::vector<T> items;
  ListPosition position = ListPosition::BackOfPrependList;

  /// Puts one item into the prepend or append list, or moves it there; into the explicit list
  /// where the opinion is one.
  static ListEdit add(T item, ListPosition position = ListPosition::BackOfPrependList) {
    return {Kind::Add, {std::move(item)}, position};
  }
  /// Takes one item out of the lists, and deletes it from weaker ones.
  static ListEdit remove(T item) { return {Kind::Remove, {std::move(item)}, {}}; }
  /// The whole list, explicitly.
  static ListEdit set(std::vector<T> items) { return {Kind::Set, std::move(items), {}}; }
  /// No opinion.
  static ListEdit clear() { return {}; }
};

namespace detail {

template <class T>
void insert(std::vector<T>& list, const T& item, bool front) {
  const auto at = std::find(list.begin(), list.end(), item);
  if (at != list.end()) {
    list.erase(at);
  }
  list.insert(front ? list.begin() : list.end(), item);
}

}  // namespace detail

/// The semantics of OpenUSD's Add*, Remove*, Set* and Clear* functions.
template <class T>
void apply(const ListEdit<T>& edit, layer::ListOp<T>& op) {
  using Kind = typename ListEdit<T>::Kind;
  if (edit.kind == Kind::Clear || edit.kind == Kind::Set) {
    op =
        edit.kind == Kind::Clear ? layer::ListOp<T>{} : layer::ListOp<T>::make_explicit(edit.items);
    return;
  }
  for (const T& item : edit.items) {
    if (edit.kind == Kind::Add) {
      const bool front = edit.position == ListPosition::FrontOfPrependList ||
                         edit.position == ListPosition::FrontOfAppendList;
      const bool prepend = edit.position == ListPosition::FrontOfPrependList ||
                           edit.position == ListPosition::BackOfPrependList;
      detail::insert(op.is_explicit ? op.explicit_items
                     : prepend      ? op.prepended
                                    : op.appended,
                     item, front);
      continue;
    }
    for (std::vector<T>* list : {&op.explicit_items, &op.added, &op.prepended, &op.appended}) {
      std::erase(*list, item);
    }
    if (!op.is_explicit &&
        std::find(op.deleted.begin(), op.deleted.end(), item) == op.deleted.end()) {
      op.deleted.push_back(item);
    }
  }
}

}  // namespace tenon::edit
