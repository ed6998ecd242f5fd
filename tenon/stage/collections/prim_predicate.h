// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/layer/expressions/predicate_expression.h"
#include "tenon/stage/prim.h"

namespace tenon::stage {

/// A predicate of a path expression with its functions found and their arguments checked. The
/// functions are those of OpenUSD's UsdGetCollectionPredicateLibrary: abstract, defined, model,
/// group, kind, specifier, isa, hasAPI, variant.
class PrimPredicate {
 public:
  /// An Error where a function is not known or does not take its arguments.
  static Result<PrimPredicate> bind(const layer::PredicateExpression& expression);

  /// Holds for the prim, or for a property of it.
  bool holds(const Prim& prim, bool is_property) const;

  using Matcher = std::function<bool(const Prim& prim, bool is_property)>;

 private:
  std::vector<layer::ExpressionNode> nodes_;
  std::vector<Matcher> functions_;
};

}  // namespace tenon::stage
