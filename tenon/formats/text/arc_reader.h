// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/layer_state.h"
#include "tenon/formats/text/layout/list_edit.h"
#include "tenon/formats/text/layout/statement_text.h"

namespace tenon::formats::text {

/// The parts of prim and layer metadata that lead to other prims and layers. The field's word was
/// taken, the cursor stands before '='.
bool read_references(LayerState& state, Path prim, ListEdit edit);
bool read_payload(LayerState& state, Path prim, ListEdit edit);
/// `inherits` or `specializes`, stored as `field`.
bool read_prim_paths(LayerState& state, Path prim, Token field, ListEdit edit);
bool read_sublayers(LayerState& state);
bool read_layer_relocates(LayerState& state);

/// Takes `=` and blanks around it.
bool read_assignment(Cursor& cursor);
/// None, `<path>` or `[<path>, ...]`, as written.
bool read_path_list(Cursor& cursor, std::vector<Path>& paths);
/// Fails at `start` when `items` has equal ones or edits weaker lists with nothing.
template <class T>
bool check_items(Cursor& cursor, std::size_t start, ListEdit edit, const std::vector<T>& items) {
  if (items.empty() && edit != ListEdit::Explicit) {
    return cursor.fail_at(start, ErrorCode::Parse, "text.list",
                          "an empty list can only be set, not added, prepended or deleted",
                          "remove the statement, or the word in front of it to clear the list");
  }
  return !has_duplicates(items) ||
         cursor.fail_at(offset_of_item(cursor.text(), start, first_repeated(items)),
                        ErrorCode::Parse, "text.list", "this list names one item twice",
                        "remove one of the equal items");
}

}  // namespace tenon::formats::text
