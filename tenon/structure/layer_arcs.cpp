// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/layer_arcs.h"

#include "tenon/layer/array_edit.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::structure {
namespace {

namespace fields = layer::fields;

template <class Item>
void add_items(const layer::Spec& spec, Path path, Token field, Arc kind,
               std::vector<LayerArc>& out) {
  const auto* op = spec.get<layer::ListOp<Item>>(field);
  if (op == nullptr) {
    return;
  }
  for (const auto* items : {&op->explicit_items, &op->added, &op->prepended, &op->appended}) {
    for (const Item& item : *items) {
      out.push_back({kind, item.asset_path, item.prim_path, path, spec.line});
    }
  }
}

void add_asset(const layer::Value& value, const layer::Spec& spec, Path path,
               std::vector<LayerArc>& out) {
  if (const auto* asset = value.get<layer::AssetPath>()) {
    out.push_back({Arc::Asset, asset->authored, Path(), path, spec.line});
  } else if (const auto* assets = value.get<layer::Array<layer::AssetPath>>()) {
    for (const layer::AssetPath& one : *assets) {
      out.push_back({Arc::Asset, one.authored, Path(), path, spec.line});
    }
  } else if (const auto* edit = value.get<layer::ArrayEdit>()) {
    add_asset(edit->literals, spec, path, out);
  }
}

void add_assets(const layer::Spec& spec, Path path, std::vector<LayerArc>& out) {
  if (const layer::Value* value = spec.find(fields::default_value)) {
    add_asset(*value, spec, path, out);
  }
  if (const auto* samples = spec.get<layer::TimeSamples>(fields::timeSamples)) {
    for (const layer::Value& value : samples->values) {
      add_asset(value, spec, path, out);
    }
  }
}

}  // namespace

StatementPart LayerArc::part() const {
  const std::string item = layer::item_text(asset_path, kind == Arc::Asset ? Path() : target);
  switch (kind) {
    case Arc::SubLayer:
      return layer::item_part(fields::subLayers, item);
    case Arc::Payload:
      return layer::item_part(fields::payload, item);
    case Arc::Asset:
      return layer::item_part(fields::default_value, item);
    default:
      return layer::item_part(fields::references, item);
  }
}

std::vector<LayerArc> arcs_of(const layer::Layer& layer, bool assets) {
  std::vector<LayerArc> arcs;
  for (const std::string& name : layer.sublayers()) {
    arcs.push_back({Arc::SubLayer, name, Path(), Path::absolute_root(), layer.root().line});
  }
  for (const layer::Layer::Entry& entry : layer.entries()) {
    if (entry.path.empty()) {
      continue;
    }
    const layer::Spec& spec = entry.spec;
    if (spec.kind == layer::SpecKind::Prim || spec.kind == layer::SpecKind::Variant) {
      add_items<layer::Reference>(spec, entry.path, fields::references, Arc::Reference, arcs);
      add_items<layer::Payload>(spec, entry.path, fields::payload, Arc::Payload, arcs);
    } else if (assets && spec.kind == layer::SpecKind::Attribute) {
      add_assets(spec, entry.path, arcs);
    }
  }
  return arcs;
}

}  // namespace tenon::structure
