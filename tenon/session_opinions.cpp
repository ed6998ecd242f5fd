// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/session_opinions.h"

#include <algorithm>
#include <memory>

namespace tenon {
namespace {

namespace fields = layer::fields;

layer::Layer copy_of(const layer::LayerPtr& session) {
  return session == nullptr ? layer::Layer("anon:session.usda") : *session;
}

void add_name(layer::Spec& parent, Token field, Token name) {
  std::vector<Token> names = layer::Layer::children(parent, field);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    names.push_back(name);
    parent.set(field, std::move(names));
  }
}

// The prim spec at `path`, made of overs where absent.
layer::Spec& over(layer::Layer& layer, Path path) {
  for (const Path at : path.prefixes()) {
    if (at.is_absolute_root() || layer.has(at)) {
      continue;
    }
    layer.create(at, layer::SpecKind::Prim).set(fields::specifier, layer::Specifier::Over);
    add_name(layer.create(at.parent(), layer::SpecKind::Prim), fields::primChildren, at.name());
  }
  return layer.create(path, layer::SpecKind::Prim);
}

struct Assignment {
  Path property;
  std::string value;
};

Result<Assignment> read_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    auto path = Path::parse(text.substr(0, equals));
    if (path && path->is_absolute() && path->kind() == PathKind::Property) {
      return Assignment{*path, text.substr(equals + 1)};
    }
  }
  return Error(ErrorCode::Invalid, "`" + text + "` does not say what to set")
      .with_fix("write PATH.attribute=VALUE, as in /World/Scene.physics:gravityMagnitude=1.62");
}

std::string quoted(const std::string& type, const std::string& value) {
  const bool text = type == "token" || type == "string";
  if (text && !value.starts_with('"') && !value.starts_with('\'')) {
    std::string result = "\"";
    for (const char c : value) {
      result += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    }
    return result + "\"";
  }
  return type == "asset" && !value.starts_with('@') ? "@" + value + "@" : value;
}

Result<std::string> declaration(const stage::Stage& stage, const Assignment& assignment) {
  const Path path = assignment.property;
  const stage::Prim prim = stage.prim(path.parent());
  const Token name = path.name();
  if (!prim || !prim.has_property(name)) {
    return Error(ErrorCode::NotFound, prim ? "the prim has no property `" + name.str() + "`"
                                           : "there is no prim " + path.parent().str())
        .with_prim(path.parent().str())
        .with_fix("look at `tenon tree --attributes` for what there is");
  }
  if (prim.is_relationship(name)) {
    return "rel " + name.str() + " = " + assignment.value;
  }
  const stage::Attribute attribute = prim.attribute(name);
  const std::string type = attribute.type_name().str();
  const bool uniform = attribute.variability() == layer::Variability::Uniform;
  return (uniform ? "uniform " : "") + type + " " + name.str() + " = " +
         quoted(type, assignment.value);
}

Result<layer::Spec> read_property(const Assignment& assignment, const std::string& text,
                                  const TextReader& read_text) {
  Diagnostics diagnostics;
  auto snippet = read_text("#usda 1.0\nover \"P\"\n{\n    " + text + "\n}\n", "", diagnostics);
  const Path path = Path::from("/P").property(assignment.property.name());
  const layer::Spec* found = snippet ? snippet->find(path) : nullptr;
  if (found == nullptr) {
    return Error(ErrorCode::Invalid, "`" + assignment.value + "` cannot be read as a value of " +
                                         assignment.property.str())
        .with_fix("write it as a text layer would: " + text);
  }
  layer::Spec spec = *found;
  spec.line = spec.column = 0;
  return spec;
}

}  // namespace

Result<layer::LayerPtr> with_variant(const layer::LayerPtr& session, const layer::Layer& root,
                                     const std::string& set, const std::string& variant) {
  const std::string name = root.default_prim().str();
  const auto path = Path::parse(name.starts_with('/') ? name : "/" + name);
  if (name.empty() || !path) {
    return Error(ErrorCode::NotFound, "the layer names no default prim to select a variant on")
        .in_file(root.identifier())
        .with_fix("set defaultPrim in the layer's metadata");
  }
  layer::Layer layer = copy_of(session);
  layer::Spec& prim = over(layer, *path);
  auto selections = prim.get_or(fields::variantSelection, layer::VariantSelections());
  selections.items[set] = variant;
  prim.set(fields::variantSelection, std::move(selections));
  return layer::LayerPtr(std::make_shared<const layer::Layer>(std::move(layer)));
}

Result<layer::LayerPtr> with_overrides(const layer::LayerPtr& session, const stage::Stage& stage,
                                       const std::vector<std::string>& assignments,
                                       const TextReader& read_text) {
  layer::Layer layer = copy_of(session);
  for (const std::string& text : assignments) {
    TENON_TRY(const Assignment assignment, read_assignment(text));
    TENON_TRY(const std::string declared, declaration(stage, assignment));
    TENON_TRY(layer::Spec spec, read_property(assignment, declared, read_text));
    const Path path = assignment.property;
    layer::Spec& prim = over(layer, path.parent());
    add_name(prim, fields::properties, path.name());
    layer.create(path, spec.kind) = std::move(spec);
  }
  return layer::LayerPtr(std::make_shared<const layer::Layer>(std::move(layer)));
}

}  // namespace tenon
