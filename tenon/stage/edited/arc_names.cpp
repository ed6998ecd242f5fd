// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/edited/arc_names.h"

#include "tenon/layer/fields.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

/// Calls `visit` with each item of the list op in a field, whatever it says of it.
template <class T, class Visit>
void visit_items(const layer::Spec& spec, Token field, const Visit& visit) {
  if (const auto* op = spec.get<layer::ListOp<T>>(field)) {
    for (const auto* list :
         {&op->explicit_items, &op->prepended, &op->appended, &op->deleted, &op->added}) {
      for (const T& item : *list) {
        visit(item);
      }
    }
  }
}

}  // namespace

ArcNames::ArcNames(const std::vector<layer::LayerPtr>& layers) {
  for (const layer::LayerPtr& layer : layers) {
    const Token opens = layer->default_prim();  // a name, or a path
    if (const auto path =
            Path::parse(opens.view().starts_with('/') ? opens.str() : "/" + opens.str())) {
      add(*path);
    }
    any_ = any_ || layer->root().has(fields::layerRelocates);
    for (const layer::Layer::Entry& entry : layer->entries()) {
      if (entry.spec.kind == layer::SpecKind::Prim || entry.spec.kind == layer::SpecKind::Variant) {
        add_spec(entry.spec);
      }
    }
  }
}

void ArcNames::add_spec(const layer::Spec& spec) {
  any_ = any_ || spec.has(fields::relocates) || spec.has(fields::specializes);
  visit_items<Path>(spec, fields::inheritPaths, [this](Path path) { add(path); });
  visit_items<layer::Reference>(spec, fields::references,
                                [this](const layer::Reference& arc) { add(arc.prim_path); });
  visit_items<layer::Payload>(spec, fields::payload,
                              [this](const layer::Payload& arc) { add(arc.prim_path); });
}

void ArcNames::add(Path path) {
  for (; path.is_prim_or_variant(); path = path.parent()) {
    names_.insert(path.name());
  }
}

}  // namespace tenon::stage
