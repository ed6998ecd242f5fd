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
inline constexpr std::vector<T> layer::ListOp<T>::* kListsThatAdd[] = {
    &layer::ListOp<T>::explicit_items, &layer::ListOp<T>::prepended, &layer::ListOp<T>::appended,
    &layer::ListOp<T>::added};

template <class T>
struct ListEdit {
  enum class Kind : unsigned char { Add, Remove, Withdraw, Set, Clear };

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
  /// Takes back whatever the opinion says of one item, so that weaker ones decide. An explicit list
  /// loses it and stays.
  static ListEdit withdraw(T item) { return {Kind::Withdraw, {std::move(item)}, {}}; }
  /// The whole list, explicitly.
  static ListEdit set(std::vector<T> items) { return {Kind::Set, std::move(items), {}}; }
  /// No opinion.
  static ListEdit clear() { return {}; }
};

/// Some list of the opinion brings the item in.
template <class T>
bool adds(const layer::ListOp<T>& op, const T& item) {
  return std::any_of(std::begin(kListsThatAdd<T>), std::end(kListsThatAdd<T>), [&](auto list) {
    return std::find((op.*list).begin(), (op.*list).end(), item) != (op.*list).end();
  });
}

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

/// The semantics of OpenUSD's Add*, Remove*, Set* and Clear* functions; withdrawing is tenon's own.
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
    for (const auto list : kListsThatAdd<T>) {
      std::erase(op.*list, item);
    }
    if (edit.kind == Kind::Withdraw) {
      std::erase(op.deleted, item);
      std::erase(op.ordered, item);
      continue;
    }
    if (!op.is_explicit &&
        std::find(op.deleted.begin(), op.deleted.end(), item) == op.deleted.end()) {
      op.deleted.push_back(item);
    }
  }
}

}  // namespace tenon::edit
