// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/arcs/authored_arc.h"

#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/finding_place.h"

namespace tenon::compose {
namespace {

namespace fields = layer::fields;

Token field_of(ArcKind kind) {
  switch (kind) {
    case ArcKind::Inherit:
      return fields::inheritPaths;
    case ArcKind::Specialize:
      return fields::specializes;
    case ArcKind::Payload:
      return fields::payload;
    default:
      return fields::references;
  }
}

template <class Item, class Visit>
bool visit_items(const layer::ListOp<Item>& op, Visit visit) {
  for (const auto* items : {&op.explicit_items, &op.prepended, &op.appended, &op.added}) {
    for (const Item& item : *items) {
      if (visit(item)) {
        return true;
      }
    }
  }
  return false;
}

/// Text of the first item that `visit` takes; empty when none is.
template <class Item, class Visit>
std::string find_item(const layer::Spec& spec, Token field, Visit visit) {
  std::string text;
  if (const auto* op = spec.get<layer::ListOp<Item>>(field)) {
    visit_items(*op, [&](const Item& item) {
      const bool is_it = visit(item);
      if (is_it) {
        text = layer::item_text(item);
      }
      return is_it;
    });
  }
  return text;
}

template <class Item>
std::string item_to(const layer::Spec& spec, Token field, Path target) {
  return find_item<Item>(spec, field, [&](const Item& item) {
    return item.prim_path == target || item.prim_path.empty();
  });
}

template <class Item>
std::string item_of(const layer::Spec& spec, Token field, const AssetArc& arc) {
  std::string text = find_item<Item>(spec, field, [&](const Item& item) {
    return item.asset_path == arc.asset_path && item.prim_path == arc.prim_path;
  });
  return !text.empty() ? text : find_item<Item>(spec, field, [&](const Item& item) {
    return item.asset_path.starts_with('`') && item.prim_path == arc.prim_path;
  });
}

}  // namespace

AuthoredArc authored_arc(const LayerStack& stack, Path path, ArcKind kind, Path target) {
  const Token field = field_of(kind);
  for (const StackedLayer& stacked : stack.layers) {
    const layer::Spec* spec = stacked.layer->find(path);
    if (spec == nullptr) {
      continue;
    }
    const std::string item =
        kind == ArcKind::Reference ? item_to<layer::Reference>(*spec, field, target)
        : kind == ArcKind::Payload
            ? item_to<layer::Payload>(*spec, field, target)
            : find_item<Path>(*spec, field, [&](Path named) { return named == target; });
    if (!item.empty()) {
      return {stacked.layer.get(), layer::item_part(field, item)};
    }
  }
  return {};
}

StatementPart authored_item(const AssetArc& arc, Path path, ArcKind kind) {
  const Token field = field_of(kind);
  const layer::Spec* spec = arc.layer == nullptr ? nullptr : arc.layer->find(path);
  if (spec == nullptr) {
    return layer::field_part(field);
  }
  return layer::item_part(field, kind == ArcKind::Payload
                                     ? item_of<layer::Payload>(*spec, field, arc)
                                     : item_of<layer::Reference>(*spec, field, arc));
}

}  // namespace tenon::compose
