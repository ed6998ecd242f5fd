// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "tenon/edit/list_edit.h"
#include "tenon/layer/lists/list_op.h"

/// Applies edits of list edits to an opinion.
namespace tenon::edit {

/// Which of the lists of an opinion.
template <class T>
using ListMember = std::vector<T> layer::ListOp<T>::*;

template <class T>
inline constexpr ListMember<T> kListsThatAdd[] = {
    &layer::ListOp<T>::explicit_items, &layer::ListOp<T>::prepended, &layer::ListOp<T>::appended,
    &layer::ListOp<T>::added};

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
