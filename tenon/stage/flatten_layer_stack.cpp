// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Layers are laid over each other from the weakest to the strongest, field by field. Times move
// by the offset of their layer, asset paths become what they resolve to. A stronger default hides
// weaker samples, as value resolution would.
#include <algorithm>

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

template <class T>
ListOp<T> combined(const ListOp<T>& stronger, const ListOp<T>& weaker) {
  if (stronger.is_explicit) {
    return stronger;
  }
  if (weaker.is_explicit) {
    std::vector<T> items = weaker.explicit_items;
    stronger.apply_to(items);
    return ListOp<T>::make_explicit(std::move(items));
  }
  const auto decided = [&](const T& item) {
    return contains(stronger.prepended, item) || contains(stronger.appended, item) ||
           contains(stronger.deleted, item);
  };
  ListOp<T> result = stronger;
  for (const T& item : weaker.prepended) {
    if (!decided(item)) {
      result.prepended.push_back(item);
    }
  }
  std::vector<T> appended;
  for (const T& item : weaker.appended) {
    if (!decided(item)) {
      appended.push_back(item);
    }
  }
  result.appended.insert(result.appended.begin(), appended.begin(), appended.end());
  for (const T& item : weaker.deleted) {
    if (!decided(item)) {
      result.deleted.push_back(item);
    }
  }
  for (const T& item : weaker.added) {
    if (!decided(item) && !contains(result.added, item)) {
      result.added.push_back(item);
    }
  }
  return result;
}

template <class T>
bool combine_lists(Value& stronger, const Value& weaker) {
  const auto* a = stronger.get<ListOp<T>>();
  const auto* b = weaker.get<ListOp<T>>();
  if (a == nullptr || b == nullptr) {
    return false;
  }
  stronger = combined(*a, *b);
  return true;
}

bool combine_any_lists(Value& stronger, const Value& weaker) {
  return combine_lists<Token>(stronger, weaker) || combine_lists<std::string>(stronger, weaker) ||
         combine_lists<Path>(stronger, weaker) ||
         combine_lists<layer::Reference>(stronger, weaker) ||
         combine_lists<layer::Payload>(stronger, weaker) ||
         combine_lists<std::int32_t>(stronger, weaker) ||
         combine_lists<std::int64_t>(stronger, weaker) ||
         combine_lists<std::uint32_t>(stronger, weaker) ||
         combine_lists<std::uint64_t>(stronger, weaker);
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
  combine_any_lists(stronger, weaker);
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
    for (auto* list : {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added,
                       &op.ordered}) {
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
    Value value = mover.moved(field.value);
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
