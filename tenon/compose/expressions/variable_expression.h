// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/layer/dictionary.h"
#include "tenon/layer/value.h"

/// Variable expressions: text between backquotes in asset paths, sublayers and variant selections.
/// Language: SdfVariableExpression of OpenUSD.
namespace tenon::compose {

/// The text starts and ends with a backquote.
bool is_variable_expression(std::string_view text);

struct ExpressionOutcome {
  /// A string, bool, int64 or an array of them; empty for None, for `[]` and on errors.
  layer::Value value;
  std::vector<std::string> errors;  ///< empty when all went well
  std::set<std::string> used;       ///< names of the variables asked for
};

/// Evaluates an expression with `variables` for `${NAME}`; those may hold expressions themselves.
ExpressionOutcome evaluate_expression(std::string_view expression,
                                      const layer::Dictionary& variables);

struct ExpressionResult {
  std::string text;    ///< empty on errors, and for None
  std::string errors;  ///< empty when all went well
};

/// Evaluates an expression that must give a string.
ExpressionResult evaluate_text(std::string_view expression, const layer::Dictionary& variables);

}  // namespace tenon::compose
