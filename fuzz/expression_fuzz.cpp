// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0

// Input: an expression in its first line, then lines NAME=TEXT, variables of an expression. Its
// value is the same each time and no longer than the limit; an error has no value.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/taken_bytes.h"
#include "tenon/base/limits/limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/layer/field_values.h"

namespace {

tenon::layer::Value value_of(std::string_view text) {
  if (text == "True" || text == "False") {
    return tenon::layer::Value(text == "True");
  }
  if (const auto number = tenon::parse_int64(text)) {
    return tenon::layer::Value(*number);
  }
  if (text.starts_with('[')) {
    return tenon::layer::Value(tenon::layer::Array<std::string>{std::string(text), "x"});
  }
  return tenon::layer::Value(std::string(text));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::TakenBytes input(data, size);
  const std::string expression = "`" + std::string(input.until('\n')) + "`";
  tenon::layer::Dictionary variables;
  while (!input.empty()) {
    const std::string_view line = input.until('\n');
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos) {
      variables.items.insert_or_assign(std::string(line.substr(0, equals)),
                                       value_of(line.substr(equals + 1)));
    }
  }
  if (!tenon::compose::is_variable_expression(expression)) {
    return 0;
  }
  const auto result = tenon::compose::evaluate_text(expression, variables);
  const auto again = tenon::compose::evaluate_text(expression, variables);
  const bool failed = !result.errors.empty();
  if (result.text != again.text || result.errors != again.errors ||
      (failed && !result.text.empty()) ||
      result.text.size() > expression.size() + tenon::limits::kExpressionWork) {
    std::abort();
  }
  return 0;
}
