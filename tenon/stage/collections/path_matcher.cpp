// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collections/path_matcher.h"

#include <string>
#include <utility>

#include "tenon/base/limits/work_limits.h"
#include "tenon/stage/collections/name_pattern.h"

namespace tenon::stage {

using layer::PathExpressionTree;
using layer::PathPattern;

Result<PathMatcher> PathMatcher::make(const PathExpressionTree& expression, const Prim& stage) {
  PathMatcher result;
  result.stage_ = stage;
  for (layer::ExpressionNode node : expression.nodes()) {
    if (node.op == PathExpressionTree::Atom) {
      const PathPattern* pattern = expression.pattern(node);
      if (pattern == nullptr || !pattern->prefix.is_absolute()) {
        return Error(ErrorCode::Parse, "a path expression is not complete: " + expression.text())
            .with_rule("stage.path-expression");
      }
      if (pattern->components.size() > limits::kPatternParts) {
        return Error(ErrorCode::Limit, "a path pattern has more than " +
                                           std::to_string(limits::kPatternParts) +
                                           " parts (kPatternParts)")
            .with_rule("stage.path-expression");
      }
      Pattern compiled{*pattern, {}};
      for (const layer::PredicateExpression& predicate : pattern->predicates) {
        TENON_TRY(PrimPredicate bound, PrimPredicate::bind(predicate));
        compiled.predicates.push_back(std::move(bound));
      }
      node.left = static_cast<std::int32_t>(result.patterns_.size());
      result.patterns_.push_back(std::move(compiled));
    }
    result.nodes_.push_back(node);
  }
  result.root_ = expression.root();
  return result;
}

bool PathMatcher::matches(const Pattern& pattern, const PathPattern::Component& component,
                          Path path) const {
  const std::string_view name = path.name().view();
  const bool by_name = component.is_literal || component.name.empty()
                           ? component.name.empty() || component.name == name
                           : name_matches(component.name, name);
  if (!by_name || component.predicate == layer::kNoNode) {
    return by_name;
  }
  const bool is_property = path.is_property();
  const Prim prim = stage_.prim_at(is_property ? path.parent() : path);
  return pattern.predicates[static_cast<std::size_t>(component.predicate)].holds(prim, is_property);
}

// `prefixes` are the path and all above it, root first.
bool PathMatcher::matches(const Pattern& pattern, const std::vector<Path>& prefixes) const {
  const std::vector<PathPattern::Component>& components = pattern.text.components;
  const Path path = prefixes.back();
  const bool any_kind = !components.empty() && components.back().name.empty();
  if (!path.has_prefix(pattern.text.prefix) ||
      (pattern.text.is_property ? !path.is_property() : path.is_property() && !any_kind)) {
    return false;
  }
  work_ += prefixes.size() * (components.size() + 1);
  // reachable[i]: the names so far match the first i components.
  std::vector<bool> reachable(components.size() + 1, false);
  reachable[0] = true;
  const auto skip_stretches = [&] {
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (reachable[i] && components[i].is_stretch()) {
        reachable[i + 1] = true;
      }
    }
  };
  skip_stretches();
  for (std::size_t at = pattern.text.prefix.depth() + 1; at < prefixes.size(); ++at) {
    std::vector<bool> next(components.size() + 1, false);
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (reachable[i] && components[i].is_stretch()) {
        next[i] = true;
      } else if (reachable[i] && !next[i + 1]) {
        next[i + 1] = matches(pattern, components[i], prefixes[at]);
      }
    }
    reachable = std::move(next);
    skip_stretches();
  }
  return reachable[components.size()];
}

bool PathMatcher::is_exhausted() const { return work_ > limits::kMatchWork; }

bool PathMatcher::matches(Path path) const {
  const Prim prim = stage_.prim_at(path.is_property() ? path.parent() : path);
  if (is_empty() || !prim || is_exhausted() ||
      (path.is_property() && !prim.has_property(path.name()))) {
    return false;
  }
  const std::vector<Path> prefixes = path.prefixes();
  work_ += nodes_.size() + prefixes.size();
  std::vector<bool> values;
  values.reserve(nodes_.size());
  const auto at = [&values](std::int32_t node) { return values[static_cast<std::size_t>(node)]; };
  for (const layer::ExpressionNode& node : nodes_) {
    switch (node.op) {
      case PathExpressionTree::Atom:
        values.push_back(matches(patterns_[static_cast<std::size_t>(node.left)], prefixes));
        break;
      case PathExpressionTree::Complement:
        values.push_back(!at(node.left));
        break;
      case PathExpressionTree::Intersection:
        values.push_back(at(node.left) && at(node.right));
        break;
      case PathExpressionTree::Difference:
        values.push_back(at(node.left) && !at(node.right));
        break;
      default:
        values.push_back(at(node.left) || at(node.right));
    }
  }
  return at(root_);
}

}  // namespace tenon::stage
