// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Expressions: `${VAR}`, text with `${VAR}` in it, numbers, True, False, None, lists and function
// calls. Evaluated while parsed; after the first error the rest counts for nothing.
#include "tenon/compose/variable_expression.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <vector>

#include "tenon/base/limits.h"
#include "tenon/base/text_number.h"
#include "tenon/layer/field_values.h"

namespace tenon::compose {
namespace {

enum class Kind { None, Bool, Int, Text, List };

struct ExpressionValue {
  Kind kind = Kind::None;
  bool flag = false;
  std::int64_t number = 0;
  std::string text = {};
  std::vector<ExpressionValue> items = {};  // none of them a list

  bool operator==(const ExpressionValue&) const = default;
};

ExpressionValue none() { return {}; }
ExpressionValue of_bool(bool flag) { return {Kind::Bool, flag}; }
ExpressionValue of_int(std::int64_t number) { return {Kind::Int, false, number}; }
ExpressionValue of_text(std::string text) { return {Kind::Text, false, 0, std::move(text)}; }

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

class Parser {
 public:
  Parser(std::string_view text, const layer::Dictionary& variables, std::size_t variable_depth)
      : text_(text), variables_(variables), variable_depth_(variable_depth) {}

  ExpressionValue parse() {
    ExpressionValue result = value(0);
    skip_space();
    if (at_ != text_.size()) {
      fail("unexpected text at '" + std::string(text_.substr(at_)) + "'");
    }
    return result;
  }
  const std::string& error() const { return error_; }

