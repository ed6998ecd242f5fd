// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The parsed expression is evaluated from the leaves up; a result is a value or a list of errors. A
// variable may hold an expression itself. The names that are open form a stack, which finds
// circles, and depth, number of evaluations, and what variables give in characters and items are
// bounded, since n variables that each use the next one twice make a text 2^n times as long. `and`
// and `or` end at the argument that decides; `if` evaluates both values to compare their types.
#include "tenon/compose/expressions/variable_expression.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "tenon/base/limits/limits.h"
#include "tenon/compose/expressions/variable_syntax.h"
#include "tenon/layer/field_values.h"

namespace tenon::compose {
namespace {

using Kind = ExpressionValue::Kind;
using Errors = std::vector<std::string>;

struct Evaluated {
  ExpressionValue value;
  Errors errors;
  bool ok() const { return errors.empty(); }
};

Evaluated failed(std::string message) { return {{}, {std::move(message)}}; }

template <class T>
Evaluated given(T value) {
  return {ExpressionValue::of(std::move(value)), {}};
}

const char* kind_name(const ExpressionValue& value) {
  constexpr const char* kNames[] = {"None", "bool", "int", "string", "list"};
  return kNames[static_cast<std::size_t>(value.kind)];
}

/// True when there were errors.
bool move_errors(Errors& to, Evaluated& from) {
  to.insert(to.end(), std::make_move_iterator(from.errors.begin()),
            std::make_move_iterator(from.errors.end()));
  return !from.ok();
}

template <class T>
bool list_of(const layer::Value& value, Kind element, ExpressionValue& result) {
  const auto* array = value.get<layer::Array<T>>();
  if (array == nullptr) {
    return false;
  }
  result.kind = Kind::List;
  result.element = element;
  for (const auto& item : *array) {
    if constexpr (std::is_same_v<T, std::string>) {
      result.items.push_back(ExpressionValue::of(item));
    } else if constexpr (std::is_same_v<T, bool>) {
      result.items.push_back(ExpressionValue::of(item != 0));
    } else {
      result.items.push_back(ExpressionValue::of(std::int64_t{item}));
    }
  }
  return true;
}

/// The value of a variable; false for types that expressions do not know.
bool convert(const layer::Value& value, ExpressionValue& result) {
  if (const auto* text = value.get<std::string>()) {
    result = ExpressionValue::of(*text);
  } else if (const auto* flag = value.get<bool>()) {
    result = ExpressionValue::of(*flag);
  } else if (const auto* small = value.get<std::int32_t>()) {
    result = ExpressionValue::of(std::int64_t{*small});
  } else if (const auto* big = value.get<std::int64_t>()) {
    result = ExpressionValue::of(*big);
  } else {
    return list_of<std::string>(value, Kind::Text, result) ||
           list_of<bool>(value, Kind::Bool, result) ||
           list_of<std::int32_t>(value, Kind::Int, result) ||
           list_of<std::int64_t>(value, Kind::Int, result);
  }
  return true;
}

class Evaluator {
 public:
  Evaluator(const layer::Dictionary& variables, std::set<std::string>& used)
      : variables_(variables), used_(used) {}

  // Nested no deeper than the parser allows, times the variables within variables.
  Evaluated evaluate(const VariableSyntax& syntax) {
    Evaluated result = evaluate_kind(syntax);
    if (!result.ok()) {
      result.value = {};
    }
    return result;
  }

 private:
  Evaluated evaluate_kind(const VariableSyntax& syntax) {
    switch (syntax.kind) {
      case VariableSyntax::Kind::Constant:
        return {syntax.constant, {}};
      case VariableSyntax::Kind::Variable: {
        bool found = false;
        Evaluated result = variable(syntax.name, found);
        return found ? result : failed("no value for variable '" + syntax.name + "'");
      }
      case VariableSyntax::Kind::Text:
        return text(syntax);
      case VariableSyntax::Kind::List:
        return list(syntax);
      case VariableSyntax::Kind::Call:
        break;
    }
    return call(syntax);
  }

  Evaluated variable(const std::string& name, bool& found) {
    found = true;
    if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
      return failed("variable '" + name + "' leads back to itself");
    }
    used_.insert(name);
    const layer::Value* value = variables_.find(name);
    if (value == nullptr) {
      found = false;
      return {};
    }
    Evaluated result;
    if (work_ > limits::kExpressionWork) {
      return too_much();
    }
    if (!convert(*value, result.value)) {
      return failed("variable '" + name + "' has a type that expressions do not know");
    }
    if (is_expression(result.value)) {
      result = nested(name, result.value.text);
    }
    work_ += result.value.text.size() + result.value.items.size();
    return work_ > limits::kExpressionWork ? too_much() : result;
  }

  static Evaluated too_much() {
    return failed("the variables make more than " + std::to_string(limits::kExpressionWork) +
                  " characters and items");
  }

  static bool is_expression(const ExpressionValue& value) {
    return value.kind == Kind::Text && is_variable_expression(value.text);
  }

