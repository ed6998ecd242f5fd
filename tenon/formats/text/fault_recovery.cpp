// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A wrong guess about where a faulty statement ends would make false messages out of sound text. So
// an end counts only when all signs agree: brackets pair, a closing bracket that begins a line is
// indented like the line of its partner, and what follows is not laid out like a part of the
// statement. Any doubt gives no end. The walk knows comments, strings, asset paths, paths and
// words, and nothing else of the grammar. A string or path that has to close on its line and does
// not is taken to end with it, since the fault may be that very quote.
#include "tenon/formats/text/fault_recovery.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tenon/formats/text/text_scanner.h"

namespace tenon::formats::text {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

bool starts(std::string_view text, std::size_t at, std::string_view with) {
  return text.substr(at, with.size()) == with;
}

std::size_t line_end(std::string_view text, std::size_t at) {
  return std::min(text.find_first_of("\r\n", at), text.size());
}

/// Behind a string at `at` whose line ends at `line_end`; kNone for one that is not closed where it
/// has to be.
std::size_t after_string(std::string_view text, std::size_t at, std::size_t line_end) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool triple = starts(text, at, three);
  const std::size_t end = triple ? text.size() : line_end;
  for (std::size_t i = at + (triple ? 3 : 1); i < end; ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (triple ? starts(text, i, three) : text[i] == quote) {
      return i + (triple ? 3 : 1);
    }
  }
  return kNone;
}

/// Behind what `mark` opens and closes on a line that ends at `line_end`; kNone when it is not
/// closed there.
std::size_t after_mark(std::string_view text, std::size_t at, std::size_t line_end,
                       std::string_view mark) {
  const std::size_t close = text.substr(0, line_end).find(mark, at + 1);
  return close == kNone ? kNone : close + mark.size();
}

/// The line of a place that only moves on. Each byte of the text is looked at once, however many
/// places there are on a line.
class Line {
 public:
  explicit Line(std::string_view text) : text_(text) {}

  std::size_t end_at(std::size_t at) {
    move_to(at);
    return end_;
  }
  /// How many blanks the line of `at` begins with.
  std::size_t indentation_at(std::size_t at) {
    move_to(at);
    return word_ - begin_;
  }
  /// Nothing but blanks stands before `at` on its line.
  bool begins_at(std::size_t at) {
    move_to(at);
    return word_ == at;
  }

 private:
  void move_to(std::size_t at) {
    if (known_ && at <= end_) {
      return;
    }
    const std::size_t from = known_ ? end_ : 0;
    const std::size_t last = text_.substr(from, at - from).find_last_of("\r\n");
    begin_ = last == kNone ? begin_ : from + last + 1;
    end_ = line_end(text_, at);
    word_ = std::min(text_.find_first_not_of(" \t", begin_), text_.size());
    known_ = true;
  }

  std::string_view text_;
  std::size_t begin_ = 0;
  std::size_t word_ = 0;
  std::size_t end_ = 0;
  bool known_ = false;
};

/// Walks over text that is wrong somewhere, one token after the other.
class Walk : public TextCursor {
 public:
  Walk(std::string_view text, std::size_t at) : TextCursor(text, at), line_(text) {}

  /// A comment or string has no end: nothing behind it can be told.
  bool is_lost() const { return lost_; }

  /// Past one blank, end of line, comment, string, asset path, path, word or sign; its first sign,
  /// ' ' for a comment.
  char next() {
    const char c = text_[at_];
    if (c == '#' || starts(text_, at_, "//")) {
      at_ = line_.end_at(at_);
      return ' ';
    }
    if (starts(text_, at_, "/*")) {
      const std::size_t close = text_.find("*/", at_ + 2);
      lost_ = close == kNone;
      at_ = lost_ ? text_.size() : close + 2;
      return ' ';
    }
    std::size_t end = at_ + 1;
    if (c == '"' || c == '\'') {
      end = after_string(text_, at_, line_.end_at(at_));
      lost_ = end == kNone && starts(text_, at_, std::string(3, c));
    } else if (c == '@') {
      const std::size_t close = line_.end_at(at_);
      end = starts(text_, at_, "@@@") ? after_mark(text_, at_ + 2, close, "@@@")
                                      : after_mark(text_, at_, close, "@");
    } else if (c == '<') {
      end = after_mark(text_, at_, line_.end_at(at_), ">");
    } else if (Scanner::is_word(c)) {
      while (end < text_.size() && Scanner::is_word(text_[end])) {
        ++end;
      }
    }
    // What is not closed on its line reaches up to the end of it.
    at_ = end == kNone ? line_.end_at(at_) : end;
    return c;
  }

