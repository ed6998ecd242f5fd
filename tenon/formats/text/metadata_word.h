// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "tenon/layer/fields.h"

namespace tenon::formats::text {

/// The field that a statement in parentheses is about, by the word in front of its '='.
inline Token field_of_word(std::string_view word, bool of_layer) {
  namespace fields = layer::fields;
  if (word == "relocates") {
    return of_layer ? fields::layerRelocates : fields::relocates;
  }
  const std::array<std::pair<std::string_view, Token>, 4> renamed = {{
      {"doc", fields::documentation},
      {"inherits", fields::inheritPaths},
      {"variants", fields::variantSelection},
      {"variantSets", fields::variantSetNames},
  }};
  for (const auto& [written, field] : renamed) {
    if (word == written) {
      return field;
    }
  }
  return Token(word);
}

/// The words that say how a list edits weaker ones.
inline bool is_list_edit(std::string_view word) {
  return word == "prepend" || word == "append" || word == "delete" || word == "add" ||
         word == "reorder";
}

}  // namespace tenon::formats::text
