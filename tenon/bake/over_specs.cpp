// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/over_specs.h"

#include <algorithm>

namespace tenon::bake {
namespace {

void list_child(layer::Spec& parent, Token field, Token name) {
  std::vector<Token> names = parent.get_or(field, std::vector<Token>{});
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    names.push_back(name);
    parent.set(field, layer::Value(std::move(names)));
  }
}

}  // namespace

layer::Spec& over_prim(layer::Layer& layer, Path prim) {
  for (const Path& at : prim.prefixes()) {
    if (at.is_prim() && !layer.has(at)) {
      list_child(layer.create(at.parent(), layer::SpecKind::Prim), layer::fields::primChildren,
                 at.name());
      layer.create(at, layer::SpecKind::Prim)
          .set(layer::fields::specifier, layer::Value(layer::Specifier::Over));
    }
  }
  return layer.create(prim, layer::SpecKind::Prim);
}

layer::Spec& over_attribute(layer::Layer& layer, Path prim, Token name, Token type_name) {
  list_child(over_prim(layer, prim), layer::fields::properties, name);
  layer::Spec& spec = layer.create(prim.property(name), layer::SpecKind::Attribute);
  spec.set(layer::fields::typeName, layer::Value(type_name));
  return spec;
}

}  // namespace tenon::bake
