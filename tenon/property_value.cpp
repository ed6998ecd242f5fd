// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The one grammar for a property and its value. The type comes from what is there, for it decides
// how the text is read: 1 is a number, a word or a path. What no schema and no layer knows is most
// often a slip, so that it is an error which names what was probably meant.
#include "tenon/property_value.h"

#include <algorithm>
#include <utility>

#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/formats/text/write/value_text.h"
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
  const std::string nearest(nearest_name(property.view(), views));
  const std::vector<std::string> apis = apis_with(property);
  std::string fix =
      "tenon tree ASSET --attributes lists what there is; tenon set ASSET --type TYPE makes a new "
      "one";
  if (!nearest.empty()) {
    fix = "did you mean " + nearest + "?";
  } else if (!apis.empty()) {
    fix = "apply it: tenon set ASSET --apply " + prim.path().str() + "=" + apis.front();
  }
  return Error(ErrorCode::NotFound,
               where + " has no property " + property.str() +
                   (apis.empty() || !nearest.empty() ? "" : ": it belongs to " + apis.front()))
      .with_prim(prim.path().str())
      .with_rule("edit.no-property")
      .with_fix(fix);
}

Error bad_value(const PropertyAssignment& assignment, const std::string& type,
                const std::string& fix) {
  return Error(ErrorCode::Invalid, "\"" + assignment.value + "\" is not a value of type " + type)
      .with_prim(assignment.property.prim().str())
      .with_rule("edit.type-mismatch")
      .with_fix(fix);
}

std::string with_quotes(const std::string& type, const std::string& value) {
  const bool text = type == "token" || type == "string" || type == "pathExpression";
  if (text && !value.starts_with('"') && !value.starts_with('\'') && value != "None") {
    return quoted_text(value);
  }
  return type == "asset" && !value.starts_with('@') && value != "None" ? "@" + value + "@" : value;
}

Result<layer::Value> read_value(const PropertyAssignment& assignment, Token type_name,
                                const schema::PropertyDefinition* definition) {
  const layer::TypeName* type = layer::find_type_name(type_name);
  if (type == nullptr) {
    return Error(ErrorCode::Invalid, "no attribute type is called \"" + type_name.str() + "\"")
        .with_rule("edit.unknown-type")
        .with_fix("use a name such as float, double3, token[] or color3f");
  }
  auto value = formats::parse_value(with_quotes(type_name.str(), assignment.value), *type);
  if (!value) {
    return bad_value(assignment, type_name.str(),
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
      const std::string known = comma_list(allowed, &Token::str);
      return bad_value(assignment, "token of this schema", "choose one of: " + known);
    }
  }
  return value;
}

/// "</a>, </b>", "[/a, /b]", "/a": absolute paths of prims and properties; "None" and "" for none.
Result<std::vector<Path>> read_targets(const PropertyAssignment& assignment) {
  std::string text = assignment.value;
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return c == '<' || c == '>' || c == '[' || c == ']' || c == ','; }, ' ');
  std::vector<Path> targets;
  for (std::size_t at = text.find_first_not_of(' '); at != std::string::npos && text != "None";) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const auto path = Path::parse(text.substr(at, end - at));
    if (!path || !path->is_absolute()) {
      return bad_value(assignment, "rel", "write absolute paths: </hand/palm>, </hand/thumb>");
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

Error not_a_path(const std::string& text, const std::string& kind) {
  return Error(ErrorCode::Invalid, "\"" + text + "\" is not the absolute path of a " + kind)
      .with_rule("edit.bad-path")
      .with_fix("write it from the root, as in /hand/palm" +
                std::string(kind == "property" ? ".physics:mass" : "") +
                "; tenon tree lists all prims");
}

Result<PropertyAssignment> read_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" does not say what to set")
        .with_rule("usage.value")
        .with_fix("write PATH.attribute=VALUE, as in /World/Scene.physics:gravityMagnitude=1.62");
  }
  const char before = text[equals - 1];
  const AssignmentKind kind = before == '+'   ? AssignmentKind::Add
                              : before == '-' ? AssignmentKind::Remove
                                              : AssignmentKind::Whole;
  const std::string object = text.substr(0, kind == AssignmentKind::Whole ? equals : equals - 1);
  const auto path = Path::parse(object);
  if (!path || !path->is_absolute() || path->kind() != PathKind::Property) {
    return not_a_path(object, "property");
  }
  return PropertyAssignment{*path, text.substr(equals + 1), {}, kind};
}

Error not_a_list(Path property) {
  return Error(ErrorCode::Invalid,
               "<" + property.str() + "> is not a relationship: += and -= are for lists of targets")
      .with_prim(property.prim().str())
      .with_rule("edit.type-mismatch")
      .with_fix("write the whole value: =VALUE");
}

Result<PropertyValue> known_property(const stage::Prim& prim, Token name, Token type_name,
                                     const layer::Spec* spec) {
  const schema::PropertyDefinition* definition = prim.definition()->find(name);
  const bool known = definition != nullptr || prim.has_property(name) || spec != nullptr;
  if (!known && type_name.empty()) {
    return unknown_property(prim, name);
  }
  PropertyValue property;
  property.is_relationship = definition != nullptr
                                 ? definition->is_relationship
                                 : prim.is_relationship(name) || type_name == "rel";
  // Bindings for one purpose are of MaterialBindingAPI, which declares the plain one alone.
  const bool binding = name.view().starts_with("material:binding:");
  // Transforms are Xformable's, which declares their order alone.
  const bool transform = name.view().starts_with("xformOp:");
  property.custom = definition == nullptr && !binding && !transform;
  property.variability =
      definition == nullptr ? layer::Variability::Varying : definition->variability;
  if (property.is_relationship) {
    return property;
  }
  const auto* own = spec == nullptr ? nullptr : spec->get<Token>(fields::typeName);
  property.type_name = own != nullptr            ? *own
                       : definition != nullptr   ? definition->type_name
                       : prim.has_property(name) ? authored_type(prim.attribute(name))
                                                 : type_name;
  return property;
}

Result<PropertyValue> read_property_value(const stage::Prim& prim,
                                          const PropertyAssignment& assignment,
                                          const layer::Spec* spec) {
  const Token name = assignment.property.name();
  TENON_TRY(PropertyValue property, known_property(prim, name, assignment.type_name, spec));
  if (property.is_relationship) {
    TENON_TRY(property.targets, read_targets(assignment));
  } else {
    TENON_TRY(property.value,
              read_value(assignment, property.type_name, prim.definition()->find(name)));
  }
  return property;
}

}  // namespace tenon
