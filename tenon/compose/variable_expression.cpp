// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/variable_expression.h"

namespace tenon::compose {

bool is_variable_expression(std::string_view text) {
  return text.size() > 2 && text.front() == '`' && text.back() == '`';
}

ExpressionResult evaluate_text(std::string_view, const layer::Dictionary&) {
  return {{}, "not implemented"};
}

}  // namespace tenon::compose
