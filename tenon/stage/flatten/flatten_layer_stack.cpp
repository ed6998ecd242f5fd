// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers are laid over each other from the weakest to the strongest, field by field. A stronger
// default hides weaker samples, as value resolution would.
#include <algorithm>

#include "tenon/layer/child_lists.h"
#include "tenon/layer/lists/fold_list_ops.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/stage/flatten/moved_to_stack.h"
#include "tenon/stage/stage_data.h"

namespace tenon::stage {
namespace {

using layer::ListOp;
using layer::Spec;
using layer::Value;
namespace fields = layer::fields;

template <class T>
bool contains(const std::vector<T>& list, const T& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

/// Types of items that list edits may hold.
template <class... T>
struct Types {};
using ListItems = Types<Token, std::string, Path, layer::Reference, layer::Payload, std::int32_t,
                        std::int64_t, std::uint32_t, std::uint64_t>;

template <class T>
bool combine_lists(Value& stronger, const Value& weaker) {
  const auto* a = stronger.get<ListOp<T>>();
  const auto* b = weaker.get<ListOp<T>>();
  if (a == nullptr || b == nullptr) {
    return false;
  }
  if (auto folded = layer::fold(*a, *b)) {
    stronger = std::move(*folded);
  }
  return true;
}

template <class... T>
void combine_any_lists(Value& stronger, const Value& weaker, Types<T...>) {
  (combine_lists<T>(stronger, weaker) || ...);
}

template <class T>
bool drop_legacy(Value& value) {
  const auto* op = value.get<ListOp<T>>();
  if (op != nullptr && op->has_legacy()) {
    value = op->without_legacy();
  }
  return op != nullptr;
}

/// Edits that depend on the list below them cannot be combined.
template <class... T>
Value combinable(Value value, Types<T...>) {
  (drop_legacy<T>(value) || ...);
  return value;
}

bool is_weak(Token field, const Value& value) {
  if (field == fields::specifier) {
    return value.get_or(layer::Specifier::Over) == layer::Specifier::Over;
  }
  return field == fields::typeName && value.get_or(Token()).empty();
}

Value composed(Token field, Value stronger, const Value& weaker) {
  if (is_weak(field, stronger)) {
    return weaker;
  }
  if (layer::is_child_list(field)) {
    const auto* below = weaker.get<std::vector<Token>>();
    const auto* above = stronger.get<std::vector<Token>>();
    if (below != nullptr && above != nullptr) {
      std::vector<Token> names = *below;
      std::copy_if(above->begin(), above->end(), std::back_inserter(names),
                   [&](Token name) { return !contains(*below, name); });
      return names;
    }
  }
  const auto* dictionary = stronger.get<layer::Dictionary>();
  if (dictionary != nullptr && weaker.holds<layer::Dictionary>()) {
    return layer::merge(*dictionary, *weaker.get<layer::Dictionary>());
  }
  const auto* selections = stronger.get<layer::VariantSelections>();
  if (selections != nullptr && weaker.holds<layer::VariantSelections>()) {
    layer::VariantSelections merged = *selections;
    merged.items.insert(weaker.get<layer::VariantSelections>()->items.begin(),
                        weaker.get<layer::VariantSelections>()->items.end());
    return merged;
  }
  const auto* relocates = stronger.get<layer::Relocates>();
  if (relocates != nullptr && weaker.holds<layer::Relocates>()) {
    layer::Relocates both = *relocates;
    const auto& below = weaker.get<layer::Relocates>()->pairs;
    both.pairs.insert(both.pairs.end(), below.begin(), below.end());
    return both;
  }
  combine_any_lists(stronger, weaker, ListItems());
  return stronger;
}

// Each layer orders the children that it and weaker ones name.
void order_children(const Spec& layer_spec, Spec& merged) {
  const std::vector<Token>& order = layer::Layer::children(layer_spec, fields::primOrder);
  if (order.empty()) {
    return;
  }
  std::vector<Token> names = layer::Layer::children(merged, fields::primChildren);
  ListOp<Token> edit;
  edit.ordered = order;
  edit.apply_to(names);
  merged.set(fields::primChildren, std::move(names));
}

// Values of attributes stay even where their type is unknown.
bool is_dropped(const layer::Field& field) {
  return field.name == fields::subLayers || field.name == fields::subLayerOffsets ||
         (field.value.holds<layer::UnregisteredValue>() && field.name != fields::default_value);
}

void lay_over(layer::Layer& result, const layer::Layer::Entry& entry, const StackMover& mover) {
  const Spec* weaker = result.find(entry.path);
  if (weaker != nullptr &&
      (weaker->kind != entry.spec.kind ||
       weaker->get_or(fields::typeName, Token()) != entry.spec.get_or(fields::typeName, Token()))) {
    result.set_may_lack_text();  // values of one may stand under the type of the other
  }
  Spec merged = weaker == nullptr ? Spec() : *weaker;
  merged.kind = entry.spec.kind;
  if (entry.spec.has(fields::default_value)) {
    merged.erase(fields::timeSamples);
    merged.erase(fields::spline);
  }
  // Every property says whether it is custom, if only by silence.
  merged.erase(fields::custom);
  for (const layer::Field& field : entry.spec.fields()) {
    if (is_dropped(field)) {
      continue;
    }
    const Value* below = merged.find(field.name);
    Value value = combinable(mover.moved(field.name, field.value), ListItems());
    if (below != nullptr) {
      value = composed(field.name, std::move(value), *below);
    }
    merged.set(field.name, std::move(value));
  }
  order_children(entry.spec, merged);
  result.create(entry.path, entry.spec.kind) = std::move(merged);
}

}  // namespace

layer::Layer flatten_layer_stack(const Stage& stage) {
  layer::Layer result("anon:flattened.usda");
  const compose::LayerStack& stack = stage.layer_stack();
  for (auto item = stack.layers.rbegin(); item != stack.layers.rend(); ++item) {
    const StackMover mover(stage.data(), *item);
    if (item->layer->may_lack_text()) {
      result.set_may_lack_text();
    }
    for (const layer::Layer::Entry& entry : item->layer->entries()) {
      if (!entry.path.empty()) {
        lay_over(result, entry, mover);
      }
    }
  }
  return result;
}

}  // namespace tenon::stage
