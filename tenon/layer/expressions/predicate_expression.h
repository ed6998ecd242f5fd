// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/layer/expressions/expression_scanner.h"
#include "tenon/layer/expressions/expression_tree.h"
#include "tenon/layer/value.h"

/// The part in braces of a path expression: `{isa:Mesh and not kind(component, strict=true)}`.
/// Grammar: SdfPredicateExpression of OpenUSD.
namespace tenon::layer {

struct PredicateArgument {
  std::string keyword;  ///< empty for arguments by position
  Value value;          ///< bool, int64, double or string
  bool operator==(const PredicateArgument&) const = default;
};

struct PredicateCall {
  enum class Form : unsigned char { Bare, Colon, Parentheses };
  std::string function;
  Form form = Form::Bare;
  std::vector<PredicateArgument> arguments;
  bool operator==(const PredicateCall&) const = default;
};

struct PredicateExpression {
  enum Op : std::uint8_t { Call = kAtom, Not = kUnary, ImpliedAnd, And, Or };
  std::vector<ExpressionNode> nodes;  ///< operands before operators; the last one is the root
  std::vector<PredicateCall> calls;

  std::string text() const;
  bool operator==(const PredicateExpression&) const = default;
};

/// Reads a predicate (without braces) at the scanner; stops before what does not belong to it.
bool read_predicate(ExpressionScanner& scanner, PredicateExpression& predicate);

}  // namespace tenon::layer
