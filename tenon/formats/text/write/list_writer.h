// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/layer/layer.h"

namespace tenon::formats::text {

/// Appends 4 blanks per step.
void append_indent(std::string& out, std::size_t indent);

/// Appends the statements of a list op field: `prepend name = [...]` and so on, one per line.
/// False when the value is no list op.
bool append_list_op(std::string& out, std::size_t indent, std::string_view name,
                    const layer::Value& value);

/// Appends ` (offset = 1; scale = 2)` unless it is the identity.
void append_offset(std::string& out, const layer::LayerOffset& offset);

/// "a" or ["a", "b"].
template <class Name>
void append_names(std::string& out, const std::vector<Name>& names);

/// Calls `write(word, items)` for the parts of a list op that have something to say, in the order
/// in which layers print them; `word` is "", "delete ", "add ", "prepend ", "append ", "reorder ".
template <class T, class Write>
void for_each_edit(const layer::ListOp<T>& op, Write write) {
  if (op.is_explicit) {
    write("", op.explicit_items);
    return;
  }
  const std::pair<const char*, const std::vector<T>*> parts[] = {{"delete ", &op.deleted},
                                                                 {"add ", &op.added},
                                                                 {"prepend ", &op.prepended},
                                                                 {"append ", &op.appended},
                                                                 {"reorder ", &op.ordered}};
  for (const auto& [word, items] : parts) {
    if (!items->empty()) {
      write(word, *items);
    }
  }
}

}  // namespace tenon::formats::text
