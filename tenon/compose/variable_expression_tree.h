// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Internal: variable expressions as trees.
namespace tenon::compose::expression {

enum class Kind { None, Bool, Int, Text, List };

struct ExpressionValue {
  Kind kind = Kind::None;
  Kind item_kind = Kind::None;  // of a list; None when it is empty
  bool flag = false;
  std::int64_t number = 0;
  std::string text = {};
  std::vector<ExpressionValue> items = {};  // none of them a list

  bool operator==(const ExpressionValue&) const = default;
  bool same_type(const ExpressionValue& other) const {
    return kind == other.kind && item_kind == other.item_kind;
  }
};

inline ExpressionValue none() { return {}; }
inline ExpressionValue of_bool(bool flag) {
  ExpressionValue value;
  value.kind = Kind::Bool;
  value.flag = flag;
  return value;
}
inline ExpressionValue of_int(std::int64_t number) {
  ExpressionValue value;
  value.kind = Kind::Int;
  value.number = number;
  return value;
}
inline ExpressionValue of_text(std::string text) {
  ExpressionValue value;
  value.kind = Kind::Text;
  value.text = std::move(text);
  return value;
}

/// A part of an expression; its operands are indices into the tree.
struct TreeNode {
  enum class Type { Constant, Variable, Text, List, Call };
  Type type = Type::Constant;
  ExpressionValue constant = {};
  std::string name = {};                   // of a variable or function
  std::vector<std::size_t> operands = {};  // of Text: constants and variables
};

using Tree = std::vector<TreeNode>;

/// The tree of the text between the backquotes, its root last; empty and `error` set when the text
/// is no expression.
Tree parse(std::string_view text, std::string& error);

}  // namespace tenon::compose::expression