  Evaluated nested(const std::string& name, const std::string& expression) {
    if (open_.size() >= limits::kExpressionDepth || ++evaluations_ > limits::kExpressionVariables) {
      return failed("variable '" + name + "' leads through too many others");
    }
    const Result<VariableSyntax> syntax = parse_variable_expression(expression);
    if (!syntax) {
      return failed(syntax.error().message() + " (in variable '" + name + "')");
    }
    open_.push_back(name);
    Evaluated result = evaluate(*syntax);
    open_.pop_back();
    return result;
  }

  /// A variable without a value stays as it is written, for those who come later.
  Evaluated text(const VariableSyntax& syntax) {
    std::string result;
    for (const VariableSyntax& part : syntax.parts) {
      if (part.kind == VariableSyntax::Kind::Constant) {
        result += part.constant.text;
        continue;
      }
      bool found = false;
      Evaluated value = variable(part.name, found);
      if (!value.ok()) {
        return value;
      }
      if (!found) {
        result += "${" + part.name + "}";
      } else if (value.value.kind == Kind::Text) {
        result += value.value.text;
      } else if (value.value.kind != Kind::None) {
        return failed("variable '" + part.name + "' within text must be a string, not " +
                      kind_name(value.value));
      }
    }
    return given(std::move(result));
  }

  Evaluated list(const VariableSyntax& syntax) {
    Evaluated result;
    result.value.kind = Kind::List;
    for (const VariableSyntax& part : syntax.parts) {
      Evaluated item = evaluate(part);
      if (move_errors(result.errors, item)) {
        continue;
      }
      const Kind kind = item.value.kind;
      const Kind element = result.value.element;
      if (kind == Kind::None || kind == Kind::List || (element != Kind::None && element != kind)) {
        result.errors.push_back(std::string("a list cannot hold this value of type ") +
                                kind_name(item.value));
        continue;
      }
      result.value.element = kind;
      result.value.items.push_back(std::move(item.value));
    }
    return result;
  }

  Evaluated call(const VariableSyntax& syntax) {
    const std::string& name = syntax.name;
    if (name == "and" || name == "or") {
      return logic(syntax, name == "or");
    }
    if (name == "if") {
      return choose(syntax);
    }
    std::vector<Evaluated> arguments;
    for (const VariableSyntax& part : syntax.parts) {
      arguments.push_back(evaluate(part));
    }
    Evaluated all;
    for (Evaluated& argument : arguments) {
      move_errors(all.errors, argument);
    }
    if (!all.ok() && name != "defined") {
      return all;
    }
    if (name == "defined") {
      return defined(arguments, std::move(all.errors));
    }
    const ExpressionValue& first = arguments[0].value;
    if (name == "not") {
      return first.kind == Kind::Bool
                 ? given(!first.flag)
                 : failed(std::string("not: invalid type ") + kind_name(first));
    }
    if (name == "len") {
      return length(first);
    }
    const ExpressionValue& second = arguments[1].value;
    return name == "contains" ? contains(first, second)
           : name == "at"     ? element(first, second)
                              : compare(name, first, second);
  }

  /// Ends at the first argument that decides.
  Evaluated logic(const VariableSyntax& syntax, bool deciding) {
    Evaluated result = given(!deciding);
    for (const VariableSyntax& part : syntax.parts) {
      Evaluated argument = evaluate(part);
      if (move_errors(result.errors, argument)) {
        continue;
      }
      if (argument.value.kind != Kind::Bool) {
        result.errors.push_back(syntax.name + ": invalid type " + kind_name(argument.value));
      } else if (argument.value.flag == deciding) {
        result.value = argument.value;
        break;
      }
    }
    return result;
  }

  /// Both values are evaluated: they must be of one type, or None.
  Evaluated choose(const VariableSyntax& syntax) {
    Evaluated condition = evaluate(syntax.parts[0]);
    if (!condition.ok()) {
      return condition;
    }
    if (condition.value.kind != Kind::Bool) {
      return failed("if: the condition must be a boolean");
    }
    Evaluated one = evaluate(syntax.parts[1]);
    Evaluated other = syntax.parts.size() == 3 ? evaluate(syntax.parts[2]) : Evaluated();
    if (one.value.kind != Kind::None && other.value.kind != Kind::None &&
        !one.value.same_type(other.value)) {
      return failed("if: the two values must be of one type, or None");
    }
    return condition.value.flag ? one : other;
  }

  Evaluated defined(const std::vector<Evaluated>& arguments, Errors errors) {
    Evaluated result = given(true);
    result.errors = std::move(errors);
    for (const Evaluated& argument : arguments) {
      if (argument.value.kind == Kind::Text) {
        result.value.flag = result.value.flag && variables_.find(argument.value.text) != nullptr;
      } else if (result.ok()) {
        result.errors.push_back(std::string("defined: invalid type ") + kind_name(argument.value));
      }
    }
    return result;
  }

