// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Metadata of the stage, of prims and of properties, and the API schemas applied to prims.
#include <algorithm>

#include "tenon/edit/api_schemas.h"
#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/edit/working_stage.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/layer/type_names.h"

namespace tenon::edit {

using layer::SpecKind;
using layer::Value;
using layer::ValueType;
namespace fields = layer::fields;

namespace {

struct FieldType {
  ValueType type = ValueType::None;
  bool is_array = false;
};

/// The type of a field where `kind` of spec has it.
Result<FieldType> field_type(Path object, Token field, SpecKind kind) {
  if (field == fields::comment) {
    return FieldType{ValueType::String, false};
  }
  if (const layer::MetadataField* known = layer::find_metadata_field(field, kind)) {
    return FieldType{known->type, known->is_array};
  }
  return Error(ErrorCode::Invalid,
               "`" + field.str() + "` is not metadata of <" + object.str() + ">")
      .with_prim(object.prim().str())
      .with_rule("edit.unknown-metadata")
      .with_fix("put values of your own into customData, or customLayerData of the stage");
}

std::string name_of(ValueType type, bool is_array) {
  const layer::TypeName* name = layer::type_name_of(type, is_array);
  if (name != nullptr) {
    return name->name.str();
  }
  return type == ValueType::Dictionary ? "a dictionary" : "a value of another type";
}

Result<void> check_field(Path object, Token field, SpecKind kind, const Value& value) {
  TENON_TRY(const FieldType wanted, field_type(object, field, kind));
  if (value.type() != wanted.type || value.is_array() != wanted.is_array) {
    return type_mismatch(object, "`" + field.str() + "`", name_of(wanted.type, wanted.is_array),
                         name_of(value.type(), value.is_array()));
  }
  return {};
}

SpecKind kind_of(const layer::Layer& layer, Path spec) {
  const layer::Spec* found = layer.find(spec);
  return found == nullptr ? SpecKind::None : found->kind;
}

/// "a:b" -> "a", "b".
std::pair<std::string, std::string> split_key(const std::string& key_path) {
  const std::size_t colon = key_path.find(':');
  return colon == std::string::npos
             ? std::pair(key_path, std::string())
             : std::pair(key_path.substr(0, colon), key_path.substr(colon + 1));
}

/// An empty `value` takes the entry away; dictionaries that become empty stay.
void set_key(layer::Dictionary& dictionary, const std::string& key_path, const Value& value) {
  const auto [key, rest] = split_key(key_path);
  if (rest.empty()) {
    value.empty() ? static_cast<void>(dictionary.items.erase(key))
                  : static_cast<void>(dictionary.items.insert_or_assign(key, value));
    return;
  }
  const Value* old = dictionary.find(key);
  const auto* inner = old == nullptr ? nullptr : old->get<layer::Dictionary>();
  if (value.empty() && inner == nullptr) {
    return;
  }
  layer::Dictionary below = inner == nullptr ? layer::Dictionary{} : *inner;
  set_key(below, rest, value);
  dictionary.items.insert_or_assign(key, Value(std::move(below)));
}

}  // namespace

/// The spec that metadata of an object goes to, made where it is missing.
Result<Path> StageEditor::object_spec(LayerEditor& editor, Path object) {
  if (object.is_absolute_root()) {
    const bool of_stage =
        target_.layer == sources_->root->identifier() ||
        (sources_->session != nullptr && target_.layer == sources_->session->identifier());
    if (!of_stage) {
      return outside_target(object, target_.layer);
    }
    return object;
  }
  TENON_TRY(const Path path, place(object));
  if (object.is_property()) {
    const FoundProperty found = view().property(view().prim(object.parent()), object.name());
    const SpecKind kind = found.kind == SpecKind::None ? kind_of(editor.layer(), path) : found.kind;
    TENON_CHECK(
        make_property(editor, object, path, kind == SpecKind::None ? SpecKind::Attribute : kind));
  } else {
    TENON_CHECK(editor.create_prim(path));
  }
  return path;
}

Result<void> StageEditor::set_metadata(Path object, Token field, Value value) {
  return set_metadata(object, field, {}, std::move(value));
}

Result<void> StageEditor::set_metadata(Path object, Token field, const std::string& key_path,
                                       Value value) {
  if (std::count(key_path.begin(), key_path.end(), ':') > 100) {
    return bad_path(object, "the place of so deep a dictionary");
  }
  TENON_CHECK(find_prim(object.prim()));
  TENON_CHECK(check_editable(object.prim()));
  value = target_.layer_value(value);
  return edit([&](LayerEditor& editor) -> Result<void> {
    TENON_TRY(const Path path, object_spec(editor, object));
    const SpecKind kind = kind_of(editor.layer(), path);
    if (key_path.empty()) {
      TENON_CHECK(check_field(object, field, kind, value));
      editor.set(path, field, value);
      return {};
    }
    auto dictionary = editor.get_or(path, field, layer::Dictionary{});
    TENON_CHECK(check_field(object, field, kind, Value(dictionary)));
    set_key(dictionary, key_path, value);
    editor.set(path, field, Value(std::move(dictionary)));
    return {};
  });
}

Result<void> StageEditor::clear_metadata(Path object, Token field, const std::string& key_path) {
  return edit_existing(object, SpecKind::None, [&](LayerEditor& editor, Path path) -> Result<void> {
    const SpecKind kind = kind_of(editor.layer(), path);
    TENON_CHECK(field_type(object, field, kind));
    auto dictionary = editor.get_or(path, field, layer::Dictionary{});
    if (key_path.empty() || dictionary.empty()) {
      editor.erase(path, field);
      return {};
    }
    set_key(dictionary, key_path, {});
    dictionary.empty() ? editor.erase(path, field)
                       : editor.set(path, field, Value(std::move(dictionary)));
    return {};
  });
}

Result<void> StageEditor::apply_api(Path prim, Token schema) {
  TENON_CHECK(check_api_name(prim, schema));
  return add_applied_schema(prim, schema);
}

Result<void> StageEditor::remove_api(Path prim, Token schema) {
  TENON_CHECK(check_api_name(prim, schema));
  return remove_applied_schema(prim, schema);
}

Result<void> StageEditor::add_applied_schema(Path prim, Token name) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.add_api(path, name);
    return {};
  });
}

Result<void> StageEditor::remove_applied_schema(Path prim, Token name) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.remove_api(path, name);
    return {};
  });
}

Result<void> StageEditor::withdraw_applied_schema(Path prim, Token name) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.withdraw_api(path, name);
    return {};
  });
}

}  // namespace tenon::edit
