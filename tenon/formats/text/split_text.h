// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

/// Where the text of a layer can be taken up in the middle. All of this is guessed from the layout
/// of the lines; only a reader that comes here from the front can tell whether it is so.
namespace tenon::formats::text {

/// Offset of the first word of a prim in the second half that begins a line; npos when none does
/// soon enough to be of use.
std::size_t find_split(std::string_view text);

/// Offsets of the first words of the prims around the one that begins at `offset`, outermost first:
/// those on lines above with less and less indentation.
std::vector<std::size_t> prims_around(std::string_view text, std::size_t offset);

}  // namespace tenon::formats::text
