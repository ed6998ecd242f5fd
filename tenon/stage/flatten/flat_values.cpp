// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples of one layer are taken as they are instead of being asked for at their stage times: a
// time that was moved to the stage and back may lie a little before the sample that it came from.
// Path expressions are put together, because the weaker opinions that `%_` refers to are gone
// afterwards.
#include "tenon/stage/flatten/flat_values.h"

#include <utility>
#include <vector>

#include "tenon/layer/expressions/path_expression.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/values/compose_array_edits.h"
#include "tenon/stage/values/compose_expression.h"

namespace tenon::stage {

using layer::Value;

Path FlatValues::moved(Path path) const {
  for (Path at = path; !at.empty(); at = at.parent()) {
    const auto it = prototypes_.find(at);
    if (it != prototypes_.end()) {
      return path.replace_prefix(it->first, it->second);
    }
  }
  return path;
}

Value FlatValues::read(const PrimData& prim, Token name, const ResolvedValue& resolved,
                       Time time) const {
  return whole(prim, name, read_value(stage_, prim, name, resolved, time, AssetForm::Anchored),
               time);
}

layer::TimeSamples FlatValues::samples(const PrimData& prim, const Attribute& attribute) const {
  const Token name = attribute.name();
  const ResolvedValue animated = resolve_value(prim, name, Asked::AnyTime);
  layer::TimeSamples result;
  if (animated.samples == nullptr || may_edit(animated)) {
    for (const double time : attribute.time_samples()) {
      result.set(time, read(prim, name, animated, time));
    }
    return result;
  }
  const compose::Opinion& opinion = animated.opinion;
  for (std::size_t i = 0; i < animated.samples->size(); ++i) {
    const double time = opinion.offset.apply(animated.samples->times[i]);
    const Value& authored = animated.samples->values[i];
    Value value = authored.is_block()
                      ? Value()
                      : localize(stage_, prim, opinion, authored, AssetForm::Anchored);
    result.set(time, whole(prim, name, std::move(value), time));
  }
  return result;
}

/// With weaker path expressions in the place of `%_`; a block for no value.
Value FlatValues::whole(const PrimData& prim, Token name, Value value, Time time) const {
  if (value.empty()) {
    return layer::ValueBlock{};
  }
  if (value.type() != layer::ValueType::PathExpression) {
    return value;
  }
  value = compose_expression(stage_, prim, Path(), name, std::move(value), time);
  return prim.in_prototype ? moved_expressions(value) : value;
}

layer::PathExpression FlatValues::moved(const layer::PathExpression& expression) const {
  const auto tree = layer::PathExpressionTree::parse(expression.text);
  return tree ? layer::PathExpression{tree->mapped([&](Path path) { return moved(path); }).text()}
              : expression;
}

Value FlatValues::moved_expressions(const Value& value) const {
  if (const auto* one = value.get<layer::PathExpression>()) {
    return moved(*one);
  }
  std::vector<layer::PathExpression> result;
  for (const layer::PathExpression& one : *value.get<layer::Array<layer::PathExpression>>()) {
    result.push_back(moved(one));
  }
  return result;
}

}  // namespace tenon::stage
