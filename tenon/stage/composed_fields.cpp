// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The opinions of a field come strongest first, and the type of the strongest value decides how
// they combine: dictionaries merge key by key, list edits are applied from the weakest up and give
// an explicit list, anything else stands alone. Each value is moved from its layer to the stage on
// the way: asset paths are resolved from the layer, times pass its offset, path expressions the map
// of its node. An anchored asset path is rewritten to mean the same in a layer in any other place.
#include "tenon/stage/composed_fields.h"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <type_traits>
#include <unordered_set>

#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/layer/time/moved_in_time.h"
#include "tenon/layer/type_names.h"

namespace tenon::stage {
namespace {

using layer::Value;
using layer::ValueType;

// What localizing takes beside the value.
struct Place {
  const StageData& stage;
  const PrimData& prim;
  const compose::Opinion& opinion;
  AssetForm form;
};

// Relative paths start from the layer's folder; others do where the asset is there.
std::string anchored_path(const StageData& stage, const layer::Layer& layer,
                          const std::string& path, std::string resolved) {
  const std::string& identifier = layer.identifier();
  if (identifier.find('[') != std::string::npos || identifier.ends_with(".usdz")) {
    return resolved.empty() ? path : resolved;
  }
  if (identifier.empty() || identifier.front() != '/' || path.empty() || path.front() == '/') {
    return path;
  }
  // What is in a package, a pattern of tiles for one, need not be there when the package is.
  const std::size_t bracket = path.find('[');
  if (resolved.empty() && bracket != std::string::npos && stage.options.resolve_asset) {
    resolved = stage.options.resolve_asset(path.substr(0, bracket), layer);
    resolved += resolved.empty() ? "" : path.substr(bracket);
  }
  const std::string folder = identifier.substr(0, identifier.rfind('/') + 1);
  std::string joined = std::filesystem::path(folder + path).lexically_normal().string();
  const bool relative = path.starts_with("./") || path.starts_with("../");
  return relative || joined == resolved ? joined : path;
}

}  // namespace

std::string anchored_asset(const StageData& stage, const layer::Layer& layer,
                           const std::string& path) {
  const std::string resolved =
      stage.options.resolve_asset ? stage.options.resolve_asset(path, layer) : std::string();
  return anchored_path(stage, layer, path, resolved);
}

namespace {

layer::AssetPath resolved(const Place& place, const layer::AssetPath& asset) {
  const compose::PrimIndex& index = *place.prim.index;
  layer::AssetPath result = asset;
  if (compose::is_variable_expression(asset.authored) &&
      place.opinion.node < index.nodes().size()) {
    const compose::LayerStack& stack = *index.nodes()[place.opinion.node].layer_stack;
    result.evaluated = compose::evaluate_text(asset.authored, stack.expression_variables).text;
  }
  const std::string& path = result.evaluated.empty() ? result.authored : result.evaluated;
  if (place.stage.options.resolve_asset && !path.empty()) {
    result.resolved = place.stage.options.resolve_asset(path, *place.opinion.layer);
  }
  if (place.form == AssetForm::Anchored) {
    return {anchored_path(place.stage, *place.opinion.layer, path, result.resolved), {}, {}};
  }
  return result;
}

layer::PathExpression mapped(const Place& place, const layer::PathExpression& expression) {
  const auto tree = layer::PathExpressionTree::parse(expression.text);
  if (!tree || place.opinion.node >= place.prim.index->nodes().size()) {
    return {};
  }
  const compose::MapFunction& map = *place.prim.index->nodes()[place.opinion.node].map_to_root;
  if (map.is_identity_of_paths()) {
    return expression;
  }
  return {tree->mapped([&](Path path) { return map.map_source_to_target(path); }).text()};
}

Value localize_array(const Place& place, const Value& value) {
  if (const auto* assets = value.get<std::vector<layer::AssetPath>>()) {
    std::vector<layer::AssetPath> result;
    for (const layer::AssetPath& asset : *assets) {
      result.push_back(resolved(place, asset));
    }
    return result;
  }
  if (const auto* expressions = value.get<layer::Array<layer::PathExpression>>()) {
    std::vector<layer::PathExpression> result;
    for (const layer::PathExpression& expression : *expressions) {
      result.push_back(mapped(place, expression));
    }
    return result;
  }
  return value;
}

void note_used(UsedSpecs* used, const compose::Opinion& opinion) {
  if (used != nullptr) {
    used->push_back(opinion.spec);
  }
}

// Nested dictionaries are as deep as the reader allows (limits::kTextNestingDepth).
layer::Dictionary localize_dictionary(const Place& place, const layer::Dictionary& dictionary) {
  layer::Dictionary result;
  for (const auto& [key, item] : dictionary.items) {
    result.items.emplace(key, localize(place.stage, place.prim, place.opinion, item, place.form));
  }
  return result;
}

// Legacy edits (add, reorder) do not combine with others: they are skipped, except that the
// strongest one counts alone. As OpenUSD combines list-valued metadata.
template <class T>
std::vector<T> combined_list(std::span<const compose::Opinion> opinions, Token field,
                             UsedSpecs* used) {
  std::vector<const layer::ListOp<T>*> edits;
  bool ends = false;
  for (auto opinion = opinions.begin(); opinion != opinions.end() && !ends; ++opinion) {
    const auto* edit = opinion->spec->get<layer::ListOp<T>>(field);
    if (edit == nullptr) {
      continue;
    }
    const bool legacy = !edit->is_explicit && edit->has_legacy();
    ends = edit->is_explicit || (legacy && edits.empty());
    if (!legacy || edits.empty()) {
      edits.push_back(edit);
      note_used(used, *opinion);
    }
  }
  std::vector<T> result;
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
    (*edit)->apply_to(result);
  }
  return result;
}

/// A field whose opinions combine, and where to note which of them do.
struct Combination {
  std::span<const compose::Opinion> opinions;
  Token field;
  UsedSpecs* used = nullptr;
};

template <class T>
bool fold_list(const Combination& of, const Value& strongest, Value& result) {
  if (!strongest.holds<layer::ListOp<T>>()) {
    return false;
  }
  result = layer::ListOp<T>::make_explicit(combined_list<T>(of.opinions, of.field, of.used));
  return true;
}

bool fold_any_list(const Combination& of, const Value& strongest, Value& result) {
  return fold_list<Token>(of, strongest, result) || fold_list<std::string>(of, strongest, result) ||
         fold_list<std::int32_t>(of, strongest, result) ||
         fold_list<std::int64_t>(of, strongest, result) ||
         fold_list<std::uint32_t>(of, strongest, result) ||
         fold_list<std::uint64_t>(of, strongest, result);
}

template <class T>
std::optional<FieldEffect> list_effect(const Value& value) {
  const auto* edit = value.get<layer::ListOp<T>>();
  return edit == nullptr ? std::nullopt
                         : std::optional(edit->is_explicit ? FieldEffect::ReplacesList
                                                           : FieldEffect::EditsList);
}

}  // namespace

