// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/edit_value.h"

#include <algorithm>

#include "tenon/check/nearest_name.h"
#include "tenon/formats/text/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/type_names.h"
#include "tenon/schema/registry.h"

namespace tenon {
namespace {

namespace fields = layer::fields;

/// "physics:mass" -> the API schemas that declare it, with the instance that the name asks for.
std::vector<std::string> apis_with(Token property) {
  constexpr std::string_view kInstance = "__INSTANCE_NAME__";
  std::vector<std::string> names;
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    for (const schema::PropertyDefinition& declared : schema->properties) {
      const std::string& name = declared.name.str();
      const std::size_t at = name.find(kInstance);
      if (!schema->is_applied_api() || (at == std::string::npos && name != property.str())) {
        continue;
      }
      if (at == std::string::npos) {
        names.push_back(schema->name.str());
        continue;
      }
      const std::string head = name.substr(0, at);
      const std::string tail = name.substr(at + kInstance.size());
      const std::string& asked = property.str();
      if (asked.size() > head.size() + tail.size() && asked.starts_with(head) &&
          asked.ends_with(tail)) {
        names.push_back(schema->name.str() + ":" +
                        asked.substr(head.size(), asked.size() - head.size() - tail.size()));
      }
    }
  }
  return names;
}

Error unknown_property(const stage::Prim& prim, Token property) {
  const std::string where = "<" + prim.path().str() + ">";
  std::vector<Token> names = prim.definition()->property_names(true);
  const auto authored = prim.authored_property_names();
  names.insert(names.end(), authored.begin(), authored.end());
  std::vector<std::string_view> views;
  for (const Token& name : names) {
    views.push_back(name.view());
  }
  const std::string nearest(check::nearest_name(property.view(), views));
  const std::vector<std::string> apis = apis_with(property);
  std::string fix = "tenon tree --attributes lists what there is; --type TYPE makes a new one";
  if (!nearest.empty()) {
    fix = "did you mean " + nearest + "?";
  } else if (!apis.empty()) {
    fix = "add --apply " + prim.path().str() + "=" + apis.front();
  }
  return Error(ErrorCode::NotFound,
               where + " has no property " + property.str() +
                   (apis.empty() || !nearest.empty() ? "" : ": it belongs to " + apis.front()))
      .with_prim(prim.path().str())
      .with_rule("edit.no-property")
      .with_fix(fix);
}

Error bad_value(const AssetEdit& edit, const std::string& type, const std::string& fix) {
  return Error(ErrorCode::Invalid, "\"" + edit.value + "\" is not a value of type " + type)
      .with_prim(edit.object.prim().str())
      .with_rule("edit.type-mismatch")
      .with_fix(fix);
}

std::string with_quotes(const std::string& type, const std::string& value) {
  const bool text = type == "token" || type == "string" || type == "pathExpression";
  if (text && !value.starts_with('"') && !value.starts_with('\'') && value != "None") {
    return quoted(value);
  }
  return type == "asset" && !value.starts_with('@') && value != "None" ? "@" + value + "@" : value;
}

Result<layer::Value> read_value(const AssetEdit& edit, Token type_name,
                                const schema::PropertyDefinition* definition) {
  const layer::TypeName* type = layer::find_type_name(type_name);
  if (type == nullptr) {
    return Error(ErrorCode::Invalid, "no attribute type is called \"" + type_name.str() + "\"")
        .with_rule("edit.unknown-type")
        .with_fix("use a name such as float, double3, token[] or color3f");
  }
  auto value = formats::parse_value(with_quotes(type_name.str(), edit.value), *type);
  if (!value) {
    return bad_value(edit, type_name.str(),
                     type->is_array
                         ? "write it as [1, 2, 3]"
                         : "write it as a text layer has it, for example " +
                               formats::value_text(definition == nullptr ? layer::Value(1.0)
                                                                         : definition->fallback));
  }
  const auto* token = value->get<Token>();
  if (token != nullptr && definition != nullptr && !definition->allowed_tokens.empty()) {
    const auto& allowed = definition->allowed_tokens;
    if (std::find(allowed.begin(), allowed.end(), *token) == allowed.end()) {
      std::string known;
      for (const Token& name : allowed) {
        known += (known.empty() ? "" : ", ") + name.str();
      }
      return bad_value(edit, "token of this schema", "choose one of: " + known);
    }
  }
  return value;
}

/// "</a>, </b>", "[/a, /b]", "/a": absolute paths of prims and properties; "None" and "" for none.
Result<std::vector<Path>> read_targets(const AssetEdit& edit) {
  std::string text = edit.value;
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return c == '<' || c == '>' || c == '[' || c == ']' || c == ','; }, ' ');
  std::vector<Path> targets;
  for (std::size_t at = text.find_first_not_of(' '); at != std::string::npos && text != "None";) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const auto path = Path::parse(text.substr(at, end - at));
    if (!path || !path->is_absolute()) {
      return bad_value(edit, "rel", "write absolute paths: </hand/palm>, </hand/thumb>");
    }
    targets.push_back(*path);
    at = text.find_first_not_of(' ', end);
  }
  return targets;
}

/// The type that the strongest layer gives an attribute.
Token authored_type(const stage::Attribute& attribute) {
  for (const stage::SpecSite& site : attribute.spec_stack()) {
    if (const auto* name = site.spec->get<Token>(fields::typeName)) {
      return *name;
    }
  }
  return {};
}

}  // namespace

Result<TypedEdit> typed_edit(const stage::Prim& prim, const AssetEdit& edit,
                             const layer::Spec* spec) {
  const Token name = edit.object.name();
  const schema::PropertyDefinition* definition = prim.definition()->find(name);
  const bool known = definition != nullptr || prim.has_property(name) || spec != nullptr;
  if (!known && edit.type_name.empty()) {
    return unknown_property(prim, name);
  }
  TypedEdit typed;
  typed.is_relationship = definition != nullptr
                              ? definition->is_relationship
                              : prim.is_relationship(name) || edit.type_name == "rel";
  // Bindings for one purpose are of MaterialBindingAPI, which declares the plain one alone.
  const bool binding = name.view().starts_with("material:binding:");
  typed.custom = definition == nullptr && !binding;
  typed.variability = definition == nullptr ? layer::Variability::Varying : definition->variability;
  if (typed.is_relationship) {
    TENON_TRY(typed.targets, read_targets(edit));
    return typed;
  }
  const auto* own = spec == nullptr ? nullptr : spec->get<Token>(fields::typeName);
  typed.type_name = own != nullptr            ? *own
                    : definition != nullptr   ? definition->type_name
                    : prim.has_property(name) ? authored_type(prim.attribute(name))
                                              : edit.type_name;
  if (edit.kind == AssetEdit::Kind::SetProperty) {
    TENON_TRY(typed.value, read_value(edit, typed.type_name, definition));
  }
  return typed;
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

bool is_as_asked(const stage::Prim& prim, const AssetEdit& edit, const TypedEdit& typed) {
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
    const std::string nearest(check::nearest_name(name.view(), names));
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
