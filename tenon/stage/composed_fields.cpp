// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/composed_fields.h"

#include <set>

#include "tenon/compose/variable_expression.h"

namespace tenon::stage {
namespace {

using layer::Value;
using layer::ValueType;

layer::AssetPath resolved(const StageData& stage, const PrimData& prim,
                          const compose::Opinion& opinion, const layer::AssetPath& asset) {
  layer::AssetPath result = asset;
  if (compose::is_variable_expression(asset.authored) && opinion.node < prim.index->nodes.size()) {
    const compose::LayerStack& stack = *prim.index->nodes[opinion.node].layer_stack;
    result.evaluated = compose::evaluate_text(asset.authored, stack.expression_variables).text;
  }
  const std::string& path = result.evaluated.empty() ? result.authored : result.evaluated;
  if (stage.options.resolve_asset && !path.empty()) {
    result.resolved = stage.options.resolve_asset(path, *opinion.layer);
  }
  return result;
}

Value localize_array(const StageData& stage, const PrimData& prim,
                     const compose::Opinion& opinion, const Value& value) {
  if (const auto* assets = value.get<std::vector<layer::AssetPath>>()) {
    std::vector<layer::AssetPath> result;
    for (const layer::AssetPath& asset : *assets) {
      result.push_back(resolved(stage, prim, opinion, asset));
    }
    return result;
  }
  if (const auto* times = value.get<std::vector<layer::TimeCode>>()) {
    std::vector<layer::TimeCode> result;
    for (const layer::TimeCode time : *times) {
      result.push_back({opinion.offset.apply(time.value)});
    }
    return result;
  }
  return value;
}

// Nested dictionaries are as deep as the reader allows (limits::kTextNestingDepth).
layer::Dictionary localize_dictionary(const StageData& stage, const PrimData& prim,
                                      const compose::Opinion& opinion,
                                      const layer::Dictionary& dictionary) {
  layer::Dictionary result;
  for (const auto& [key, item] : dictionary.items) {
    result.items.emplace(key, localize(stage, prim, opinion, item));
  }
  return result;
}

template <class T>
bool fold_list(const std::vector<compose::Opinion>& opinions, Token field, const Value& strongest,
               Value& result) {
  if (!strongest.holds<layer::ListOp<T>>()) {
    return false;
  }
  result = layer::ListOp<T>::make_explicit(compose_list<T>(opinions, field));
  return true;
}

bool fold_any_list(const std::vector<compose::Opinion>& opinions, Token field,
                   const Value& strongest, Value& result) {
  return fold_list<Token>(opinions, field, strongest, result) ||
         fold_list<std::string>(opinions, field, strongest, result) ||
         fold_list<std::int32_t>(opinions, field, strongest, result) ||
         fold_list<std::int64_t>(opinions, field, strongest, result) ||
         fold_list<std::uint32_t>(opinions, field, strongest, result) ||
         fold_list<std::uint64_t>(opinions, field, strongest, result);
}

const std::set<Token>& fields_that_are_no_metadata() {
  using namespace layer::fields;
  static const std::set<Token> fields{
      inheritPaths,  payload,        references,         specializes,        subLayers,
      subLayerOffsets, variantSelection, variantSetNames, clips,             clipSets,
      default_value, timeSamples,    spline,             primChildren,       properties,
      variantSetChildren, variantChildren, connectionChildren, targetChildren, "mapperChildren",
      "expressionChildren", "mapperArgChildren"};
  return fields;
}

}  // namespace

std::vector<compose::Opinion> property_opinions(const PrimData& prim, Token name) {
  std::vector<compose::Opinion> result;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result.push_back(opinion);
    return false;
  });
  return result;
}

Value localize(const StageData& stage, const PrimData& prim, const compose::Opinion& opinion,
               const Value& value) {
  switch (value.type()) {
    case ValueType::Asset:
      return value.is_array()
                 ? localize_array(stage, prim, opinion, value)
                 : Value(resolved(stage, prim, opinion, *value.get<layer::AssetPath>()));
    case ValueType::TimeCode:
      return value.is_array() ? localize_array(stage, prim, opinion, value)
                              : Value(layer::TimeCode{
                                    opinion.offset.apply(value.get<layer::TimeCode>()->value)});
    case ValueType::Dictionary:
      return localize_dictionary(stage, prim, opinion, *value.get<layer::Dictionary>());
    default:
      return value;
  }
}

Value compose_field(const StageData& stage, const PrimData& prim,
                    const std::vector<compose::Opinion>& opinions, Token field) {
  Value result;
  for (const compose::Opinion& opinion : opinions) {
    const Value* value = opinion.spec->find(field);
    if (value == nullptr) {
      continue;
    }
    if (result.empty()) {
      if (fold_any_list(opinions, field, *value, result)) {
        return result;
      }
      result = localize(stage, prim, opinion, *value);
      if (!result.holds<layer::Dictionary>()) {
        return result;
      }
    } else if (const auto* weaker = value->get<layer::Dictionary>()) {
      result = layer::merge(*result.get<layer::Dictionary>(),
                            localize_dictionary(stage, prim, opinion, *weaker));
    }
  }
  return result;
}

std::map<std::string, Value> compose_metadata(const StageData& stage, const PrimData& prim,
                                              const std::vector<compose::Opinion>& opinions) {
  std::map<std::string, Value> result;
  for (const compose::Opinion& opinion : opinions) {
    for (const layer::Field& field : opinion.spec->fields()) {
      if (fields_that_are_no_metadata().contains(field.name) ||
          result.contains(field.name.str())) {
        continue;
      }
      result.emplace(field.name.str(), compose_field(stage, prim, opinions, field.name));
    }
  }
  return result;
}

}  // namespace tenon::stage
