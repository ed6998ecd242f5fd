// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Evaluates the variable expressions in a layer's customLayerData with its expressionVariables, for
// variable_expressions.py: one line per entry, its key, "error" or "value", the variables used
// joined by commas, and the value as text layers print it.
#include <cstdio>

#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"

int main(int argc, char** argv) {
  tenon::Diagnostics diagnostics;
  const auto layer = tenon::formats::open_layer_file(argc > 1 ? argv[1] : "", diagnostics);
  if (!layer) {
    return 1;
  }
  const tenon::layer::Dictionary none;
  const auto dictionary = [&](const char* field) -> const tenon::layer::Dictionary& {
    const auto* found = layer->root().get<tenon::layer::Dictionary>(tenon::Token(field));
    return found == nullptr ? none : *found;
  };
  for (const auto& [key, expression] : dictionary("customLayerData").items) {
    const auto outcome = tenon::compose::evaluate_expression(expression.get_or(std::string()),
                                                             dictionary("expressionVariables"));
    std::string used;
    for (const std::string& name : outcome.used) {
      used += (used.empty() ? "" : ",") + name;
    }
    std::string value = tenon::formats::value_text(outcome.value);
    for (std::size_t at = value.find('\n'); at != std::string::npos; at = value.find('\n', at)) {
      value.replace(at, 1, "\\n");
    }
    std::printf("%s\t%s\t%s\t%s\n", key.c_str(), outcome.errors.empty() ? "value" : "error",
                used.c_str(), value.c_str());
  }
  return 0;
}
