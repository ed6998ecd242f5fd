// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/composed_type.h"

#include "tenon/layer/fields.h"
#include "tenon/stage/composed_fields.h"

namespace tenon::stage {

using layer::Specifier;
namespace fields = layer::fields;

Specifier composed_specifier(const compose::PrimIndex& index) {
  Specifier result = Specifier::Over;
  for (const compose::Opinion& opinion : index.opinions) {
    const auto* specifier = opinion.spec->get<Specifier>(fields::specifier);
    if (specifier == nullptr || *specifier == Specifier::Over) {
      continue;
    }
    const compose::Node& node = index.nodes[opinion.node];
    const bool from_class_arc =
        (node.arc == compose::ArcKind::Inherit || node.arc == compose::ArcKind::Specialize) &&
        !node.due_to_ancestor;
    if (*specifier == Specifier::Class && from_class_arc) {
      result = Specifier::Class;
      continue;
    }
    return *specifier;
  }
  return result;
}

Token composed_type_name(const compose::PrimIndex& index) {
  static const Token any_type{"__AnyType__"};
  for (const compose::Opinion& opinion : index.opinions) {
    const auto* name = opinion.spec->get<Token>(fields::typeName);
    if (name != nullptr && !name->empty() && *name != any_type) {
      return *name;
    }
  }
  return {};
}

std::vector<Token> composed_api_schemas(const compose::PrimIndex& index) {
  for (const compose::Opinion& opinion : index.opinions) {
    if (opinion.spec->has(fields::apiSchemas)) {
      return compose_list<Token>(index.opinions, fields::apiSchemas);
    }
  }
  return {};
}

}  // namespace tenon::stage
