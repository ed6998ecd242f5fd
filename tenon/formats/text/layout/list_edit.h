// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/formats/text/cursor.h"
#include "tenon/layer/arcs.h"
#include "tenon/layer/lists/list_op.h"
#include "tenon/layer/spec.h"

namespace tenon::formats::text {

/// The word in front of a list: none, or how its items edit weaker lists.
enum class ListEdit : unsigned char { Explicit, Add, Append, Delete, Prepend, Reorder };

/// Takes "add", "append", "delete", "prepend" or "reorder"; Explicit when none is there.
inline ListEdit accept_list_edit(Cursor& cursor) {
  constexpr std::pair<std::string_view, ListEdit> kWords[] = {{"prepend", ListEdit::Prepend},
                                                              {"append", ListEdit::Append},
                                                              {"delete", ListEdit::Delete},
                                                              {"add", ListEdit::Add},
                                                              {"reorder", ListEdit::Reorder}};
  for (const auto& [word, edit] : kWords) {
    if (cursor.accept_word(word)) {
      return edit;
    }
  }
  return ListEdit::Explicit;
}

/// Puts `items` into the part of `op` that `edit` names. An explicit list and edits exclude each
/// other: the later statement wins.
template <class T>
void set_items(layer::ListOp<T>& op, ListEdit edit, std::vector<T> items) {
  const bool is_explicit = edit == ListEdit::Explicit;
  if (op.is_explicit != is_explicit) {
    op = {};
    op.is_explicit = is_explicit;
  }
  switch (edit) {
    case ListEdit::Explicit:
      op.explicit_items = std::move(items);
      break;
    case ListEdit::Add:
      op.added = std::move(items);
      break;
    case ListEdit::Append:
      op.appended = std::move(items);
      break;
    case ListEdit::Delete:
      op.deleted = std::move(items);
      break;
    case ListEdit::Prepend:
      op.prepended = std::move(items);
      break;
    case ListEdit::Reorder:
      op.ordered = std::move(items);
      break;
  }
}

/// The same for the list op in field `name` of `spec`.
template <class T>
void set_items(layer::Spec& spec, Token name, ListEdit edit, std::vector<T> items) {
  layer::ListOp<T> op;
  if (spec.get<layer::ListOp<T>>(name) != nullptr) {
    layer::Value old = *spec.find(name);
    spec.set(name, layer::Value());  // so that nobody shares it: many statements may edit one list
    op = old.take<layer::ListOp<T>>();
  }
  set_items(op, edit, std::move(items));
  spec.set(name, layer::Value(std::move(op)));
}

template <class Arc>
bool arc_less(const Arc& a, const Arc& b) {
  if (a.asset_path != b.asset_path) {
    return a.asset_path < b.asset_path;
  }
  if (a.prim_path != b.prim_path) {
    return a.prim_path.id() < b.prim_path.id();
  }
  return std::pair(a.offset.offset, a.offset.scale) < std::pair(b.offset.offset, b.offset.scale);
}
inline bool item_less(const layer::Reference& a, const layer::Reference& b) {
  return arc_less(a, b);
}
inline bool item_less(const layer::Payload& a, const layer::Payload& b) { return arc_less(a, b); }
inline bool item_less(Path a, Path b) { return a.id() < b.id(); }
inline bool item_less(Token a, Token b) { return a.id() < b.id(); }
inline bool item_less(const std::string& a, const std::string& b) { return a < b; }
inline bool item_less(std::int64_t a, std::int64_t b) { return a < b; }

/// The number of the first item that equals one before it; of all items when none does.
template <class T>
std::size_t first_repeated(const std::vector<T>& items) {
  std::vector<std::size_t> order(items.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return item_less(items[a], items[b]); });
  std::size_t first = items.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (items[order[i - 1]] == items[order[i]]) {
      first = std::min(first, order[i]);
    }
  }
  return first;
}

/// True when two items are equal. Takes a copy to sort.
template <class T>
bool has_duplicates(std::vector<T> items) {
  if (items.size() < 2) {
    return false;
  }
  std::sort(items.begin(), items.end(), [](const T& a, const T& b) { return item_less(a, b); });
  return std::adjacent_find(items.begin(), items.end()) != items.end();
}

}  // namespace tenon::formats::text
