// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/edit/composed_view.h"

#include <algorithm>

#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/schema/registry.h"
#include "tenon/stage/composed_type.h"

namespace tenon::edit {

using layer::Specifier;
using layer::SpecKind;
namespace fields = layer::fields;

layer::LayerPtr ComposedView::layer(const std::string& identifier) const {
  for (const layer::LayerPtr& layer : cache_.used_layers()) {
    if (layer->identifier() == identifier) {
      return layer;
    }
  }
  return nullptr;
}

FoundPrim ComposedView::prim(Path path) {
  FoundPrim found;
  found.index = &cache_.index(Path::absolute_root());
  found.defined = true;
  for (const Path at : path.prefixes()) {
    if (at.is_absolute_root()) {
      continue;
    }
    const auto& names = found.index->child_names;
    if (std::find(names.begin(), names.end(), at.name()) == names.end()) {
      return {};
    }
    const bool* active = stage::strongest_opinion<bool>(*found.index, fields::active);
    if (active != nullptr && !*active) {
      return {};
    }
    found.below_instance = found.below_instance || found.index->instanceable;
    found.index = &cache_.child_index(*found.index, at.name());
    const Specifier specifier = stage::composed_specifier(*found.index);
    found.defined = found.defined && specifier != Specifier::Over;
    found.abstract = found.abstract || specifier == Specifier::Class;
  }
  return found;
}

FoundProperty ComposedView::property(const FoundPrim& prim, Token name) const {
  const schema::PrimDefinition definition(stage::composed_type_name(*prim.index),
                                          stage::composed_api_schemas(*prim.index));
  if (const schema::PropertyDefinition* declared = definition.find(name)) {
    if (declared->is_relationship) {
      return {SpecKind::Relationship, Token(), layer::Variability::Uniform, false};
    }
    return {SpecKind::Attribute, declared->type_name, declared->variability, false};
  }
  for (const compose::Opinion& opinion : prim.index->opinions()) {
    if (const layer::Spec* spec = opinion.layer->find(opinion.path.property(name))) {
      return {spec->kind, spec->get_or(fields::typeName, Token()),
              spec->get_or(fields::variability, spec->kind == SpecKind::Relationship
                                                    ? layer::Variability::Uniform
                                                    : layer::Variability::Varying),
              spec->get_or(fields::custom, false)};
    }
  }
  return {};
}

}  // namespace tenon::edit
