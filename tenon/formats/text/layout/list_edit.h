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
ListEdit accept_list_edit(Cursor& cursor);

/// The part of `op` that `edit` names.
template <class T>
std::vector<T>& items_of(layer::ListOp<T>& op, ListEdit edit) {
  switch (edit) {
    case ListEdit::Explicit:
      return op.explicit_items;
    case ListEdit::Add:
      return op.added;
    case ListEdit::Append:
      return op.appended;
    case ListEdit::Delete:
      return op.deleted;
    case ListEdit::Prepend:
      return op.prepended;
    case ListEdit::Reorder:
      break;
  }
  return op.ordered;
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
  items_of(op, edit) = std::move(items);
}

/// The list op in field `name` of `spec`, taken out of it; an empty one where there is none.
template <class T>
layer::ListOp<T> take_list_op(layer::Spec& spec, Token name) {
  if (spec.get<layer::ListOp<T>>(name) == nullptr) {
    return {};
  }
  layer::Value old = *spec.find(name);
  spec.set(name, layer::Value());  // so that nobody shares it: many statements may edit one list
  return old.take<layer::ListOp<T>>();
}

/// The same for the list op in field `name` of `spec`.
template <class T>
void set_items(layer::Spec& spec, Token name, ListEdit edit, std::vector<T> items) {
  layer::ListOp<T> op = take_list_op<T>(spec, name);
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

/// Numbers from 0 to `count` - 1 in their order by `less`; those that are alike stay as they are.
std::vector<std::size_t> sorted_numbers(std::size_t count,
                                        bool (*less)(const void* items, std::size_t, std::size_t),
                                        const void* items);

template <class T>
bool less_at(const void* items, std::size_t a, std::size_t b) {
  const auto& list = *static_cast<const std::vector<T>*>(items);
  return item_less(list[a], list[b]);
}

/// The number of the first item that equals one before it; of all items when none does.
template <class T>
std::size_t first_repeated(const std::vector<T>& items) {
  const std::vector<std::size_t> order = sorted_numbers(items.size(), &less_at<T>, &items);
  std::size_t first = items.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (items[order[i - 1]] == items[order[i]]) {
      first = std::min(first, order[i]);
    }
  }
  return first;
}

/// True when two items are equal.
template <class T>
bool has_duplicates(const std::vector<T>& items) {
  return items.size() > 1 && first_repeated(items) != items.size();
}

}  // namespace tenon::formats::text
