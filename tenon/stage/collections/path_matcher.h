// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/stage/collections/prim_predicate.h"

namespace tenon::stage {

/// Tells which prims and properties of a stage a path expression matches (SdfPathExpressionEval of
/// OpenUSD). A handle into the stage; must not outlive it.
class PathMatcher {
 public:
  /// Matches nothing.
  PathMatcher() = default;
  /// `stage` is any prim of the stage. An Error where a path is relative, a reference is left or a
  /// predicate is not known.
  static Result<PathMatcher> make(const layer::PathExpressionTree& expression, const Prim& stage);

  bool is_empty() const { return root_ == layer::kNoNode; }
  /// So much was asked (kMatchWork) that nothing matches any more.
  bool is_exhausted() const;
  /// Names compared so far.
  std::size_t work() const { return work_; }
  /// `path` is a prim or property of the stage and is matched. Not to be called on two threads.
  bool matches(Path path) const;

 private:
  struct Pattern {
    layer::PathPattern text;
    std::vector<PrimPredicate> predicates;
  };
  bool matches(const Pattern& pattern, const std::vector<Path>& prefixes) const;
  bool matches(const Pattern& pattern, const layer::PathPattern::Component& component,
               Path path) const;

  Prim stage_;
  std::vector<layer::ExpressionNode> nodes_;
  std::int32_t root_ = layer::kNoNode;
  std::vector<Pattern> patterns_;  // each once
  // Of the question that is being answered: what each node and each pattern says (-1: not looked at
  // yet), and which components the names so far reach.
  mutable std::vector<char> node_matches_;
  mutable std::vector<signed char> pattern_matches_;
  mutable std::vector<char> reached_;
  mutable std::vector<char> reached_next_;
  mutable std::size_t work_ = 0;  // beyond kMatchWork nothing matches any more
};

}  // namespace tenon::stage
