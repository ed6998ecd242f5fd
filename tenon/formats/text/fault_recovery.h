// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

/// Where reading can go on behind a fault, for the sake of further messages: what has a fault is
/// refused all the same.
namespace tenon::formats::text {

/// Where a statement that begins at `start` and has a fault at `fault` ends: before the end of its
/// line, ';' or `close`, the bracket that closes what is around it. Brackets within it are paired.
/// Nothing when they cannot be, or when what follows is laid out like a part of it, which leaves no
/// place from where reading is safe.
std::optional<std::size_t> end_of_faulty_statement(std::string_view text, std::size_t start,
                                                   std::size_t fault, char close);

/// Behind the '}' of a prim, variant set or variant that begins at `start`, whose words before its
/// '{' have a fault at `fault`. Nothing when the text there does not look like one.
std::optional<std::size_t> end_of_faulty_block(std::string_view text, std::size_t start,
                                               std::size_t fault);

struct Bracket {
  char sign = ' ';
  std::size_t offset = 0;
};

/// All brackets in order, except those in comments, strings, asset paths and paths. Up to a
/// comment or string that has no end.
std::vector<Bracket> brackets_of(std::string_view text);

/// Behind what is wrong at `offset`: the end of a word, number, string or path, or of one sign.
std::size_t end_of_fault(std::string_view text, std::size_t offset);

}  // namespace tenon::formats::text