FieldEffect field_effect(const Value& value) {
  if (value.holds<layer::Dictionary>() || value.holds<layer::VariantSelections>()) {
    return FieldEffect::MergesKeys;
  }
  const auto* specifier = value.get<layer::Specifier>();
  if (specifier != nullptr && *specifier == layer::Specifier::Over) {
    return FieldEffect::Declares;
  }
  for (const auto effect :
       {list_effect<Path>, list_effect<Token>, list_effect<std::string>,
        list_effect<layer::Reference>, list_effect<layer::Payload>, list_effect<std::int32_t>,
        list_effect<std::int64_t>, list_effect<std::uint32_t>, list_effect<std::uint64_t>}) {
    if (const std::optional<FieldEffect> found = effect(value)) {
      return *found;
    }
  }
  return FieldEffect::Decides;
}

bool is_structure(Token field) {
  using namespace layer::fields;
  static const std::unordered_set<Token> structure{inheritPaths,
                                                   payload,
                                                   references,
                                                   specializes,
                                                   subLayers,
                                                   subLayerOffsets,
                                                   variantSelection,
                                                   variantSetNames,
                                                   clips,
                                                   clipSets,
                                                   default_value,
                                                   timeSamples,
                                                   spline,
                                                   primChildren,
                                                   properties,
                                                   variantSetChildren,
                                                   variantChildren,
                                                   connectionChildren,
                                                   targetChildren,
                                                   "mapperChildren",
                                                   "expressionChildren",
                                                   "mapperArgChildren"};
  return structure.contains(field);
}