 private:
  Line line_;
  bool lost_ = false;
};

/// How far the line of a byte is indented; kNone when something stands between.
std::size_t indentation_before(std::string_view text, std::size_t at) {
  const std::size_t begin = text.substr(0, at).find_last_of("\r\n") + 1;
  const std::size_t word = text.find_first_not_of(" \t", begin);
  return word == at ? at - begin : kNone;
}

/// Brackets that are open, innermost last.
class Brackets {
 public:
  enum class Met { Nothing, Outer, Wrong };

  explicit Brackets(std::string_view text) : text_(text), line_(text) {}

  /// A bracket that begins a line is aligned with the line of its partner: where it does not, one
  /// of them is missing.
  Met meet(char c, std::size_t at) {
    if (c == '(' || c == '[' || c == '{') {
      open_.push_back({c, line_.indentation_at(at)});
      return Met::Nothing;
    }
    if (c != ')' && c != ']' && c != '}') {
      return Met::Nothing;
    }
    if (open_.empty()) {
      return Met::Outer;
    }
    const char partner = c == ')' ? '(' : c == ']' ? '[' : '{';
    const Open last = open_.back();
    open_.pop_back();
    const bool fits = !line_.begins_at(at) || line_.indentation_at(at) == last.indentation;
    return last.sign == partner && fits ? Met::Nothing : Met::Wrong;
  }
  bool empty() const { return open_.empty(); }

 private:
  struct Open {
    char sign;
    std::size_t indentation;
  };

  std::string_view text_;
  Line line_;
  std::vector<Open> open_;
};

/// The word at `at` begins a prim or closes a block.
bool begins_or_ends_block(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && Scanner::is_word(text[end])) {
    ++end;
  }
  const std::string_view word = text.substr(at, end - at);
  return word == "def" || word == "over" || word == "class" || word == "variantSet" ||
         starts(text, at, "}");
}

/// The first byte from `at` on that is neither blank nor in a comment; with `same_line` the end of
/// the line at the latest.
std::size_t next_token(std::string_view text, std::size_t at, bool same_line) {
  Walk walk(text, at);
  while (!walk.at_end()) {
    const std::size_t before = walk.offset();
    const char c = text[before];
    const bool is_comment = c == '#' || starts(text, before, "//") || starts(text, before, "/*");
    const bool is_end = c == '\n' || c == '\r';
    if (!is_comment && c != ' ' && c != '\t' && (same_line || !is_end)) {
      return before;
    }
    walk.next();
  }
  return text.size();
}

/// A statement may begin or a block end here.
bool may_go_on(std::string_view text, std::size_t at) {
  return at >= text.size() || Scanner::is_word(text[at]) ||
         std::string_view("\"'})").find(text[at]) != kNone;
}

/// The bracket at `at` ends what is around the statement, and nothing that looks like more of the
/// statement follows it.
bool ends_outside(std::string_view text, std::size_t at, char close) {
  if (text[at] != close) {
    return false;
  }
  const std::size_t after = next_token(text, at + 1, true);
  return after >= text.size() || std::string_view("\r\n}{").find(text[after]) != kNone;
}

/// Nothing but a '}' follows on the line.
bool ends_line(std::string_view text, std::size_t at) {
  const std::size_t after = next_token(text, at, true);
  return after >= text.size() || std::string_view("\r\n}").find(text[after]) != kNone;
}

