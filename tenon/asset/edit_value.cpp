// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edit_value.h"

#include <algorithm>

#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"

namespace tenon {

Result<PropertyValue> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                                 const layer::Spec* spec) {
  return edit.kind == AssetEdit::Kind::ClearProperty
             ? known_property(prim, edit.object.name(), edit.type_name, spec)
             : read_property_value(prim, {edit.object, edit.value, edit.type_name}, spec);
}

std::string composed_text(const stage::Prim& prim, Token property) {
  if (prim.is_relationship(property)) {
    std::string text;
    for (const Path& target : prim.relationship(property).targets()) {
      text += (text.empty() ? "<" : ", <") + target.str() + ">";
    }
    return text;
  }
  const layer::Value value = prim.attribute(property).get();
  return value.empty() ? std::string() : formats::value_text(value);
}

bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const PropertyValue& typed) {
  const Token name = edit.object.name();
  switch (edit.kind) {
    case AssetEdit::Kind::ApplyApi:
    case AssetEdit::Kind::RemoveApi: {
      const std::vector<Token> apis = prim.authored_api_schemas();
      const bool there = std::find(apis.begin(), apis.end(), edit.api) != apis.end();
      return there == (edit.kind == AssetEdit::Kind::ApplyApi);
    }
    case AssetEdit::Kind::ClearProperty:
      return true;
    case AssetEdit::Kind::AddTargets:
    case AssetEdit::Kind::RemoveTargets: {
      const std::vector<Path> targets = prim.relationship(name).targets();
      return std::all_of(typed.targets.begin(), typed.targets.end(), [&](Path target) {
        const bool there = std::find(targets.begin(), targets.end(), target) != targets.end();
        return there == (edit.kind == AssetEdit::Kind::AddTargets);
      });
    }
    case AssetEdit::Kind::DefinePrim:
      return prim.is_defined() && (prim.type_name() == edit.type_name ||
                                   (edit.arc && edit.type_name.empty()));  // what it brings in has
    case AssetEdit::Kind::AddVariant: {
      const std::size_t equals = edit.value.find('=');
      const auto names = prim.variant_names(edit.value.substr(0, equals));
      return std::find(names.begin(), names.end(), edit.value.substr(equals + 1)) != names.end();
    }
    case AssetEdit::Kind::RemoveVariant:
    case AssetEdit::Kind::RemovePrim:
    case AssetEdit::Kind::RenamePrim:
    case AssetEdit::Kind::RenameProperty:
    case AssetEdit::Kind::SetStageMetadata:
      return true;  // looked at where they are made
    case AssetEdit::Kind::SetProperty:
      break;
  }
  if (typed.is_relationship) {
    return prim.relationship(name).targets() == typed.targets;
  }
  const stage::Attribute attribute = prim.attribute(name);
  if (typed.value.is_block()) {
    return attribute.is_blocked();
  }
  // Asset paths come back resolved: what was authored counts.
  const layer::Value value = attribute.get();
  return value == typed.value || formats::value_text(value) == formats::value_text(typed.value);
}

}  // namespace tenon
