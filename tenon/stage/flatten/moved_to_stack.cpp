// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/flatten/moved_to_stack.h"

#include "tenon/compose/expressions/variable_expression.h"
#include "tenon/layer/time/moved_in_time.h"
#include "tenon/stage/composed_fields.h"
#include "tenon/stage/values/evaluate_spline.h"

namespace tenon::stage {

using layer::Value;
namespace fields = layer::fields;

std::string StackMover::located(const std::string& asset) const {
  const bool is_expression = compose::is_variable_expression(asset);
  const std::string path =
      is_expression
          ? compose::evaluate_text(asset, stage_.cache->layer_stack()->expression_variables).text
          : asset;
  return path.empty() ? path : anchored_asset(stage_, layer_, path);
}

Value StackMover::moved_assets(const Value& value) const {
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
  if (const auto* edit = value.get<layer::ArrayEdit>()) {
    return layer::ArrayEdit{moved_assets(edit->literals), edit->instructions};
  }
  return value;
}

Value StackMover::moved_times(const Value& value) const {
  // Nested dictionaries are as deep as the reader allows (limits::kTextNestingDepth).
  if (const auto* dictionary = value.get<layer::Dictionary>()) {
    layer::Dictionary result;
    for (const auto& [key, item] : dictionary->items) {
      result.items.emplace(key, moved_times(item));
    }
    return result;
  }
  return layer::moved_in_time(value, offset_);
}

layer::Dictionary StackMover::moved_clips(const layer::Dictionary& clips) const {
  layer::Dictionary result = clips;
  for (auto& [set, facts] : result.items) {
    const auto* dictionary = facts.get<layer::Dictionary>();
    if (dictionary == nullptr) {
      continue;
    }
    layer::Dictionary moved_facts;
    for (const auto& [key, value] : dictionary->items) {
      const auto* pairs = value.get<layer::Array<Vec2d>>();
      if (pairs == nullptr || (key != "active" && key != "times")) {
        const bool is_asset = key == "assetPaths" || key == "manifestAssetPath";
        moved_facts.items.emplace(key, is_asset ? moved_assets(value) : value);
        continue;
      }
      std::vector<Vec2d> moved_pairs(pairs->begin(), pairs->end());
      for (Vec2d& pair : moved_pairs) {
        pair[0] = offset_.apply(pair[0]);
      }
      moved_facts.items.emplace(key, std::move(moved_pairs));
    }
    facts = std::move(moved_facts);
  }
  return result;
}

layer::TimeSamples StackMover::moved_samples(const layer::TimeSamples& samples) const {
  layer::TimeSamples result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    result.set(offset_.apply(samples.times[i]), moved_times(moved_assets(samples.values[i])));
  }
  return result;
}

template <class Arc>
layer::ListOp<Arc> StackMover::moved_arcs(layer::ListOp<Arc> op) const {
  for (auto* list :
       {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added, &op.ordered}) {
    for (Arc& arc : *list) {
      arc.offset = offset_ * arc.offset;
      arc.asset_path = located(arc.asset_path);
    }
  }
  return op;
}

Value StackMover::moved(Token field, const Value& value) const {
  if (const auto* samples = value.get<layer::TimeSamples>()) {
    return moved_samples(*samples);
  }
  if (const auto* spline = value.get<layer::Spline>()) {
    return moved_spline(*spline, offset_);
  }
  if (const auto* references = value.get<layer::ListOp<layer::Reference>>()) {
    return moved_arcs(*references);
  }
  if (const auto* payloads = value.get<layer::ListOp<layer::Payload>>()) {
    return moved_arcs(*payloads);
  }
  const auto* dictionary = value.get<layer::Dictionary>();
  if (dictionary != nullptr && field == fields::clips) {
    return moved_clips(*dictionary);
  }
  return moved_times(moved_assets(value));
}

}  // namespace tenon::stage
