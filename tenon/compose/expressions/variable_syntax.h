// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::compose {

/// A value of the expression language. A list holds values of one kind, none of them a list.
struct ExpressionValue {
  enum class Kind : unsigned char { None, Bool, Int, Text, List };
  Kind kind = Kind::None;
  Kind element = Kind::None;  ///< of lists; None: an empty list written as `[]`
  bool flag = false;
  std::int64_t number = 0;
  std::string text = {};
  std::vector<ExpressionValue> items = {};

  static ExpressionValue of(bool flag) { return {Kind::Bool, Kind::None, flag, 0, {}, {}}; }
  static ExpressionValue of(std::int64_t number) {
    return {Kind::Int, Kind::None, false, number, {}, {}};
  }
  static ExpressionValue of(std::string text) {
    return {Kind::Text, Kind::None, false, 0, std::move(text), {}};
  }
  bool same_type(const ExpressionValue& other) const {
    return kind == other.kind && element == other.element;
  }
  bool operator==(const ExpressionValue&) const = default;
};

/// A part of an expression as it is written.
struct VariableSyntax {
  enum class Kind : unsigned char { Constant, Variable, Text, List, Call };
  Kind kind = Kind::Constant;
  ExpressionValue constant;
  std::string name;  ///< of variables and functions
  /// Elements, arguments, or the parts of a text: constants and variables.
  std::vector<VariableSyntax> parts;
};

/// Reads an expression, backquotes included; nested no deeper than limits::kExpressionDepth. An
/// Error tells the character. Functions are known by name and number of arguments.
Result<VariableSyntax> parse_variable_expression(std::string_view text);

}  // namespace tenon::compose
