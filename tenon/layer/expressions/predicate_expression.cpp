// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Calls are joined by "not", "and" and "or". A blank between two calls is an "and" that binds
// tighter than the word. Groups and "not" are taken in a loop and ordered by ExpressionBuilder, so
// nesting costs no call stack. The expression ends where no operator follows; the blanks before
// that place are given back. An argument is the first of these that fits: a number, a truth value,
// a quoted string, a string without quotes. A whole number beyond 64 bits is such a string.
#include "tenon/layer/expressions/predicate_expression.h"

#include <array>
#include <utility>

#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_number.h"

namespace tenon::layer {
namespace {

constexpr std::string_view kLogicOperators[] = {"not ", " ", " and ", " or "};

bool is_reserved(std::string_view word) {
  return word == "not" || word == "and" || word == "or" || word == "inf" || word == "true" ||
         word == "false";
}

/// Characters of strings without quotes.
bool is_plain_character(char c) {
  return ExpressionScanner::is_word_character(c) ||
         (c != '\0' && std::string_view("~!@#$%^&*-+=|\\.?/").find(c) != std::string_view::npos);
}

std::string argument_text(const Value& value) {
  if (const auto* flag = value.get<bool>()) {
    return *flag ? "1" : "0";
  }
  if (const auto* whole = value.get<std::int64_t>()) {
    return std::to_string(*whole);
  }
  if (const auto* number = value.get<double>()) {
    return layer_text(*number);
  }
  const auto* text = value.get<std::string>();
  return quoted_text(text == nullptr ? std::string_view() : *text);
}

class PredicateReader {
 public:
  PredicateReader(ExpressionScanner& scanner, PredicateExpression& result)
      : scanner_(scanner),
        result_(result),
        builder_([this](std::uint8_t op, std::int32_t left, std::int32_t right) {
          return add({op, left, right});
        }) {}

  bool read() {
    if (!factor()) {
      return false;
    }
    for (;;) {
      const std::size_t before = scanner_.offset();
      const bool spaced = scanner_.blanks();
      if (scanner_.accept_keyword("and")) {
        builder_.operation(PredicateExpression::And);
      } else if (scanner_.accept_keyword("or")) {
        builder_.operation(PredicateExpression::Or);
      } else if (builder_.is_open() && scanner_.accept(')')) {
        builder_.close();
        continue;
      } else if (spaced && at_factor()) {
        builder_.operation(PredicateExpression::ImpliedAnd);
      } else if (builder_.is_open()) {
        return scanner_.fail("expected ')' to close the group");
      } else {
        scanner_.seek(before);
        builder_.finish();
        return true;
      }
      scanner_.blanks();
      if (!factor()) {
        return scanner_.fail("expected a predicate after the operator");
      }
    }
  }

 private:
  std::int32_t add(ExpressionNode node) {
    result_.nodes.push_back(node);
    return static_cast<std::int32_t>(result_.nodes.size() - 1);
  }

  /// A call, a group or "not" in front of one.
  bool at_factor() const {
    const std::string_view word = scanner_.ascii_identifier();
    return scanner_.peek() == '(' || (!word.empty() && (!is_reserved(word) || word == "not"));
  }

  /// Opens groups and takes "not" until a call is read.
  bool factor() {
    for (;;) {
      while (scanner_.accept_keyword("not")) {
        builder_.operation(PredicateExpression::Not);
        scanner_.blanks();
      }
      if (!scanner_.accept('(')) {
        return call();
      }
      builder_.open();
      scanner_.blanks();
    }
  }

  bool call() {
    const std::string_view name = scanner_.ascii_identifier();
    if (name.empty() || is_reserved(name)) {
      return scanner_.fail("expected a predicate");
    }
    scanner_.seek(scanner_.offset() + name.size());
    PredicateCall call;
    call.function = name;
    const std::size_t after_name = scanner_.offset();
    bool ok = true;
    if (scanner_.accept(':')) {
      call.form = PredicateCall::Form::Colon;
      ok = colon_arguments(call);
    } else {
      scanner_.blanks();
      if (scanner_.accept('(')) {
        call.form = PredicateCall::Form::Parentheses;
        scanner_.blanks();
        ok = arguments(call);
      } else {
        scanner_.seek(after_name);
      }
    }
    result_.calls.push_back(std::move(call));
    builder_.operand(add({kAtom, static_cast<std::int32_t>(result_.calls.size() - 1), kNoNode}));
    return ok;
  }

  bool colon_arguments(PredicateCall& call) {
    do {
      call.arguments.emplace_back();
      if (!value(call.arguments.back().value)) {
        return false;
      }
    } while (scanner_.accept(','));
    return true;
  }

