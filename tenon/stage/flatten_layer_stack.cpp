// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers are laid over each other from the weakest to the strongest, field by field. Times move
// by the offset of their layer, asset paths become what they resolve to. A stronger default hides
// weaker samples, as value resolution would.
#include <algorithm>

#include "tenon/layer/fold_list_ops.h"
#include "tenon/stage/flatten.h"
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
bool drop_edits_of_what_is_below(Value& value) {
  const auto* op = value.get<ListOp<T>>();
  if (op == nullptr || (op->added.empty() && op->ordered.empty())) {
    return op != nullptr;
  }
  ListOp<T> result = *op;
  std::copy_if(op->added.begin(), op->added.end(), std::back_inserter(result.appended),
               [&](const T& item) { return !contains(op->appended, item); });
  result.added.clear();
  result.ordered.clear();
  value = std::move(result);
  return true;
}

/// Edits that depend on the list below them cannot be combined: as OpenUSD does, added items are
/// appended and orders dropped.
template <class... T>
Value combinable(Value value, Types<T...>) {
  (drop_edits_of_what_is_below<T>(value) || ...);
  return value;
}

bool is_children_field(Token field) {
  return field == fields::primChildren || field == fields::properties ||
         field == fields::variantSetChildren || field == fields::variantChildren;
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
  if (is_children_field(field)) {
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
  combine_any_lists(stronger, weaker, ListItems());
  return stronger;
}

// Values of one layer in the time and from the place of the flattened one.
class Mover {
 public:
  Mover(const StageData& stage, const compose::StackedLayer& layer)
      : stage_(stage), layer_(*layer.layer), offset_(layer.offset) {}

  Value moved(const Value& value) const {
    if (const auto* asset = value.get<layer::AssetPath>()) {
      return layer::AssetPath{located(asset->authored), {}, {}};
    }
    if (const auto* assets = value.get<std::vector<layer::AssetPath>>()) {
      std::vector<layer::AssetPath> result;
      for (const layer::AssetPath& asset : *assets) {
        result.push_back({located(asset.authored), {}, {}});
      }
      return result;
    }
    if (const auto* dictionary = value.get<layer::Dictionary>()) {
      layer::Dictionary result;
      for (const auto& [key, item] : dictionary->items) {
        result.items.emplace(key, moved(item));
      }
      return result;
    }
    if (const auto* time = value.get<layer::TimeCode>()) {
      return layer::TimeCode{offset_.apply(time->value)};
    }
    if (const auto* samples = value.get<layer::TimeSamples>()) {
      return moved_samples(*samples);
    }
    if (const auto* references = value.get<ListOp<layer::Reference>>()) {
      return moved_arcs(*references);
    }
    const auto* payloads = value.get<ListOp<layer::Payload>>();
    return payloads == nullptr ? value : Value(moved_arcs(*payloads));
  }

 private:
  std::string located(const std::string& asset) const {
    std::string found;
    if (!asset.empty() && stage_.options.resolve_asset) {
      found = stage_.options.resolve_asset(asset, layer_);
    }
    return found.empty() ? asset : found;
  }

  layer::TimeSamples moved_samples(const layer::TimeSamples& samples) const {
    layer::TimeSamples result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      result.set(offset_.apply(samples.times[i]), moved(samples.values[i]));
    }
    return result;
  }

  template <class T>
  ListOp<T> moved_arcs(ListOp<T> op) const {
    for (auto* list :
         {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added, &op.ordered}) {
      for (T& arc : *list) {
        arc.offset = offset_ * arc.offset;
        arc.asset_path = arc.asset_path.empty() ? arc.asset_path : located(arc.asset_path);
      }
    }
    return op;
  }

  const StageData& stage_;
  const layer::Layer& layer_;
  layer::LayerOffset offset_;
};

void lay_over(layer::Layer& result, const layer::Layer::Entry& entry, const Mover& mover) {
  const Spec* weaker = result.find(entry.path);
  Spec merged = weaker == nullptr ? Spec() : *weaker;
  merged.kind = entry.spec.kind;
  if (entry.spec.has(fields::default_value)) {
    merged.erase(fields::timeSamples);
    merged.erase(fields::spline);
  }
  for (const layer::Field& field : entry.spec.fields()) {
    if (field.name == fields::subLayers || field.name == fields::subLayerOffsets) {
      continue;
    }
    const Value* below = merged.find(field.name);
    Value value = combinable(mover.moved(field.value), ListItems());
    if (below != nullptr) {
      value = composed(field.name, std::move(value), *below);
    }
    merged.set(field.name, std::move(value));
  }
  result.create(entry.path, entry.spec.kind) = std::move(merged);
}

}  // namespace

layer::Layer flatten_layer_stack(const Stage& stage) {
  layer::Layer result("anon:flattened.usda");
  const compose::LayerStack& stack = stage.layer_stack();
  const auto root = std::find_if(stack.layers.begin(), stack.layers.end(), [&](const auto& item) {
    return item.layer.get() == &stage.root_layer();
  });
  for (auto item = stack.layers.end(); item != root;) {
    --item;
    const Mover mover(stage.data(), *item);
    // Metadata of the stage is the root layer's alone.
    for (const layer::Layer::Entry& entry : item->layer->entries()) {
      if (entry.path.empty()) {
        continue;
      }
      if (!entry.path.is_absolute_root() || item == root) {
        lay_over(result, entry, mover);
      } else {
        const std::vector<Token>& names = layer::Layer::children(entry.spec, fields::primChildren);
        const Value below = layer::Layer::children(result.root(), fields::primChildren);
        result.root().set(fields::primChildren, composed(fields::primChildren, names, below));
      }
    }
  }
  return result;
}

}  // namespace tenon::stage
