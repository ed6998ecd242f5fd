// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Only the first error is kept. Readers return false all the way up, so what an outer reader adds
// about the same fault is lost, and the innermost message reaches the user. Lines are counted only
// when a caller asks for a place, and from the last place on: places in ascending order cost one
// scan of the text.
#include "tenon/formats/text/cursor.h"

#include <bit>
#include <cstring>

#include "tenon/base/text/unicode.h"
#include "tenon/formats/text/fault_recovery.h"

namespace tenon::formats::text {

bool Cursor::skip_block_comment() {
  const std::size_t close = text_.find("*/", at_ + 2);
  if (close == std::string_view::npos) {
    return fail_at(at_, ErrorCode::Parse, "text.syntax", "this comment is never closed",
                   "add '*/' where the comment ends");
  }
  at_ = close + 2;
  return true;
}

// Lines are indented by many blanks: eight at a time.
void Cursor::skip_blanks() {
  constexpr std::uint64_t kBlanks = 0x2020202020202020u;
  if constexpr (std::endian::native == std::endian::little) {
    std::uint64_t bytes = 0;
    while (text_.size() - at_ >= sizeof bytes) {
      std::memcpy(&bytes, text_.data() + at_, sizeof bytes);
      if (bytes != kBlanks) {
        at_ += static_cast<std::size_t>(std::countr_zero(bytes ^ kBlanks)) / 8;
        return;
      }
      at_ += sizeof bytes;
    }
  }
  while (at_ < text_.size() && text_[at_] == ' ') {
    ++at_;
  }
}

void Cursor::skip_inline_slowly() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == ' ' || c == '\t') {
      ++at_;
    } else if (c != '/' || peek(1) != '*' || !skip_block_comment()) {
      return;
    }
  }
}

void Cursor::skip_single_line() {
  while (true) {
    skip_inline();
    const char c = peek();
    if (at_end() || failed() || !(c == '#' || (c == '/' && peek(1) == '/'))) {
      return;
    }
    while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') {
      ++at_;
    }
  }
}

void Cursor::skip_multi_line() {
  while (true) {
    skip_blanks();
    while (at_ < text_.size() &&
           (text_[at_] == '\n' || text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r')) {
      ++at_;
      skip_blanks();
    }
    const std::size_t start = at_;
    if (at_ < text_.size() && (text_[at_] == '#' || text_[at_] == '/')) {
      skip_single_line();
    }
    if (at_ == start || failed()) {
      return;
    }
  }
}

bool Cursor::accept_separator() {
  const std::size_t start = at_;
  bool blank = false;
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == ' ' || c == '\t') {
      blank = true;
      ++at_;
    } else if (c != '/' || peek(1) != '*' || !skip_block_comment()) {
      break;
    }
  }
  if (!blank) {
    at_ = start;
  }
  return blank;
}

bool Cursor::accept_statement_end() {
  const char c = peek();
  if (!at_end() && (c == '\n' || c == '\r' || c == ';')) {
    ++at_;
    return true;
  }
  return false;
}

bool Cursor::expect(char c, std::string_view where) {
  if (accept(c)) {
    return true;
  }
  return fail_expected(std::string("'") + c + "' " + std::string(where));
}

std::string_view Cursor::peek_identifier() const {
  return text_.substr(at_, unicode::identifier_length(rest()));
}

std::string_view Cursor::peek_namespaced() const {
  std::size_t length = unicode::identifier_length(rest());
  while (length != 0 && peek(length) == ':') {
    const std::size_t more = unicode::identifier_length(text_.substr(at_ + length + 1));
    if (more == 0) {
      break;
    }
    length += 1 + more;
  }
  return text_.substr(at_, length);
}

bool Cursor::accept_whole_word(std::string_view word) {
  if (!starts_with(word) || peek_identifier() != word) {
    return false;
  }
  at_ += word.size();
  return true;
}

SourcePlace Cursor::place_of(std::size_t offset) const {
  if (offset < counted_) {
    counted_ = 0;
    line_start_ = 0;
    line_ = 1;
  }
  while (counted_ < offset) {
    const void* end = std::memchr(text_.data() + counted_, '\n', offset - counted_);
    if (end == nullptr) {
      counted_ = offset;
      break;
    }
    counted_ = static_cast<std::size_t>(static_cast<const char*>(end) - text_.data()) + 1;
    line_start_ = counted_;
    ++line_;
  }
  return {line_, static_cast<std::uint32_t>(offset - line_start_ + 1)};
}

std::string Cursor::found() const {
  if (at_end()) {
    return "the end of the file";
  }
  const char c = peek();
  if (c == '\n' || c == '\r') {
    return "the end of the line";
  }
  if (c == '"') {
    return "a string";
  }
  if (c == '@') {
    return "an asset path";
  }
  const std::string_view word = peek_namespaced();
  if (!word.empty()) {
    return "`" + std::string(word.substr(0, 60)) + "`";
  }
  if (c >= '0' && c <= '9') {
    return "a number";
  }
  const std::size_t length = unicode::decode(rest()).length;
  return "'" + std::string(text_.substr(at_, length == 0 ? 1 : length)) + "'";
}

bool Cursor::fail_expected(std::string_view expected, std::string_view fix) {
  return fail_at(at_, ErrorCode::Parse, "text.syntax",
                 "expected " + std::string(expected) + ", found " + found(), fix);
}

bool Cursor::fail_at(std::size_t offset, ErrorCode code, std::string_view rule, std::string message,
                     std::string_view fix) {
  if (!error_) {
    const SourcePlace place = place_of(offset);
    Diagnostic diagnostic;
    diagnostic.severity = Severity::Error;
    diagnostic.rule = rule;
    diagnostic.message = std::move(message);
    diagnostic.file = file_;
    diagnostic.line = place.line;
    diagnostic.column = place.column;
    const SourcePlace end = place_of(end_of_fault(text_, offset));
    diagnostic.end_line = end.line;
    diagnostic.end_column = end.column;
    diagnostic.fix = fix;
    error_.emplace(code, std::move(diagnostic));
    fault_ = offset;
  }
  return false;
}

Error Cursor::take_error() {
  Error error = *std::move(error_);
  error_.reset();
  return prim_.empty() ? std::move(error) : std::move(error).with_prim(prim_);
}

}  // namespace tenon::formats::text
