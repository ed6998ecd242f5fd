// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A parser by recursive descent, no deeper than kExpressionDepth. Items of a list are read as
// scalars and arguments of a call as bodies, which keeps lists out of lists while calls may take
// them. Number of arguments and names of functions are checked here, so that evaluation may rely on
// them. The first failure is reported, with its place.
#include "tenon/compose/expressions/variable_syntax.h"

#include <cstddef>
#include <utility>

#include "tenon/base/limits/limits.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_cursor.h"
#include "tenon/base/text/text_number.h"

namespace tenon::compose {
namespace {

using Syntax = VariableSyntax;

struct Function {
  std::string_view name;
  std::size_t fewest;
  std::size_t most;
};
constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);
constexpr Function kFunctions[] = {{"if", 2, 3},          {"and", 2, kAnyNumber},
                                   {"or", 2, kAnyNumber}, {"not", 1, 1},
                                   {"eq", 2, 2},          {"neq", 2, 2},
                                   {"lt", 2, 2},          {"leq", 2, 2},
                                   {"gt", 2, 2},          {"geq", 2, 2},
                                   {"contains", 2, 2},    {"at", 2, 2},
                                   {"len", 1, 1},         {"defined", 1, kAnyNumber}};

class Parser : private TextCursor {
 public:
  explicit Parser(std::string_view text) : TextCursor(text) {}

  Result<Syntax> parse() {
    Syntax result;
    if (!expect('`') || !body(result, 0) || !expect('`')) {
      return Error(ErrorCode::Parse, error_).with_rule("compose.variable-expression");
    }
    return result;
  }

 private:
  bool fail(const std::string& message) {
    if (error_.empty()) {
      error_ = message + " at character " + std::to_string(at_);
    }
    return false;
  }
  bool expect(char c) { return accept(c) || fail(std::string("expected '") + c + "'"); }
  void skip_blanks() {
    while (peek() == ' ') {
      ++at_;
    }
  }

  bool body(Syntax& result, std::size_t depth) {
    if (depth >= limits::kExpressionDepth) {
      return fail("too deeply nested");
    }
    if (!accept('[')) {
      return scalar(result, depth);
    }
    result.kind = Syntax::Kind::List;
    return items(result, ']', depth, &Parser::scalar);
  }

  /// What is no list; lists hold nothing else.
  bool scalar(Syntax& result, std::size_t depth) {
    if (peek() == '$' && peek(1) == '{') {
      return variable(result);
    }
    if (peek() == '"' || peek() == '\'') {
      return quoted_text(result);
    }
    if (is_digit(peek()) || (peek() == '-' && is_digit(peek(1)))) {
      return integer(result);
    }
    const std::string_view name = ascii_identifier();
    if (name == "True" || name == "true" || name == "False" || name == "false") {
      result.constant = ExpressionValue::of(name[0] == 'T' || name[0] == 't');
    } else if (name != "None" && name != "none") {
      return call(result, std::string(name), depth);
    }
    at_ += name.size();
    return true;
  }

  bool variable(Syntax& result) {
    at_ += 2;
    result.kind = Syntax::Kind::Variable;
    result.name = ascii_identifier();
    if (result.name.empty()) {
      return fail("variables must be identifiers");
    }
    at_ += result.name.size();
    return expect('}');
  }

  bool quoted_text(Syntax& result) {
    const char quote = text_[at_++];
    result.kind = Syntax::Kind::Text;
    while (peek() != quote) {
      if (at_ >= text_.size()) {
        return fail(std::string("expected ") + quote);
      }
      Syntax part;
      if (peek() == '$' && peek(1) == '{') {
        if (!variable(part)) {
          return false;
        }
      } else {
        part.constant = ExpressionValue::of(plain_text(quote));
      }
      result.parts.push_back(std::move(part));
    }
    ++at_;
    return true;
  }

  /// Up to the closing quote or a variable. A backslash takes their meaning from '`', '$' and
  /// quotes.
  std::string plain_text(char quote) {
    const std::size_t start = at_;
    while (at_ < text_.size() && peek() != quote && !(peek() == '$' && peek(1) == '{')) {
      const char next = peek(1);
      const bool escapes = next == '`' || next == '$' || next == '\\' || next == quote;
      at_ += peek() == '\\' && at_ + 1 < text_.size() && escapes ? 2 : 1;
    }
    return unescaped(since(start));
  }

  bool integer(Syntax& result) {
    const std::size_t start = at_;
    accept('-');
    while (is_digit(peek())) {
      ++at_;
    }
    const auto number = parse_int64(since(start));
    if (!number) {
      return fail("the integer " + std::string(since(start)) + " is out of range");
    }
    result.constant = ExpressionValue::of(*number);
    return true;
  }

  bool call(Syntax& result, std::string name, std::size_t depth) {
    const std::size_t start = at_;
    at_ += name.size();
    skip_blanks();
    if (name.empty() || !accept('(')) {
      at_ = start;
      return fail("unexpected expression");
    }
    result.kind = Syntax::Kind::Call;
    result.name = std::move(name);
    skip_blanks();
    if (!items(result, ')', depth, &Parser::body)) {
      return false;
    }
    skip_blanks();
    return check_arguments(result);
  }

  bool check_arguments(const Syntax& call) {
    for (const Function& function : kFunctions) {
      if (function.name == call.name) {
        const bool fits =
            call.parts.size() >= function.fewest && call.parts.size() <= function.most;
        return fits || fail("the function '" + call.name + "' does not take " +
                            std::to_string(call.parts.size()) + " arguments");
      }
    }
    return fail("there is no function '" + call.name + "'");
  }

  /// Items with commas between them, up to `end`. Lists have no blanks inside their brackets.
  bool items(Syntax& result, char end, std::size_t depth,
             bool (Parser::*item)(Syntax&, std::size_t)) {
    std::size_t before_blanks = at_;
    skip_blanks();
    if (accept(end)) {
      return true;
    }
    at_ = end == ']' ? before_blanks : at_;
    do {
      if (!result.parts.empty()) {
        skip_blanks();
      }
      if (!(this->*item)(result.parts.emplace_back(), depth + 1)) {
        return false;
      }
      before_blanks = at_;
      skip_blanks();
    } while (accept(','));
    at_ = end == ']' ? before_blanks : at_;
    return expect(end);
  }

  std::string error_;
};

}  // namespace

Result<VariableSyntax> parse_variable_expression(std::string_view text) {
  return Parser(text).parse();
}

}  // namespace tenon::compose
