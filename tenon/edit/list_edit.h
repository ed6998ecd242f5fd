// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

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

}  // namespace tenon::edit