 private:
  void fail(std::string message) {
    if (error_.empty()) {
      error_ = std::move(message);
    }
    at_ = text_.size();
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    }
  }
  bool take(char c) {
    skip_space();
    if (at_ < text_.size() && text_[at_] == c) {
      ++at_;
      return true;
    }
    return false;
  }
  void expect(char c) {
    if (!take(c)) {
      fail(std::string("expected '") + c + "'");
    }
  }
  std::string word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name_character(text_[at_])) {
      ++at_;
    }
    return std::string(text_.substr(start, at_ - start));
  }

  ExpressionValue value(std::size_t depth) {
    skip_space();
    if (depth > limits::kExpressionDepth || at_ >= text_.size()) {
      fail(at_ >= text_.size() ? "unexpected end" : "too deeply nested");
      return none();
    }
    const char c = text_[at_];
    if (c == '"' || c == '\'') {
      return of_text(quoted_text());
    }
    if (c == '$') {
      return variable(variable_name());
    }
    if (c == '[') {
      return list(depth);
    }
    if (c == '-' || std::isdigit(static_cast<unsigned char>(c)) != 0) {
      return number();
    }
    const std::string name = word();
    if (name.empty()) {
      fail(std::string("unexpected '") + c + "'");
      return none();
    }
    return take('(') ? call(name, depth) : constant(name);
  }

  ExpressionValue constant(const std::string& name) {
    if (name == "True" || name == "true") {
      return of_bool(true);
    }
    if (name == "False" || name == "false") {
      return of_bool(false);
    }
    if (name != "None" && name != "none") {
      fail("unknown word '" + name + "'");
    }
    return none();
  }

  ExpressionValue number() {
    const std::size_t start = at_;
    ++at_;
    word();
    const auto parsed = parse_int64(text_.substr(start, at_ - start));
    if (!parsed) {
      fail("no integer: '" + std::string(text_.substr(start, at_ - start)) + "'");
    }
    return of_int(parsed.value_or(0));
  }

  std::string variable_name() {
    ++at_;
    if (at_ >= text_.size() || text_[at_] != '{') {
      fail("expected '{' after '$'");
      return {};
    }
    ++at_;
    std::string name = word();
    if (at_ >= text_.size() || text_[at_] != '}' || name.empty()) {
      fail("expected a variable name and '}'");
      return {};
    }
    ++at_;
    return name;
  }

  std::string quoted_text() {
    const char quote = text_[at_++];
    std::string result;
    while (at_ < text_.size() && text_[at_] != quote) {
      const char c = text_[at_];
      if (c == '\\' && at_ + 1 < text_.size()) {
        result += text_[at_ + 1];
        at_ += 2;
      } else if (c == '$' && at_ + 1 < text_.size() && text_[at_ + 1] == '{') {
        result += substituted(variable_name());
      } else {
        result += c;
        ++at_;
      }
    }
    if (at_ >= text_.size()) {
      fail("missing closing quote");
      return {};
    }
    ++at_;
    return result;
  }

  /// A variable within text must be text, or nothing; an unknown one stays as it is written.
  std::string substituted(const std::string& name) {
    if (error_.empty() && variables_.find(name) == nullptr) {
      return "${" + name + "}";
    }
    const ExpressionValue found = variable(name);
    if (found.kind != Kind::Text && found.kind != Kind::None) {
      fail("variable '" + name + "' is no string");
    }
    return found.text;
  }

  /// Text variables may be expressions themselves.
  ExpressionValue variable(const std::string& name) {
    const layer::Value* value = variables_.find(name);
    if (value == nullptr || !error_.empty()) {
      fail("no value for variable '" + name + "'");
      return none();
    }
    const auto* text = value->get<std::string>();
    if (text == nullptr || !is_variable_expression(*text)) {
      return converted(*value, name);
    }
    if (variable_depth_ >= limits::kExpressionDepth) {
      fail("variable '" + name + "' leads back to itself");
      return none();
    }
    Parser inner(std::string_view(*text).substr(1, text->size() - 2), variables_,
                 variable_depth_ + 1);
    ExpressionValue result = inner.parse();
    if (!inner.error().empty()) {
      fail(inner.error() + " (in variable '" + name + "')");
    }
    return result;
  }

  ExpressionValue converted(const layer::Value& value, const std::string& name) {
    if (const auto* text = value.get<std::string>()) {
      return of_text(*text);
    }
    if (const auto* flag = value.get<bool>()) {
      return of_bool(*flag);
    }
    if (const auto* small = value.get<std::int32_t>()) {
      return of_int(*small);
    }
    if (const auto* big = value.get<std::int64_t>()) {
      return of_int(*big);
    }
    ExpressionValue list;
    list.kind = Kind::List;
    if (const auto* texts = value.get<layer::Array<std::string>>()) {
      for (const std::string& text : *texts) {
        list.items.push_back(of_text(text));
      }
      return list;
    }
    if (const auto* numbers = value.get<layer::Array<std::int64_t>>()) {
      for (const std::int64_t number : *numbers) {
        list.items.push_back(of_int(number));
      }
      return list;
    }
    fail("variable '" + name + "' has a type that expressions do not know");
    return none();
  }

  ExpressionValue list(std::size_t depth) {
    ++at_;
    ExpressionValue result;
    result.kind = Kind::List;
    if (take(']')) {
      return result;
    }
    do {
      result.items.push_back(value(depth + 1));
      if (result.items.back().kind == Kind::List) {
        fail("lists cannot hold lists");
      }
    } while (error_.empty() && take(','));
    expect(']');
    return result;
  }

  ExpressionValue call(const std::string& name, std::size_t depth) {
    if (name == "defined") {
      return defined();
    }
    std::vector<ExpressionValue> arguments;
    if (!take(')')) {
      do {
        arguments.push_back(value(depth + 1));
      } while (error_.empty() && take(','));
      expect(')');
    }
    return error_.empty() ? apply(name, arguments) : none();
  }

  ExpressionValue defined() {
    bool all = true;
    do {
      skip_space();
      std::string name;
      if (at_ < text_.size() && (text_[at_] == '"' || text_[at_] == '\'')) {
        name = quoted_text();
      } else {
        name = word();
      }
      all = all && variables_.find(name) != nullptr;
    } while (error_.empty() && take(','));
    expect(')');
    return of_bool(all);
  }

  bool as_bool(const ExpressionValue& value) {
    if (value.kind != Kind::Bool) {
      fail("expected a boolean");
    }
    return value.flag;
  }

  ExpressionValue apply(const std::string& name, const std::vector<ExpressionValue>& arguments) {
    if (name == "if" && (arguments.size() == 2 || arguments.size() == 3)) {
      if (as_bool(arguments[0])) {
        return arguments[1];
      }
      return arguments.size() == 3 ? arguments[2] : none();
    }
    if ((name == "and" || name == "or") && arguments.size() >= 2) {
      return logic(name == "and", arguments);
    }
    if (name == "not" && arguments.size() == 1) {
      return of_bool(!as_bool(arguments[0]));
    }
    if (name == "len" && arguments.size() == 1) {
      return length(arguments[0]);
    }
    if (arguments.size() == 2 && (name == "contains" || name == "at")) {
      return name == "at" ? element(arguments[0], arguments[1])
                          : contains(arguments[0], arguments[1]);
    }
    if (arguments.size() == 2) {
      if (const std::optional<bool> result = compare(name, arguments[0], arguments[1])) {
        return of_bool(*result);
      }
    }
    fail("no function '" + name + "' with " + std::to_string(arguments.size()) + " arguments");
    return none();
  }

  ExpressionValue logic(bool all, const std::vector<ExpressionValue>& arguments) {
    bool result = all;
    for (const ExpressionValue& argument : arguments) {
      const bool flag = as_bool(argument);
      result = all ? result && flag : result || flag;
    }
    return of_bool(result);
  }

  std::optional<bool> compare(const std::string& name, const ExpressionValue& a,
                              const ExpressionValue& b) {
    const bool ordered = name == "lt" || name == "leq" || name == "gt" || name == "geq";
    if (!ordered && name != "eq" && name != "neq") {
      return std::nullopt;
    }
    if (a.kind != b.kind && a.kind != Kind::List && b.kind != Kind::List) {
      fail("cannot compare values of different types");
    } else if (ordered && a.kind != Kind::Int && a.kind != Kind::Text) {
      fail("only numbers and strings have an order");
    }
    if (!error_.empty() || !ordered) {
      return (a == b) == (name == "eq");
    }
    const bool less = a.kind == Kind::Int ? a.number < b.number : a.text < b.text;
    const bool equal = a == b;
    if (name == "lt" || name == "geq") {
      return less == (name == "lt");
    }
    return (less || equal) == (name == "leq");
  }

  ExpressionValue length(const ExpressionValue& value) {
    if (value.kind != Kind::List && value.kind != Kind::Text) {
      fail("only lists and strings have a length");
    }
    const std::size_t size = value.kind == Kind::List ? value.items.size() : value.text.size();
    return of_int(static_cast<std::int64_t>(size));
  }

  ExpressionValue contains(const ExpressionValue& where, const ExpressionValue& what) {
    if (where.kind == Kind::List) {
      return of_bool(std::find(where.items.begin(), where.items.end(), what) !=
                     where.items.end());
    }
    if (where.kind != Kind::Text || what.kind != Kind::Text) {
      fail("'contains' looks for an item in a list or for text in text");
    }
    return of_bool(where.text.find(what.text) != std::string::npos);
  }

  ExpressionValue element(const ExpressionValue& where, const ExpressionValue& index) {
    const std::int64_t size = length(where).number;
    const std::int64_t at = index.number < 0 ? index.number + size : index.number;
    if (index.kind != Kind::Int || at < 0 || at >= size) {
      fail("'at' takes a list or text and an index within it");
      return none();
    }
    const auto position = static_cast<std::size_t>(at);
    return where.kind == Kind::List ? where.items[position]
                                    : of_text(std::string(1, where.text[position]));
  }

  std::string_view text_;
  const layer::Dictionary& variables_;
  std::size_t variable_depth_;
  std::size_t at_ = 0;
  std::string error_;
};

}  // namespace

bool is_variable_expression(std::string_view text) {
  return text.size() > 2 && text.front() == '`' && text.back() == '`';
}

ExpressionResult evaluate_text(std::string_view expression, const layer::Dictionary& variables) {
  ExpressionResult result;
  Parser parser(expression.substr(1, expression.size() - 2), variables, 0);
  const ExpressionValue value = parser.parse();
  result.errors = parser.error();
  if (!result.errors.empty() || value.kind == Kind::None) {
    return result;
  }
  if (value.kind != Kind::Text) {
    result.errors = "the expression does not give a string";
    return result;
  }
  result.text = value.text;
  return result;
}

}  // namespace tenon::compose
