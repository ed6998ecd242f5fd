// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tenon::formats::text {

/// True for the words that the grammar keeps for itself: they name no type, no metadata field and
/// no bare value. Core Spec 1.0.1 section 16.2; the list is OpenUSD 26.11's.
bool is_reserved_word(std::string_view word);

/// True for the names of units of measure that `displayUnit` takes.
bool is_unit_name(std::string_view word);

}  // namespace tenon::formats::text
