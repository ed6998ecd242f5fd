// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edit_value.h"

#include <algorithm>

#include "tenon/base/text/nearest_name.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/schema/registry.h"

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

Result<void> check_api(const stage::Prim& prim, Token api) {
  const auto [name, instance] = schema::split_api_name(api);
  const schema::Schema* schema = schema::Registry::instance().find(name);
  const auto invalid = [&](const std::string& message, const std::string& fix) {
    return Error(ErrorCode::Invalid, message)
        .with_prim(prim.path().str())
        .with_rule("edit.unknown-schema")
        .with_fix(fix);
  };
  if (schema == nullptr || !schema->is_applied_api()) {
    std::vector<std::string_view> names;
    for (const schema::Schema* known : schema::Registry::instance().schemas()) {
      if (known->is_applied_api()) {
        names.push_back(known->name.view());
      }
    }
    const std::string nearest(nearest_name(name.view(), names));
    return invalid("no API schema is called \"" + name.str() + "\"",
                   nearest.empty() ? "tenon cat shows what other prims have"
                                   : "did you mean " + nearest + "?");
  }
  const bool multiple = schema->kind == schema::SchemaKind::MultipleApplyApi;
  if (multiple == instance.empty()) {
    return invalid(
        multiple ? name.str() + " is applied with a name of its own"
                 : name.str() + " is applied without a name",
        multiple ? "write " + name.str() + ":angular, or another name" : "write " + name.str());
  }
  const auto& types = schema->can_only_apply_to;
  const bool fits = types.empty() || std::any_of(types.begin(), types.end(),
                                                 [&](Token type) { return prim.is_a(type); });
  return fits ? Result<void>()
              : invalid(name.str() + " is not for a " + prim.type_name().str(),
                        "apply it to a " + types.front().str());
}

}  // namespace tenon
