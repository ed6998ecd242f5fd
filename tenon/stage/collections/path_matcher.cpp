// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collections/path_matcher.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "tenon/base/limits/work_limits.h"
#include "tenon/stage/collections/name_pattern.h"

namespace tenon::stage {

using layer::PathExpressionTree;
using layer::PathPattern;

Result<PathMatcher> PathMatcher::make(const PathExpressionTree& expression, const Prim& stage) {
  PathMatcher result;
  result.stage_ = stage;
  std::unordered_map<std::string, std::int32_t> known;  // patterns by text
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
      const auto [entry, is_new] =
          known.try_emplace(pattern->text(), static_cast<std::int32_t>(result.patterns_.size()));
      node.left = entry->second;
      if (is_new) {
        Pattern compiled{*pattern, {}};
        for (const layer::PredicateExpression& predicate : pattern->predicates) {
          TENON_TRY(PrimPredicate bound, PrimPredicate::bind(predicate));
          compiled.predicates.push_back(std::move(bound));
        }
        result.patterns_.push_back(std::move(compiled));
      }
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
  // reached_[i]: the names so far match the first i components.
  reached_.assign(components.size() + 1, 0);
  reached_[0] = 1;
  const auto skip_stretches = [&] {
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (reached_[i] != 0 && components[i].is_stretch()) {
        reached_[i + 1] = 1;
      }
    }
  };
  skip_stretches();
  for (std::size_t at = pattern.text.prefix.depth() + 1; at < prefixes.size(); ++at) {
    reached_next_.assign(components.size() + 1, 0);
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (reached_[i] != 0 && components[i].is_stretch()) {
        reached_next_[i] = 1;
      } else if (reached_[i] != 0 && reached_next_[i + 1] == 0) {
        reached_next_[i + 1] = matches(pattern, components[i], prefixes[at]) ? 1 : 0;
      }
    }
    reached_.swap(reached_next_);
    skip_stretches();
  }
  return reached_[components.size()] != 0;
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
  node_matches_.clear();
  pattern_matches_.assign(patterns_.size(), -1);
  const auto at = [&](std::int32_t node) {
    return node_matches_[static_cast<std::size_t>(node)] != 0;
  };
  const auto pattern_at = [&](std::int32_t index) {
    signed char& known = pattern_matches_[static_cast<std::size_t>(index)];
    if (known < 0) {
      known = matches(patterns_[static_cast<std::size_t>(index)], prefixes) ? 1 : 0;
    }
    return known != 0;
  };
  for (const layer::ExpressionNode& node : nodes_) {
    switch (node.op) {
      case PathExpressionTree::Atom:
        node_matches_.push_back(pattern_at(node.left));
        break;
      case PathExpressionTree::Complement:
        node_matches_.push_back(!at(node.left));
        break;
      case PathExpressionTree::Intersection:
        node_matches_.push_back(at(node.left) && at(node.right));
        break;
      case PathExpressionTree::Difference:
        node_matches_.push_back(at(node.left) && !at(node.right));
        break;
      default:
        node_matches_.push_back(at(node.left) || at(node.right));
    }
  }
  return at(root_);
}

}  // namespace tenon::stage
