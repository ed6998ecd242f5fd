// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tenon/base/error.h"
#include "tenon/base/text/text_cursor.h"

namespace tenon::formats::text {

/// Line and column of a byte, 1-based; columns count bytes.
struct SourcePlace {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
};

/// A read position in the text of a layer: blanks, comments, words, and the first error.
/// Functions that return bool return false after an error was kept with `fail`.
class Cursor : public TextCursor {
 public:
  Cursor(std::string_view text, std::string_view file) : TextCursor(text), file_(file) {}

  std::string_view file() const { return file_; }

  /// Takes `c` or fails with "expected 'c' `where`".
  bool expect(char c, std::string_view where);

  /// Blanks, tabs and `/* */` comments.
  void skip_inline() {
    if (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '/')) {
      skip_inline_slowly();
    }
  }
  /// The same and comments that run to the end of the line.
  void skip_single_line();
  /// The same and ends of line.
  void skip_multi_line();
  /// What stands between two words: at least one blank or tab.
  bool accept_separator();
  /// End of line (one byte of it) or ';'.
  bool accept_statement_end();

  /// The identifier at the cursor, not taken; empty when there is none.
  std::string_view peek_identifier() const;
  /// The identifiers joined by ':' at the cursor, not taken.
  std::string_view peek_namespaced() const;
  /// Takes `word` when it begins at the cursor and ends as a word.
  bool accept_word(std::string_view word) {
    return at_ < text_.size() && text_[at_] == word[0] && accept_whole_word(word);
  }

  /// Place of a byte; cheap when asked in ascending order.
  SourcePlace place_of(std::size_t offset) const;
  SourcePlace place() const { return place_of(at_); }

  /// Keeps the first error; always false. "expected <expected>, found <what is there>".
  bool fail_expected(std::string_view expected, std::string_view fix = {});
  /// Keeps the first error at `offset`; always false.
  bool fail_at(std::size_t offset, ErrorCode code, std::string_view rule, std::string message,
               std::string_view fix = {});
  bool failed() const { return error_.has_value(); }
  /// Of the error, where there is one.
  std::size_t fault() const { return fault_; }
  ErrorCode error_code() const { return error_->code(); }
  /// The prim that the error is about, filled in by the layer reader.
  void set_prim(std::string prim) { prim_ = std::move(prim); }
  Error take_error();
  /// Describes in words the text at the cursor.
  std::string found() const;

 private:
  bool accept_whole_word(std::string_view word);
  bool skip_block_comment();
  void skip_blanks();
  void skip_inline_slowly();

  std::string_view file_;
  std::optional<Error> error_;
  std::size_t fault_ = 0;
  std::string prim_;
  mutable std::size_t counted_ = 0;     // bytes whose line ends are counted
  mutable std::size_t line_start_ = 0;  // first byte of the line of `counted_`
  mutable std::uint32_t line_ = 1;
};

}  // namespace tenon::formats::text
