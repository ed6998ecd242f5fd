// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Expressions: `${VAR}`, text with `${VAR}` in it, integers, True, False, None, lists of these and
// calls of functions. What is wrong in parts that do not count does no harm.
#include "tenon/compose/variable_expression.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "tenon/base/limits.h"
#include "tenon/compose/variable_expression_tree.h"
#include "tenon/layer/field_values.h"

namespace tenon::compose {
namespace {

using namespace expression;

constexpr std::size_t kMostSteps = 100000;  // parts evaluated, those of variables included

/// A value, or what is wrong with it.
struct Evaluated {
  ExpressionValue value = {};
  std::string error = {};
};

Evaluated wrong(std::string error) { return {{}, std::move(error)}; }

Evaluated list_of(std::vector<ExpressionValue> items) {
  ExpressionValue list;
  list.kind = Kind::List;
  for (const ExpressionValue& item : items) {
    if (item.kind == Kind::None || item.kind == Kind::List || item.kind != items.front().kind) {
      return wrong("a list holds values of one type that are no lists");
    }
  }
  list.item_kind = items.empty() ? Kind::None : items.front().kind;
  list.items = std::move(items);
  return {std::move(list), {}};
}

/// Values that variables may have; nullopt for others.
std::optional<ExpressionValue> converted(const layer::Value& value) {
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
  std::vector<ExpressionValue> items;
  const auto fill = [&](const auto* array, const auto& make) {
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      items.push_back(make((*array)[i]));
    }
    return array != nullptr;
  };
  if (fill(value.get<layer::Array<std::string>>(), of_text) ||
      fill(value.get<layer::Array<bool>>(), of_bool) ||
      fill(value.get<layer::Array<std::int32_t>>(), of_int) ||
      fill(value.get<layer::Array<std::int64_t>>(), of_int)) {
    return list_of(std::move(items)).value;
  }
  return std::nullopt;
}

class Evaluator {
 public:
  explicit Evaluator(const layer::Dictionary& variables) : variables_(variables) {}

  Evaluated evaluate(std::string_view expression) {
    std::string error;
    const Tree tree = parse(expression.substr(1, expression.size() - 2), error);
    return error.empty() ? evaluate(tree, tree.size() - 1) : wrong(std::move(error));
  }

 private:
  Evaluated evaluate(const Tree& tree, std::size_t at) {
    if (++steps_ > kMostSteps || depth_ >= limits::kExpressionDepth) {
      return wrong("too much to evaluate");
    }
    ++depth_;
    Evaluated result = evaluate_node(tree, tree[at]);
    --depth_;
    return result;
  }

  Evaluated evaluate_node(const Tree& tree, const TreeNode& node) {
    switch (node.type) {
      case TreeNode::Type::Constant:
        return {node.constant, {}};
      case TreeNode::Type::Variable:
        return variables_.find(node.name) == nullptr
                   ? wrong("no value for variable '" + node.name + "'")
                   : variable(node.name);
      case TreeNode::Type::Text:
        return text(tree, node);
      case TreeNode::Type::List:
      case TreeNode::Type::Call:
        break;
    }
    if (node.name == "if") {
      return choice(tree, node);
    }
    std::vector<ExpressionValue> operands;
    for (const std::size_t operand : node.operands) {
      Evaluated evaluated = evaluate(tree, operand);
      if (!evaluated.error.empty()) {
        return evaluated;
      }
      operands.push_back(std::move(evaluated.value));
    }
    return node.type == TreeNode::Type::List ? list_of(std::move(operands))
                                             : apply(node.name, operands);
  }

  /// Text variables may be expressions themselves.
  Evaluated variable(const std::string& name) {
    const layer::Value& value = *variables_.find(name);
    const auto* text = value.get<std::string>();
    if (text != nullptr && is_variable_expression(*text)) {
      if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
        return wrong("variable '" + name + "' leads back to itself");
      }
      open_.push_back(name);
      Evaluated result = evaluate(*text);
      open_.pop_back();
      return result;
    }
    std::optional<ExpressionValue> found = converted(value);
    return found ? Evaluated{*std::move(found), {}}
                 : wrong("variable '" + name + "' has a type that expressions do not know");
  }

  /// Variables within text must be text, or nothing; those that are not there stay as they are.
  Evaluated text(const Tree& tree, const TreeNode& node) {
    std::string result;
    for (const std::size_t operand : node.operands) {
      const TreeNode& part = tree[operand];
      if (part.type == TreeNode::Type::Variable && variables_.find(part.name) == nullptr) {
        result += "${" + part.name + "}";
        continue;
      }
      const Evaluated evaluated = evaluate(tree, operand);
      if (!evaluated.error.empty()) {
        return evaluated;
      }
      if (evaluated.value.kind != Kind::Text && evaluated.value.kind != Kind::None) {
        return wrong("variable '" + part.name + "' is no string");
      }
      result += evaluated.value.text;
      if (result.size() > limits::kPathTextLength) {
        return wrong("the text is too long");
      }
    }
    return {of_text(std::move(result)), {}};
  }

