// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Closing brackets that a text layer has too many of, as when it was pasted from pages.
namespace tenon::formats::text {

/// Offsets, ascending, of closing brackets without which `text` can be read as a layer. Of several
/// ways it is the one after which the fewest paths in the text lead nowhere, then the one that
/// changes the fewest places, then the one that comes last in the text. Empty where the text has no
/// closing bracket too many, where no way is found with a bounded amount of work, and for texts of
/// more than 1 MiB.
std::vector<std::size_t> stray_brackets(std::string_view text);

/// "remove the '}' at lines 62 and 63": the advice that takes away the brackets at `offsets`. A
/// line that holds several of them is named with the column.
std::string removal_advice(std::string_view text, const std::vector<std::size_t>& offsets);

}  // namespace tenon::formats::text
