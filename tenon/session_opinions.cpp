// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/session_opinions.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "tenon/layer/field_values.h"
#include "tenon/property_value.h"

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

/// What a relationship has with the session so far, and this assignment.
std::vector<Path> targets_with(const stage::Prim& prim, const PropertyAssignment& assignment,
                               const layer::Layer& session, const std::vector<Path>& given) {
  if (assignment.kind == AssignmentKind::Whole) {
    return given;
  }
  std::vector<Path> targets = prim.relationship(assignment.property.name()).targets();
  const layer::Spec* own = session.find(assignment.property);
  if (const auto* op =
          own == nullptr ? nullptr : own->get<layer::ListOp<Path>>(fields::targetPaths)) {
    op->apply_to(targets);
  }
  assignment.kind == AssignmentKind::Add ? layer::append_absent(targets, given)
                                         : layer::remove_items(targets, given);
  return targets;
}

/// The spec that gives a property of the stage its value.
Result<layer::Spec> override_of(const stage::Stage& stage, const PropertyAssignment& assignment,
                                const layer::Layer& session) {
  const Path owner = assignment.property.parent();
  const stage::Prim prim = stage.prim(owner);
  if (!prim) {
    return Error(ErrorCode::NotFound, "there is no prim " + owner.str())
        .with_rule("edit.no-prim")
        .with_prim(owner.str())
        .with_fix("look at `tenon tree` for what there is");
  }
  TENON_TRY(PropertyValue property, read_property_value(prim, assignment, nullptr));
  layer::Spec spec;
  spec.kind = property.is_relationship ? layer::SpecKind::Relationship : layer::SpecKind::Attribute;
  if (property.is_relationship) {
    spec.set(fields::targetPaths, layer::Value(layer::ListOp<Path>::make_explicit(
                                      targets_with(prim, assignment, session, property.targets))));
    return spec;
  }
  if (assignment.kind != AssignmentKind::Whole) {
    return not_a_list(assignment.property);
  }
  spec.set(fields::typeName, layer::Value(property.type_name));
  if (property.variability != layer::Variability::Varying) {
    spec.set(fields::variability, layer::Value(property.variability));
  }
  spec.set(fields::default_value, std::move(property.value));
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
  return with_variant(session, *path, set, variant);
}

layer::LayerPtr with_variant(const layer::LayerPtr& session, Path prim, const std::string& set,
                             const std::string& variant) {
  layer::Layer layer = copy_of(session);
  layer::Spec& spec = over(layer, prim);
  auto selections = spec.get_or(fields::variantSelection, layer::VariantSelections());
  selections.items[set] = variant;
  spec.set(fields::variantSelection, std::move(selections));
  return std::make_shared<const layer::Layer>(std::move(layer));
}

Result<layer::LayerPtr> with_overrides(const layer::LayerPtr& session, const stage::Stage& stage,
                                       const std::vector<std::string>& assignments) {
  layer::Layer layer = copy_of(session);
  for (const std::string& text : assignments) {
    TENON_TRY(const PropertyAssignment assignment, read_assignment(text));
    TENON_TRY(layer::Spec spec, override_of(stage, assignment, layer));
    const Path path = assignment.property;
    layer::Spec& prim = over(layer, path.parent());
    add_name(prim, fields::properties, path.name());
    layer.create(path, spec.kind) = std::move(spec);
  }
  return layer::LayerPtr(std::make_shared<const layer::Layer>(std::move(layer)));
}

}  // namespace tenon
