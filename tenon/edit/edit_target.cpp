// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/edit_target.h"

#include <vector>

#include "tenon/compose/prim_index.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/time/moved_in_time.h"
#include "tenon/stage/sources/opinion_sources.h"

namespace tenon::edit {
namespace {

using compose::MapFunction;
using layer::LayerOffset;
using layer::Value;

MapFunction variant_map(Path variant_path) {
  const Path root = Path::absolute_root();
  return MapFunction::make({{variant_path, variant_path.strip_variants()}, {root, root}});
}

/// Offset of a layer in its stack; identity for layers that are not in it.
LayerOffset offset_in(const compose::LayerStack& stack, const std::string& layer) {
  for (const compose::StackedLayer& stacked : stack.layers) {
    if (stacked.layer->identifier() == layer) {
      return stacked.offset;
    }
  }
  return {};
}

Value moved(const Value& value, const LayerOffset& by);

layer::Dictionary moved(layer::Dictionary dictionary, const LayerOffset& by) {
  for (auto& [name, value] : dictionary.items) {
    value = moved(value, by);
  }
  return dictionary;
}

Value moved(const Value& value, const LayerOffset& by) {
  if (const auto* dictionary = value.get<layer::Dictionary>()) {
    return moved(*dictionary, by);
  }
  return layer::moved_in_time(value, by);
}

}  // namespace

Path EditTarget::spec_path(Path scene_path) const { return map.map_target_to_source(scene_path); }

Path EditTarget::target_path(Path scene_path) const {
  return spec_path(scene_path).strip_variants();
}

Value EditTarget::layer_value(const Value& value) const {
  return map.offset().is_identity() ? value : moved(value, map.offset().inverse());
}

EditTarget layer_target(const compose::LayerStack& stack, const std::string& layer) {
  return {layer, MapFunction::identity().compose_offset(offset_in(stack, layer))};
}

EditTarget variant_target(std::string layer, Path variant_path) {
  return {std::move(layer), variant_map(variant_path)};
}

EditTarget node_target(const compose::PrimIndex& index, std::uint32_t node,
                       const std::string& layer) {
  const compose::Node& at = index.nodes()[node];
  MapFunction map = *at.map_to_root;
  if (at.path.has_variants()) {
    map = map.compose(variant_map(at.path));
  }
  return {layer, map.compose_offset(offset_in(*at.layer_stack, layer))};
}

EditTarget site_target(const stage::LayerSite& site, const std::string& layer) {
  EditTarget target = node_target(*site.index, site.node, layer);
  if (!site.shared_from.empty()) {
    const Path root = Path::absolute_root();
    target.map =
        MapFunction::make({{site.shared_as, site.shared_from}, {root, root}}).compose(target.map);
  }
  return target;
}

}  // namespace tenon::edit
