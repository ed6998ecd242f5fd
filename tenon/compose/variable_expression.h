// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/layer/dictionary.h"

/// Variable expressions: text between backquotes in asset paths, sublayers and variant selections.
namespace tenon::compose {

/// The text starts and ends with a backquote.
bool is_variable_expression(std::string_view text);

struct ExpressionResult {
  std::string text;    ///< empty on errors, and for None
  std::string errors;  ///< empty when all went well
};

/// Evaluates an expression that must give a string, with `variables` for `${NAME}`.
ExpressionResult evaluate_text(std::string_view expression, const layer::Dictionary& variables);

}  // namespace tenon::compose
