// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/composed_type.h"

#include "tenon/layer/fields.h"
#include "tenon/stage/composed_fields.h"

namespace tenon::stage {

using layer::Specifier;
namespace fields = layer::fields;

namespace {

/// The node, or one above it, is there because the prim itself inherits a class.
bool is_inherited(const compose::PrimIndex& index, std::uint32_t node) {
  for (; node != compose::kNoNode; node = index.nodes()[node].parent) {
    if (index.nodes()[node].arc == compose::ArcKind::Inherit &&
        !index.nodes()[node].due_to_ancestor) {
      return true;
    }
  }
  return false;
}

}  // namespace

/// What inherits a class is no class: `class` of an inherited one is weaker than any `def`.
Specifier composed_specifier(const compose::PrimIndex& index) {
  Specifier result = Specifier::Over;
  for (const compose::Opinion& opinion : index.opinions()) {
    const auto* specifier = opinion.spec->get<Specifier>(fields::specifier);
    if (specifier == nullptr || *specifier == Specifier::Over) {
      continue;
    }
    result = *specifier;
    if (result == Specifier::Def || !is_inherited(index, opinion.node)) {
      return result;
    }
  }
  return result;
}

bool is_active(const compose::PrimIndex& index) {
  const bool* active = strongest_opinion<bool>(index, layer::fields::active);
  return active == nullptr || *active;
}

Token composed_type_name(const compose::PrimIndex& index) {
  static const Token any_type{"__AnyType__"};
  for (const compose::Opinion& opinion : index.opinions()) {
    const auto* name = opinion.spec->get<Token>(fields::typeName);
    if (name != nullptr && !name->empty() && *name != any_type) {
      return *name;
    }
  }
  return {};
}

std::vector<Token> composed_api_schemas(const compose::PrimIndex& index) {
  for (const compose::Opinion& opinion : index.opinions()) {
    if (opinion.spec->has(fields::apiSchemas)) {
      return compose_list<Token>(index.opinions(), fields::apiSchemas);
    }
  }
  return {};
}

}  // namespace tenon::stage