  static Evaluated compare(const std::string& name, const ExpressionValue& a,
                           const ExpressionValue& b) {
    const bool equality = name == "eq" || name == "neq";
    if (!a.same_type(b)) {
      return failed(name + ": cannot compare values of type " + kind_name(a) + " and " +
                    kind_name(b));
    }
    const bool is_nothing =
        a.kind == Kind::None || (a.kind == Kind::List && a.element == Kind::None);
    if ((a.kind == Kind::List || a.kind == Kind::None) && !(is_nothing && equality)) {
      return failed(name + ": values of type " + kind_name(a) + " cannot be compared");
    }
    const bool equal = a == b;
    if (equality) {
      return given(equal == (name == "eq"));
    }
    const bool less = a.kind == Kind::Int    ? a.number < b.number
                      : a.kind == Kind::Bool ? a.flag < b.flag
                                             : a.text < b.text;
    return given(name == "lt"    ? less
                 : name == "leq" ? less || equal
                 : name == "gt"  ? !less && !equal
                                 : !less);
  }

  static Evaluated length(const ExpressionValue& value) {
    if (value.kind != Kind::List && value.kind != Kind::Text) {
      return failed("len: only lists and strings have a length");
    }
    const std::size_t size = value.kind == Kind::List ? value.items.size() : value.text.size();
    return given(static_cast<std::int64_t>(size));
  }

  static Evaluated contains(const ExpressionValue& where, const ExpressionValue& what) {
    if (where.kind != Kind::List && where.kind != Kind::Text) {
      return failed("contains: the value to search must be a list or string");
    }
    if (where.kind == Kind::List && where.element == Kind::None) {
      return given(false);
    }
    if (what.kind != (where.kind == Kind::List ? where.element : Kind::Text)) {
      return failed("contains: the value to search for has another type");
    }
    return given(where.kind == Kind::Text ? where.text.find(what.text) != std::string::npos
                                          : std::find(where.items.begin(), where.items.end(),
                                                      what) != where.items.end());
  }

  static Evaluated element(const ExpressionValue& where, const ExpressionValue& index) {
    if (index.kind != Kind::Int) {
      return failed("at: the index must be an integer");
    }
    const Evaluated size = length(where);
    if (!size.ok()) {
      return failed("at: only lists and strings have elements");
    }
    const std::int64_t at = index.number < 0 ? index.number + size.value.number : index.number;
    if (at < 0 || at >= size.value.number) {
      return failed("at: the index is out of range");
    }
    const auto position = static_cast<std::size_t>(at);
    return where.kind == Kind::List ? Evaluated{where.items[position], {}}
                                    : given(std::string(1, where.text[position]));
  }

  const layer::Dictionary& variables_;
  std::set<std::string>& used_;
  std::vector<std::string> open_;
  std::size_t evaluations_ = 0;
  std::size_t work_ = 0;  ///< characters and items that variables gave
};

template <class T, class Get>
layer::Value array_value(const ExpressionValue& list, Get get) {
  std::vector<T> result;
  for (const ExpressionValue& item : list.items) {
    result.push_back(get(item));
  }
  return layer::Value(layer::Array<T>(std::move(result)));
}

layer::Value to_value(const ExpressionValue& value) {
  switch (value.kind) {
    case Kind::Bool:
      return value.flag;
    case Kind::Int:
      return value.number;
    case Kind::Text:
      return value.text;
    case Kind::List:
      break;
    case Kind::None:
      return {};
  }
  switch (value.element) {
    case Kind::Bool: {
      layer::Array<bool> flags;
      for (const ExpressionValue& item : value.items) {
        flags.push_back(item.flag ? 1 : 0);
      }
      return flags;
    }
    case Kind::Int:
      return array_value<std::int64_t>(value, [](const auto& item) { return item.number; });
    case Kind::Text:
      return array_value<std::string>(value, [](const auto& item) { return item.text; });
    default:
      return {};
  }
}

}  // namespace

bool is_variable_expression(std::string_view text) {
  return text.size() > 2 && text.front() == '`' && text.back() == '`';
}

ExpressionOutcome evaluate_expression(std::string_view expression,
                                      const layer::Dictionary& variables) {
  ExpressionOutcome result;
  const Result<VariableSyntax> syntax = parse_variable_expression(expression);
  if (!syntax) {
    result.errors.push_back(syntax.error().message());
    return result;
  }
  Evaluated evaluated = Evaluator(variables, result.used).evaluate(*syntax);
  result.errors = std::move(evaluated.errors);
  if (result.errors.empty()) {
    result.value = to_value(evaluated.value);
  }
  return result;
}

ExpressionResult evaluate_text(std::string_view expression, const layer::Dictionary& variables) {
  const ExpressionOutcome outcome = evaluate_expression(expression, variables);
  ExpressionResult result;
  for (const std::string& error : outcome.errors) {
    result.errors += (result.errors.empty() ? "" : "; ") + error;
  }
  if (const auto* text = outcome.value.get<std::string>()) {
    result.text = *text;
  } else if (!outcome.value.empty()) {
    result.errors = "the expression does not give a string";
  }
  return result;
}

}  // namespace tenon::compose
