// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/formats/text/layout/source_map.h"

namespace tenon::formats::text {

/// Replacements of parts of a text, made in one go. `lines` are whole lines, each with its end.
class TextPatch {
 public:
  explicit TextPatch(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  void replace(SourceRange range, std::string by);
  void insert(std::size_t at, std::string text) { replace({at, at}, std::move(text)); }
  /// Removes a statement, with its line (and a comment at its end) when it is alone on it.
  /// `separator` may follow it.
  void remove(SourceRange statement, char separator = ';');
  /// Puts lines behind the line of a statement, or on lines of their own right behind it when more
  /// follows on its line.
  void insert_after(SourceRange statement, const std::string& lines, char separator = ';');
  /// The same behind an opening bracket at `at`; what follows it moves to a line of its own.
  void insert_inside(std::size_t bracket, const std::string& lines);

  /// The blanks in front of the line of a byte.
  std::string indent_at(std::size_t at) const;
  /// Only blanks precede a byte on its line.
  bool starts_line(std::size_t at) const;

  /// The new text; nothing when replacements overlap.
  std::optional<std::string> result();

 private:
  struct Replacement {
    SourceRange range;
    std::string by;
  };
  std::size_t line_start(std::size_t at) const;
  std::size_t skip_rest(std::size_t at, char separator) const;

  std::string_view text_;
  std::vector<Replacement> replacements_;
};

/// Canonical text (4 blanks a step) with other blanks: `base` in front of each line, `unit` for
/// each step beyond the first `steps`. Lines inside strings of several lines stay.
std::string reindented(std::string_view text, const std::string& base, const std::string& unit,
                       std::size_t steps = 0);

}  // namespace tenon::formats::text
