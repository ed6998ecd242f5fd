// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/expressions/predicate_expression.h"

namespace tenon::layer {

/// One pattern of a path expression: a path that is matched as it is, then names that may hold '*',
/// '?' and character sets, each with or without a predicate, and stretches ("//") of any number of
/// levels. Grammar: SdfPathPattern of OpenUSD.
struct PathPattern {
  struct Component {
    std::string name;                  ///< empty: any name
    std::int32_t predicate = kNoNode;  ///< into `predicates`
    bool is_literal = false;           ///< an identifier
    bool is_stretch() const { return name.empty() && predicate == kNoNode; }
    bool operator==(const Component&) const = default;
  };

  Path prefix;
  std::vector<Component> components;
  std::vector<PredicateExpression> predicates;
  bool is_property = false;

  void append_child(std::string_view name, PredicateExpression predicate);
  void append_property(std::string_view name, PredicateExpression predicate);
  void append_stretch();
  /// Only a prim path (or the root) where components follow, else a prim or property path; another
  /// path is ignored.
  void set_prefix(Path path);

  bool has_leading_stretch() const {
    return prefix.is_absolute_root() && !components.empty() && components.front().is_stretch();
  }
  bool has_trailing_stretch() const {
    return !is_property && !components.empty() && components.back().is_stretch();
  }
  /// "//": every prim and property.
  bool is_everything() const { return has_leading_stretch() && components.size() == 1; }
  std::string text() const;
  bool operator==(const PathPattern&) const = default;

 private:
  void append(std::string_view name, PredicateExpression predicate, bool is_literal);
};

/// Reads a pattern at the scanner; false without a failure when none starts there.
bool read_pattern(ExpressionScanner& scanner, PathPattern& pattern);

}  // namespace tenon::layer
