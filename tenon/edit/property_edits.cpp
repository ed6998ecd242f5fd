// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Attributes and relationships: their specs, values, connections and targets.
#include <algorithm>

#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/type_names.h"

namespace tenon::edit {

using layer::SpecKind;
using layer::Value;
using layer::Variability;
namespace fields = layer::fields;

namespace {

Result<void> check_property_path(Path property) {
  if (!property.is_absolute() || property.kind() != PathKind::Property || property.has_variants()) {
    return bad_path(property, "the path of a property");
  }
  return {};
}

std::string kind_name(SpecKind kind) {
  return kind == SpecKind::Relationship ? "a relationship" : "an attribute";
}

std::string type_of(const Value& value) {
  const layer::TypeName* name = layer::type_name_of(value.type(), value.is_array());
  return name == nullptr ? "a value of no attribute type" : name->name.str();
}

/// Blocks fit every attribute; all else must be of its type.
Result<void> check_type(Path attribute, Token type_name, const Value& value) {
  if (value.is_block() || value.holds<layer::AnimationBlock>()) {
    return {};
  }
  const layer::TypeName* type = layer::find_type_name(type_name);
  if (type == nullptr || type->type == layer::ValueType::Opaque) {
    return type_mismatch(attribute, "The attribute type \"" + type_name.str() + "\"", "no values",
                         type_of(value));
  }
  if (value.type() != type->type || value.is_array() != type->is_array) {
    return type_mismatch(attribute, "the value", type->name.str(), type_of(value));
  }
  return {};
}

bool has_equal_items(const std::vector<Path>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (std::find(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i), items[i]) !=
        items.begin() + static_cast<std::ptrdiff_t>(i)) {
      return true;
    }
  }
  return false;
}

}  // namespace

/// The spec of a property at the edit target, made after what schemas or other layers say of it.
Result<void> StageEditor::make_property(LayerEditor& editor, Path scene_path, Path spec_path,
                                        SpecKind kind) {
  if (const layer::Spec* spec = editor.layer().find(spec_path)) {
    return spec->kind == kind ? Result<void>()
                              : Result<void>(wrong_kind(scene_path, kind_name(spec->kind)));
  }
  const FoundPrim prim = view().prim(scene_path.parent());
  const FoundProperty found = view().property(prim, scene_path.name());
  if (found.kind == SpecKind::None) {
    return no_property(scene_path, kind_name(kind).substr(3));
  }
  if (found.kind != kind) {
    return wrong_kind(scene_path, kind_name(found.kind));
  }
  TENON_CHECK(editor.create_prim(spec_path.parent()));
  return kind == SpecKind::Attribute
             ? editor.create_attribute(spec_path, found.type_name, found.variability, found.custom)
             : editor.create_relationship(spec_path, found.variability, found.custom);
}

Result<void> StageEditor::edit_property(Path property, SpecKind kind,
                                        const Function<Result<void>(LayerEditor&, Path)>& work) {
  TENON_CHECK(check_property_path(property));
  TENON_CHECK(find_prim(property.parent()));
  TENON_CHECK(check_editable(property.parent()));
  TENON_TRY(const Path path, place(property));
  return edit([&](LayerEditor& editor) -> Result<void> {
    TENON_CHECK(make_property(editor, property, path, kind));
    return work(editor, path);
  });
}

Result<void> StageEditor::edit_attribute(Path attribute,
                                         const Function<Result<void>(LayerEditor&, Path)>& work) {
  return edit_property(attribute, SpecKind::Attribute, work);
}

/// Runs `work` where the target layer has a spec; there is nothing to take away elsewhere.
Result<void> StageEditor::edit_existing(Path object, SpecKind kind,
                                        const Function<Result<void>(LayerEditor&, Path)>& work) {
  TENON_TRY(const FoundPrim prim, find_prim(object.prim()));
  TENON_CHECK(check_editable(object.prim()));
  if (object.is_property()) {
    const SpecKind there = view().property(prim, object.name()).kind;
    if (there == SpecKind::None || (kind != SpecKind::None && kind != there)) {
      return no_property(object, kind == SpecKind::Attribute ? "attribute" : "property");
    }
  }
  const Path path = target_.spec_path(object);
  return edit([&](LayerEditor& editor) -> Result<void> {
    return path.empty() || !editor.layer().has(path) ? Result<void>() : work(editor, path);
  });
}

Result<void> StageEditor::create_attribute(Path attribute, Token type_name, bool custom,
                                           Variability variability) {
  TENON_CHECK(check_property_path(attribute));
  TENON_TRY(const FoundPrim prim, find_prim(attribute.parent()));
  TENON_CHECK(check_editable(attribute.parent()));
  TENON_TRY(const Path path, place(attribute));
  const bool known = view().property(prim, attribute.name()).kind != SpecKind::None;
  return edit([&](LayerEditor& editor) -> Result<void> {
    if (known || editor.layer().has(path)) {
      return make_property(editor, attribute, path, SpecKind::Attribute);
    }
    TENON_CHECK(editor.create_prim(path.parent()));
    return editor.create_attribute(path, type_name, variability, custom);
  });
}

