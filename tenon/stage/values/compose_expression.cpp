// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/compose_expression.h"

#include <algorithm>
#include <vector>

#include "tenon/layer/expressions/path_expression.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/property_facts.h"
#include "tenon/stage/targets/composed_targets.h"

namespace tenon::stage {
namespace {

using layer::PathExpression;
using layer::PathExpressionTree;
using layer::Value;
namespace fields = layer::fields;

Value held_at(const layer::TimeSamples& samples, double time) {
  const auto after = std::upper_bound(samples.times.begin(), samples.times.end(), time);
  const auto index = static_cast<std::size_t>(after - samples.times.begin());
  return samples.values[index == 0 ? 0 : index - 1];
}

struct Said {
  compose::Opinion opinion;
  ValueSource kind = ValueSource::None;
  Value value;
};

/// What each layer says at a time, strongest first: its samples before its default. Ends at a
/// block; an animation block hides the samples below it.
std::vector<Said> values_at(const PrimData& prim, Token name, Time time) {
  std::vector<Said> result;
  bool animation_blocked = time.is_default();
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    const auto* samples = opinion.spec->get<layer::TimeSamples>(fields::timeSamples);
    Value value;
    ValueSource kind = ValueSource::Default;
    if (!animation_blocked && samples != nullptr && !samples->empty()) {
      kind = ValueSource::TimeSamples;
      value = held_at(*samples, opinion.offset.inverse().apply(time.code()));
    } else if (const Value* authored = opinion.spec->find(fields::default_value)) {
      value = *authored;
    }
    if (value.holds<layer::AnimationBlock>()) {
      animation_blocked = true;
    } else if (!value.empty() && !value.is_block()) {
      result.push_back({opinion, kind, value});
    }
    return value.is_block();
  });
  return result;
}

PathExpressionTree tree_of(const Value& value) {
  const auto* expression = value.get<PathExpression>();
  auto tree =
      PathExpressionTree::parse(expression == nullptr ? std::string_view() : expression->text);
  return tree ? *std::move(tree) : PathExpressionTree();
}

PathExpressionTree composed(const StageData& stage, const PrimData& prim, Token name,
                            PathExpressionTree tree, Time time, ReadTrace* trace) {
  const auto values = values_at(prim, name, time);
  for (std::size_t i = 1; i < values.size() && tree.has_weaker_reference(); ++i) {
    if (trace != nullptr) {
      trace->put_in.push_back({values[i].opinion, values[i].kind});
    }
    const Value weaker = localize(stage, prim, values[i].opinion, values[i].value);
    tree = tree.composed_over(tree_of(weaker)).value_or(PathExpressionTree());
  }
  return tree.has_weaker_reference()
             ? tree.composed_over(PathExpressionTree()).value_or(PathExpressionTree())
             : tree;
}

}  // namespace

Value compose_expression(const StageData& stage, const PrimData& prim, Path proxy_path, Token name,
                         Value value, Time time, ReadTrace* trace) {
  const auto* one = value.get<PathExpression>();
  const bool refers_to_weaker = one != nullptr && one->text.find("%_") != std::string::npos;
  if (!refers_to_weaker && !prim.in_prototype) {
    return value;
  }
  const SourceMap map = prim.in_prototype ? source_map(stage, prim, proxy_path) : SourceMap();
  const auto seen = [&map](const PathExpressionTree& tree) {
    return PathExpression{tree.mapped([&map](Path path) { return translated(map, path); }).text()};
  };
  if (one != nullptr) {
    return seen(refers_to_weaker ? composed(stage, prim, name, tree_of(value), time, trace)
                                 : tree_of(value));
  }
  layer::Array<PathExpression> result;
  for (const PathExpression& expression : *value.get<layer::Array<PathExpression>>()) {
    result.push_back(seen(tree_of(Value(expression))));
  }
  return result;
}

}  // namespace tenon::stage
