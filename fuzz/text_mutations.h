// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "fuzz/dice.h"

namespace tenon::fuzz {

/// Whose words and blocks a text has: USD's, those of XML, of JSON, of OBJ and STL.
enum class Grammar : unsigned char { Usd, Xml, Json, Mesh };

struct TextMutation {
  Grammar grammar = Grammar::Usd;
  std::string_view other;  ///< another file, of which pieces are put in
  std::size_t max_bytes = 4u << 20;
};

/// Damages the text in one to four places: bytes, words of the grammar, numbers, lines, blocks
/// moved, repeated, nested and left out, pieces of another file, the end cut off.
std::string mutate_text(std::string_view text, const TextMutation& how, Dice& dice);

/// One change to bytes: a bit, a byte, a number at a multiple of its size, a piece left out or
/// repeated.
void mutate_bytes(std::string& bytes, Dice& dice);

}  // namespace tenon::fuzz