Result<void> StageEditor::create_relationship(Path relationship, bool custom) {
  TENON_CHECK(check_property_path(relationship));
  TENON_TRY(const FoundPrim prim, find_prim(relationship.parent()));
  TENON_CHECK(check_editable(relationship.parent()));
  TENON_TRY(const Path path, place(relationship));
  const bool known = view().property(prim, relationship.name()).kind != SpecKind::None;
  return edit([&](LayerEditor& editor) -> Result<void> {
    if (known || editor.layer().has(path)) {
      return make_property(editor, relationship, path, SpecKind::Relationship);
    }
    TENON_CHECK(editor.create_prim(path.parent()));
    return editor.create_relationship(path, Variability::Uniform, custom);
  });
}

Result<void> StageEditor::remove_property(Path property) {
  TENON_CHECK(check_property_path(property));
  TENON_TRY(const Path path, place(property));
  return edit([&](LayerEditor& editor) { return editor.remove_property(path); });
}

Result<void> StageEditor::set_value(Path attribute, Value value, stage::Time time) {
  TENON_CHECK(check_property_path(attribute));
  TENON_TRY(const FoundPrim prim, find_prim(attribute.parent()));
  const FoundProperty found = view().property(prim, attribute.name());
  if (found.kind == SpecKind::None) {
    return no_property(attribute, "attribute");
  }
  value = target_.layer_value(value);
  return edit_attribute(attribute, [&](LayerEditor& editor, Path path) -> Result<void> {
    if (!check_type(attribute, editor.get_or(path, fields::typeName, Token()), value)) {
      TENON_CHECK(check_type(attribute, found.type_name, value));
    }
    if (time.is_default()) {
      editor.set(path, fields::default_value, value);
    } else {
      editor.set_time_sample(path, target_.layer_time(time.code()), value);
    }
    return {};
  });
}

Result<void> StageEditor::clear_value(Path attribute, stage::Time time) {
  TENON_CHECK(check_property_path(attribute));
  return edit_existing(attribute, SpecKind::Attribute,
                       [&](LayerEditor& editor, Path path) -> Result<void> {
                         if (time.is_default()) {
                           editor.erase(path, fields::default_value);
                         } else {
                           editor.erase_time_sample(path, target_.layer_time(time.code()));
                         }
                         return {};
                       });
}

Result<void> StageEditor::clear_values(Path attribute) {
  TENON_CHECK(check_property_path(attribute));
  return edit_existing(attribute, SpecKind::Attribute,
                       [](LayerEditor& editor, Path path) -> Result<void> {
                         editor.erase(path, fields::default_value);
                         editor.erase(path, fields::timeSamples);
                         return {};
                       });
}

Result<void> StageEditor::block_value(Path attribute) {
  return as_one_step([&]() -> Result<void> {
    TENON_CHECK(clear_values(attribute));
    return set_value(attribute, layer::ValueBlock{});
  });
}

namespace {

/// A target as the layer names it.
Result<Path> mapped_target(const EditTarget& place, Path owner, Path target) {
  const Path absolute = target.absolute(owner.prim());
  if (absolute.empty() || absolute.has_variants() ||
      !(absolute.is_prim_or_root() || absolute.is_property())) {
    return bad_path(target, "the path of a prim or property");
  }
  const Path mapped = place.target_path(absolute);
  if (mapped.empty()) {
    return no_name_in_target(target, place.layer);
  }
  return mapped;
}

/// The same of a whole list.
Result<void> map_targets(const EditTarget& place, Path owner, std::vector<Path>& targets) {
  for (Path& target : targets) {
    TENON_TRY(target, mapped_target(place, owner, target));
  }
  if (has_equal_items(targets)) {
    return Error(ErrorCode::Invalid, "the list names one path twice")
        .with_prim(owner.prim().str())
        .with_rule("edit.bad-path")
        .with_fix("name each target once");
  }
  return {};
}

}  // namespace

Result<void> StageEditor::edit_connections(Path attribute, ListEdit<Path> edit) {
  TENON_CHECK(map_targets(target_, attribute, edit.items));
  return edit_attribute(attribute, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.edit_list(path, fields::connectionPaths, edit);
    return {};
  });
}

Result<void> StageEditor::edit_targets(Path relationship, ListEdit<Path> edit) {
  TENON_CHECK(map_targets(target_, relationship, edit.items));
  return edit_property(relationship, SpecKind::Relationship,
                       [&](LayerEditor& editor, Path path) -> Result<void> {
                         editor.edit_list(path, fields::targetPaths, edit);
                         return {};
                       });
}

}  // namespace tenon::edit
