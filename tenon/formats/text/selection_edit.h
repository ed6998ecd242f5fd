// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tenon::formats::text {

/// The prim whose metadata is edited: the place of its spec in the text.
struct TextPlace {
  std::uint32_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based, in bytes
};

/// The text of a layer with the variant selection `set` = `variant` on the prim at `place`; all
/// other bytes, comments included, stay. nullopt when the place is no prim of this text. The caller
/// proves the result by reading it.
std::optional<std::string> with_variant_selection(std::string_view text, TextPlace place,
                                                  std::string_view set, std::string_view variant);

}  // namespace tenon::formats::text