  /// Only what is chosen counts, though both values must be of one type.
  Evaluated choice(const Tree& tree, const TreeNode& node) {
    Evaluated condition = evaluate(tree, node.operands[0]);
    if (!condition.error.empty()) {
      return condition;
    }
    if (condition.value.kind != Kind::Bool) {
      return wrong("the condition of 'if' must be a boolean");
    }
    Evaluated first = evaluate(tree, node.operands[1]);
    if (node.operands.size() == 2) {
      return condition.value.flag ? std::move(first) : Evaluated{};
    }
    Evaluated second = evaluate(tree, node.operands[2]);
    if (first.value.kind != Kind::None && second.value.kind != Kind::None &&
        !first.value.same_type(second.value)) {
      return wrong("the values of 'if' must have one type");
    }
    return condition.value.flag ? std::move(first) : std::move(second);
  }

  using Operands = std::vector<ExpressionValue>;

  Evaluated apply(const std::string& name, const Operands& operands) {
    if (name == "and" || name == "or" || name == "not") {
      return logic(name, operands);
    }
    if (name == "len") {
      return length(operands[0]);
    }
    if (name == "contains") {
      return contains(operands[0], operands[1]);
    }
    if (name == "at") {
      return element(operands[0], operands[1]);
    }
    return name == "defined" ? defined(operands) : compare(name, operands[0], operands[1]);
  }

  static Evaluated logic(const std::string& name, const Operands& operands) {
    bool all = true;
    bool any = false;
    for (const ExpressionValue& operand : operands) {
      if (operand.kind != Kind::Bool) {
        return wrong("'" + name + "' takes booleans");
      }
      all = all && operand.flag;
      any = any || operand.flag;
    }
    return {of_bool(name == "and" ? all : name == "or" ? any : !any), {}};
  }

  static Evaluated compare(const std::string& name, const ExpressionValue& a,
                           const ExpressionValue& b) {
    if (!a.same_type(b) || a.kind == Kind::List) {
      return wrong("'" + name + "' takes two values of one type that are no lists");
    }
    if (name == "eq" || name == "neq") {
      return {of_bool((a == b) == (name == "eq")), {}};
    }
    if (a.kind == Kind::None) {
      return wrong("None has no order");
    }
    const bool less = a.kind == Kind::Int    ? a.number < b.number
                      : a.kind == Kind::Text ? a.text < b.text
                                             : !a.flag && b.flag;
    if (name == "lt" || name == "geq") {
      return {of_bool(less == (name == "lt")), {}};
    }
    return {of_bool((less || a == b) == (name == "leq")), {}};
  }

  static Evaluated length(const ExpressionValue& value) {
    if (value.kind != Kind::List && value.kind != Kind::Text) {
      return wrong("only lists and strings have a length");
    }
    const std::size_t size = value.kind == Kind::List ? value.items.size() : value.text.size();
    return {of_int(static_cast<std::int64_t>(size)), {}};
  }

  static Evaluated contains(const ExpressionValue& where, const ExpressionValue& what) {
    if (where.kind == Kind::List && (where.items.empty() || where.item_kind == what.kind)) {
      const auto found = std::find(where.items.begin(), where.items.end(), what);
      return {of_bool(found != where.items.end()), {}};
    }
    if (where.kind != Kind::Text || what.kind != Kind::Text) {
      return wrong("'contains' looks for an item in a list or for text in text");
    }
    return {of_bool(where.text.find(what.text) != std::string::npos), {}};
  }

  static Evaluated element(const ExpressionValue& where, const ExpressionValue& index) {
    const std::int64_t size = length(where).value.number;
    const std::int64_t at = index.number < 0 ? index.number + size : index.number;
    if (index.kind != Kind::Int || at < 0 || at >= size) {
      return wrong("'at' takes a list or text and an index within it");
    }
    const auto position = static_cast<std::size_t>(at);
    return {where.kind == Kind::List ? where.items[position]
                                     : of_text(std::string(1, where.text[position])),
            {}};
  }

  Evaluated defined(const Operands& names) const {
    bool all = true;
    for (const ExpressionValue& name : names) {
      if (name.kind != Kind::Text) {
        return wrong("'defined' takes names of variables as strings");
      }
      all = all && variables_.find(name.text) != nullptr;
    }
    return {of_bool(all), {}};
  }

  const layer::Dictionary& variables_;
  std::vector<std::string> open_;  // variables whose expressions are under way
  std::size_t steps_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

bool is_variable_expression(std::string_view text) {
  return text.size() > 2 && text.front() == '`' && text.back() == '`';
}

ExpressionResult evaluate_text(std::string_view expression, const layer::Dictionary& variables) {
  ExpressionResult result;
  Evaluated evaluated = Evaluator(variables).evaluate(expression);
  result.errors = std::move(evaluated.error);
  if (!result.errors.empty() || evaluated.value.kind == Kind::None) {
    return result;
  }
  if (evaluated.value.kind != Kind::Text) {
    result.errors = "the expression does not give a string";
    return result;
  }
  result.text = std::move(evaluated.value.text);
  return result;
}

}  // namespace tenon::compose