  /// Takes `name =` when it stands here.
  bool keyword(std::string& name) {
    const std::size_t start = scanner_.offset();
    const std::string_view word = scanner_.ascii_identifier();
    if (!word.empty() && !is_reserved(word)) {
      scanner_.seek(start + word.size());
      scanner_.blanks();
      if (scanner_.accept('=')) {
        scanner_.blanks();
        name = word;
        return true;
      }
    }
    scanner_.seek(start);
    return false;
  }

  /// By position first, then by keyword; an empty position counts as "".
  bool arguments(PredicateCall& call) {
    bool by_keyword = false;
    do {
      scanner_.blanks();
      PredicateArgument argument;
      const bool has_keyword = keyword(argument.keyword);
      if (by_keyword && !has_keyword) {
        return scanner_.fail("expected a keyword argument after ','");
      }
      by_keyword = has_keyword;
      if (!value(argument.value)) {
        return false;
      }
      call.arguments.push_back(std::move(argument));
      scanner_.blanks();
    } while (scanner_.accept(','));
    return scanner_.accept(')') || scanner_.fail("expected ')' to close the call");
  }

  bool digits() {
    const std::size_t start = scanner_.offset();
    while (ExpressionScanner::is_digit(scanner_.peek())) {
      scanner_.seek(scanner_.offset() + 1);
    }
    return scanner_.offset() > start;
  }

  bool value(Value& value) {
    const std::size_t start = scanner_.offset();
    const bool negative = scanner_.accept('-');
    if (scanner_.accept_keyword("inf")) {
      value = *parse_double(negative ? "-inf" : "inf");
      return true;
    }
    if (digits()) {
      return number(start, value);
    }
    scanner_.seek(start);
    for (const bool flag : {true, false}) {
      if (scanner_.accept_keyword(flag ? "true" : "false")) {
        value = flag;
        return true;
      }
    }
    const char quote = scanner_.peek();
    return quote == '"' || quote == '\'' ? quoted_string(value) : plain_string(value);
  }

  /// The digits in front are taken. A whole number that does not fit is a string.
  bool number(std::size_t start, Value& value) {
    bool whole = true;
    if (scanner_.accept('.')) {
      whole = false;
      if (!digits()) {
        return scanner_.fail("expected digits");
      }
    }
    if (scanner_.accept('e') || scanner_.accept('E')) {
      whole = false;
      if (!scanner_.accept('-')) {
        scanner_.accept('+');
      }
      if (!digits()) {
        return scanner_.fail("expected digits");
      }
    }
    const std::string_view text = scanner_.since(start);
    if (!whole) {
      value = parse_double(text).value_or(0);
      return true;
    }
    if (const auto fits = parse_int64(text)) {
      value = *fits;
      return true;
    }
    scanner_.seek(start);
    return plain_string(value);
  }

  bool plain_string(Value& value) {
    const std::size_t start = scanner_.offset();
    while (is_plain_character(scanner_.peek())) {
      scanner_.seek(scanner_.offset() + 1);
    }
    value = unescaped(scanner_.since(start));
    return true;
  }

  bool quoted_string(Value& value) {
    const char quote = scanner_.peek();
    scanner_.accept(quote);
    const std::size_t start = scanner_.offset();
    while (scanner_.peek() != quote) {
      const char c = scanner_.peek();
      if (static_cast<unsigned char>(c) < 0x20) {
        return scanner_.fail("expected the closing quote");
      }
      scanner_.accept(c);
      if (c == '\\') {
        const char escape = scanner_.peek();
        if (escape != quote && (escape == '\0' || std::string_view("\\bfnrt").find(escape) ==
                                                      std::string_view::npos)) {
          return scanner_.fail("expected an escape character after '\\'");
        }
        scanner_.accept(escape);
      }
    }
    value = unescaped(scanner_.since(start));
    scanner_.accept(quote);
    return true;
  }

  ExpressionScanner& scanner_;
  PredicateExpression& result_;
  ExpressionBuilder builder_;
};

}  // namespace

bool read_predicate(ExpressionScanner& scanner, PredicateExpression& predicate) {
  return PredicateReader(scanner, predicate).read();
}

std::string PredicateExpression::text() const {
  const auto append_call = [this](std::string& out, std::int32_t number) {
    const PredicateCall& call = calls[static_cast<std::size_t>(number)];
    out += call.function;
    if (call.form == PredicateCall::Form::Bare) {
      return;
    }
    const bool colon = call.form == PredicateCall::Form::Colon;
    out += colon ? ':' : '(';
    for (const PredicateArgument& argument : call.arguments) {
      if (&argument != &call.arguments.front()) {
        out += colon ? "," : ", ";
      }
      out += argument.keyword.empty() ? "" : argument.keyword + '=';
      out += argument_text(argument.value);
    }
    if (!colon) {
      out += ')';
    }
  };
  return expression_text(nodes, static_cast<std::int32_t>(nodes.size()) - 1, kLogicOperators,
                         append_call);
}

}  // namespace tenon::layer
