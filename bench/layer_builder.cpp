// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/layer_builder.h"

#include <utility>

namespace tenon::bench {

using layer::SpecKind;
namespace fields = layer::fields;

Path LayerBuilder::prim(Path parent, Token name, Token type, layer::Specifier specifier) {
  const Path path = parent.child(name);
  layer::Spec& made = layer_.create(path, SpecKind::Prim);
  made.set(fields::specifier, specifier);
  if (!type.empty()) {
    made.set(fields::typeName, type);
  }
  children_[parent].prims.push_back(name);
  return path;
}

Path LayerBuilder::attribute(Path prim, Token name, Token type, layer::Value value,
                             layer::Variability variability, bool custom) {
  const Path path = prim.property(name);
  layer::Spec& made = layer_.create(path, SpecKind::Attribute);
  if (custom) {
    made.set(fields::custom, true);
  }
  made.set(fields::typeName, type);
  if (variability == layer::Variability::Uniform) {
    made.set(fields::variability, variability);
  }
  if (!value.empty()) {
    made.set(fields::default_value, std::move(value));
  }
  children_[prim].properties.push_back(name);
  return path;
}

Path LayerBuilder::relationship(Path prim, Token name, std::vector<Path> targets) {
  const Path path = prim.property(name);
  layer::Spec& made = layer_.create(path, SpecKind::Relationship);
  made.set(fields::variability, layer::Variability::Uniform);
  made.set(fields::targetPaths, layer::ListOp<Path>::make_explicit(std::move(targets)));
  children_[prim].properties.push_back(name);
  return path;
}

void LayerBuilder::apply(Path prim, std::vector<Token> schemas) {
  spec(prim).set(fields::apiSchemas, layer::ListOp<Token>::make_prepended(std::move(schemas)));
}

Path LayerBuilder::variant(Path prim, const std::string& set, const std::string& name) {
  const Path set_path = prim.variant_selection(set, Token());
  if (!layer_.has(set_path)) {
    layer_.create(set_path, SpecKind::VariantSet);
    children_[prim].variant_sets.push_back(set);
    std::vector<std::string> names;
    for (const Token& known : children_[prim].variant_sets) {
      names.push_back(known.str());
    }
    using Names = layer::ListOp<std::string>;
    spec(prim).set(fields::variantSetNames, Names::make_prepended(std::move(names)));
  }
  const Path path = prim.variant_selection(set, name);
  layer_.create(path, SpecKind::Variant);
  children_[set_path].variants.push_back(name);
  return path;
}

layer::Layer LayerBuilder::finish() {
  std::vector<std::pair<Path, Children>> lists;
  for (const layer::Layer::Entry& entry : layer_.entries()) {
    if (const auto found = children_.find(entry.path); found != children_.end()) {
      lists.emplace_back(entry.path, std::move(found->second));
    }
  }
  for (auto& [path, list] : lists) {
    layer::Spec& parent = spec(path);
    const std::pair<Token, std::vector<Token>*> rows[] = {
        {fields::primChildren, &list.prims},
        {fields::properties, &list.properties},
        {fields::variantSetChildren, &list.variant_sets},
        {fields::variantChildren, &list.variants},
    };
    for (const auto& [field, names] : rows) {
      if (!names->empty()) {
        parent.set(field, std::move(*names));
      }
    }
  }
  return std::move(layer_);
}

}  // namespace tenon::bench