/// What follows the end of a line or ';' at `at` is not laid out like a part of the statement.
bool is_followed_by_another(std::string_view text, std::size_t start, std::size_t at) {
  const std::size_t next = next_token(text, at + 1, false);
  const std::size_t own = indentation_before(text, start);
  const std::size_t indentation = indentation_before(text, std::min(next, text.size()));
  const bool is_known = next < text.size() && own != kNone && indentation != kNone;
  const bool closes = next < text.size() && (text[next] == '}' || text[next] == ')');
  const bool fits = !is_known || (closes ? indentation <= own : indentation == own);
  return fits && may_go_on(text, next);
}

/// A bracket that is at fault is closed on its line.
bool closes_on_line(std::string_view text, std::size_t at) {
  const char c = text[at];
  const char partner = c == '(' ? ')' : c == '[' ? ']' : c == '{' ? '}' : ' ';
  return partner == ' ' || text.substr(at, line_end(text, at) - at).find(partner) != kNone;
}

}  // namespace

std::optional<std::size_t> end_of_faulty_statement(std::string_view text, std::size_t start,
                                                   std::size_t fault, char close) {
  if (fault >= text.size() || text[fault] == ';' || !closes_on_line(text, fault)) {
    return std::nullopt;
  }
  Walk walk(text, start);
  Brackets brackets(text);
  while (!walk.at_end()) {
    const std::size_t at = walk.offset();
    const char c = walk.next();
    const Brackets::Met met = brackets.meet(c, at);
    if (walk.is_lost() || met == Brackets::Met::Wrong) {
      return std::nullopt;
    }
    const bool ends = (c == '\n' || c == '\r' || c == ';') && brackets.empty() && at >= fault;
    if (met == Brackets::Met::Outer || ends) {
      const bool is_safe = ends ? is_followed_by_another(text, start, at)
                                : at >= fault && ends_outside(text, at, close);
      return is_safe ? std::optional(at) : std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> end_of_faulty_block(std::string_view text, std::size_t start,
                                               std::size_t fault) {
  Walk walk(text, start);
  Brackets brackets(text);
  bool is_open = false;
  bool at_line_start = false;
  while (!walk.at_end()) {
    const std::size_t at = walk.offset();
    // The words in front of '{' hold no other prim.
    if (!is_open && brackets.empty() && at_line_start && begins_or_ends_block(text, at)) {
      return std::nullopt;
    }
    const char c = walk.next();
    at_line_start = c == '\n' || c == '\r' || (at_line_start && (c == ' ' || c == '\t'));
    is_open = is_open || (c == '{' && brackets.empty());
    const Brackets::Met met = brackets.meet(c, at);
    if (walk.is_lost() || met != Brackets::Met::Nothing) {
      return std::nullopt;
    }
    if (is_open && brackets.empty()) {
      return walk.offset() > fault && ends_line(text, walk.offset()) ? std::optional(walk.offset())
                                                                     : std::nullopt;
    }
  }
  return std::nullopt;
}

std::vector<Bracket> brackets_of(std::string_view text) {
  std::vector<Bracket> found;
  Walk walk(text, 0);
  while (!walk.at_end()) {
    const std::size_t at = walk.offset();
    const char c = walk.next();
    if (!walk.is_lost() && std::string_view("(){}[]").find(c) != kNone) {
      found.push_back({c, at});
    }
  }
  return found;
}

std::size_t end_of_fault(std::string_view text, std::size_t offset) {
  if (offset >= text.size() || text[offset] == '\n' || text[offset] == '\r') {
    return std::min(offset, text.size());
  }
  const char c = text[offset];
  if (c == '#' || c == '/') {
    return offset + 1;
  }
  if (c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9')) {
    const std::size_t end = text.find_first_of(" \t\r\n;,()[]{}#=", offset + 1);
    return std::min(end, text.size());
  }
  Walk walk(text, offset);
  walk.next();
  return walk.offset();
}

}  // namespace tenon::formats::text