namespace {

bool type_means_same_anywhere(ValueType type) {
  switch (type) {
    case ValueType::Asset:
    case ValueType::TimeCode:
    case ValueType::PathExpression:
      return false;
    case ValueType::Permission:
    case ValueType::Specifier:
    case ValueType::Variability:
      return true;
    default:
      return layer::type_name_of(type, false) != nullptr && type != ValueType::Opaque;
  }
}

}  // namespace

bool means_same_anywhere(const Value& value) {
  static const auto kAnswers = [] {
    std::array<bool, std::numeric_limits<std::underlying_type_t<ValueType>>::max() + 1> answers{};
    for (std::size_t i = 0; i < answers.size(); ++i) {
      answers[i] = type_means_same_anywhere(static_cast<ValueType>(i));
    }
    return answers;
  }();
  return kAnswers[static_cast<std::size_t>(value.type())];
}

std::vector<compose::Opinion> property_opinions(const PrimData& prim, Token name) {
  std::vector<compose::Opinion> result;
  visit_property_opinions(prim, name, [&](const compose::Opinion& opinion) {
    result.push_back(opinion);
    return false;
  });
  return result;
}

Value localize(const StageData& stage, const PrimData& prim, const compose::Opinion& opinion,
               const Value& value, AssetForm form) {
  const Place place{stage, prim, opinion, form};
  switch (value.type()) {
    case ValueType::Asset:
      return value.is_array() ? localize_array(place, value)
                              : Value(resolved(place, *value.get<layer::AssetPath>()));
    case ValueType::TimeCode:
    case ValueType::Duration:
      return layer::moved_in_time(value, opinion.offset);
    case ValueType::ArrayEdit: {
      const auto& edit = *value.get<layer::ArrayEdit>();
      return layer::ArrayEdit{localize(stage, prim, opinion, edit.literals, form),
                              edit.instructions};
    }
    case ValueType::PathExpression:
      return value.is_array() ? localize_array(place, value)
                              : Value(mapped(place, *value.get<layer::PathExpression>()));
    case ValueType::Dictionary:
      return localize_dictionary(place, *value.get<layer::Dictionary>());
    default:
      return value;
  }
}

Value compose_field(const StageData& stage, const PrimData& prim,
                    std::span<const compose::Opinion> opinions, Token field, AssetForm form,
                    UsedSpecs* used) {
  Value result;
  for (const compose::Opinion& opinion : opinions) {
    const Value* value = opinion.spec->find(field);
    if (value == nullptr) {
      continue;
    }
    if (result.empty()) {
      if (fold_any_list({opinions, field, used}, *value, result)) {
        return result;
      }
      note_used(used, opinion);
      result = localize(stage, prim, opinion, *value, form);
      if (!result.holds<layer::Dictionary>()) {
        return result;
      }
    } else if (const auto* weaker = value->get<layer::Dictionary>()) {
      note_used(used, opinion);
      result = layer::merge(*result.get<layer::Dictionary>(),
                            localize_dictionary({stage, prim, opinion, form}, *weaker));
    }
  }
  return result;
}

std::map<std::string, Value> compose_metadata(const StageData& stage, const PrimData& prim,
                                              std::span<const compose::Opinion> opinions,
                                              AssetForm form) {
  std::map<std::string, Value> result;
  visit_metadata(stage, prim, opinions, form,
                 [&](Token name, Value value) { result.emplace(name.str(), std::move(value)); });
  return result;
}

}  // namespace tenon::stage
