// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/list_edit.h"

#include <numeric>

namespace tenon::formats::text {

ListEdit accept_list_edit(Cursor& cursor) {
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

std::vector<std::size_t> sorted_numbers(std::size_t count,
                                        bool (*less)(const void* items, std::size_t, std::size_t),
                                        const void* items) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return less(items, a, b); });
  return order;
}

}  // namespace tenon::formats::text
