// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether an arc leads somewhere is known when the scene has been composed with it, so that what it
// brings in is read once: composition says which arc of which file it could not follow. An arc is
// found again by where it leads, however the layer spells the file, and whatever its offset is.
#include "tenon/asset/editing/whole_prim_edits.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/asset/layers/relative_path.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/edit/api_schemas.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/fields.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/layer/type_names.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using Kind = AssetEdit::Kind;

/// "did you mean NAME?", or what else helps.
std::string meant(const std::string& name, const std::vector<std::string>& names,
                  const std::string& otherwise) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string nearest(nearest_name(name, views));
  return nearest.empty() ? otherwise : "did you mean " + nearest + "?";
}

/// "SET=VARIANT", "SET=" and "SET".
struct VariantWish {
  std::string set;
  std::string variant;
  bool clears = false;
};

VariantWish selection_of(const AssetEdit& edit) {
  const std::size_t equals = edit.value.find('=');
  return equals == std::string::npos
             ? VariantWish{edit.value, {}, true}
             : VariantWish{edit.value.substr(0, equals), edit.value.substr(equals + 1), false};
}

Result<void> check_selection(const stage::Prim& prim, const AssetEdit& edit) {
  const VariantWish wanted = selection_of(edit);
  const auto missing = [&](const std::string& what, const std::string& name,
                           const std::vector<std::string>& names) -> Result<void> {
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      return {};
    }
    return Error(ErrorCode::NotFound, "<" + prim.path().str() + "> has no " + what + " " + name)
        .with_prim(prim.path().str())
        .with_rule("edit.no-variant")
        .with_fix(
            meant(name, names, names.empty() ? "add it first" : "one of: " + comma_list(names)));
  };
  if (!wanted.clears) {
    TENON_CHECK(missing("variant set", wanted.set, prim.variant_set_names()));
  }
  return wanted.variant.empty()
             ? Result<void>()
             : missing("variant", wanted.variant, prim.variant_names(wanted.set));
}

Result<void> check_order(const stage::Prim& prim, const AssetEdit& edit) {
  const bool of_children = edit.kind == Kind::OrderChildren;
  std::vector<std::string> names;
  if (of_children) {
    for (const stage::Prim& child : prim.children()) {
      names.push_back(child.path().name().str());
    }
  } else {
    for (const Token name : prim.property_names()) {
      names.push_back(name.str());
    }
  }
  for (const Token name : edit.names) {
    if (std::find(names.begin(), names.end(), name.str()) == names.end()) {
      return Error(ErrorCode::NotFound, "<" + prim.path().str() + "> has no " +
                                            (of_children ? "child " : "property ") + name.str())
          .with_prim(prim.path().str())
          .with_rule(of_children ? "edit.no-prim" : "edit.no-property")
          .with_fix(meant(name.str(), names, "name what is in it"));
    }
  }
  return {};
}

Result<void> check_time(const stage::Prim& prim, const AssetEdit& edit) {
  const Token name = edit.object.name();
  if (prim.is_relationship(name)) {
    return Error(ErrorCode::Invalid,
                 "<" + edit.object.str() + "> is a relationship: it has no " + "time samples")
        .with_prim(prim.path().str())
        .with_rule("edit.type-mismatch")
        .with_fix("leave the time out");
  }
  const std::vector<double> times = prim.attribute(name).time_samples();
  if (edit.kind != Kind::ClearProperty ||
      std::find(times.begin(), times.end(), *edit.time) != times.end()) {
    return {};
  }
  return Error(ErrorCode::NotFound, "<" + edit.object.str() + "> has no sample at time " +
                                        formats::value_text(layer::Value(*edit.time)))
      .with_prim(prim.path().str())
      .with_rule("edit.no-sample")
      .with_fix(times.empty() ? "it has no samples at all" : "name a time that it has");
}

// ---- metadata

layer::SpecKind kind_of(const stage::Prim& prim, Path object) {
  return object.is_absolute_root()             ? layer::SpecKind::PseudoRoot
         : !object.is_property()               ? layer::SpecKind::Prim
         : prim.is_relationship(object.name()) ? layer::SpecKind::Relationship
                                               : layer::SpecKind::Attribute;
}

Error unknown_metadata(const AssetEdit& edit, layer::SpecKind kind) {
  std::vector<std::string> names;
  for (const layer::MetadataField& field : layer::all_metadata_fields()) {
    if (layer::find_metadata_field(field.name, kind) != nullptr) {
      names.push_back(field.name.str());
    }
  }
  return Error(ErrorCode::Invalid,
               "\"" + edit.field.str() + "\" is not metadata of <" + edit.object.str() + ">")
      .with_prim(edit.object.prim().str())
      .with_rule("edit.unknown-metadata")
      .with_fix(meant(edit.field.str(), names, "put values of your own into customData"));
}

Error wrong_metadata(const AssetEdit& edit, const std::string& type) {
  return Error(ErrorCode::Invalid,
               edit.field.str() + " of <" + edit.object.str() + "> takes a value of type " + type)
      .with_prim(edit.object.prim().str())
      .with_rule("edit.type-mismatch")
      .with_fix("it was given " + edit.value);
}

/// As text layers have it.
Result<layer::Dictionary> read_dictionary(const AssetEdit& edit) {
  Diagnostics ignored;
  const auto read = formats::read_text(
      "#usda 1.0\n(\n    customLayerData = " + edit.value + "\n)\n", "value.usda", ignored);
  const layer::Spec* root = read ? read->find(Path::absolute_root()) : nullptr;
  const auto* dictionary =
      root == nullptr ? nullptr : root->get<layer::Dictionary>(Token("customLayerData"));
  return dictionary == nullptr ? Result<layer::Dictionary>(wrong_metadata(edit, "dictionary"))
                               : Result<layer::Dictionary>(*dictionary);
}

/// The entry at "a:b"; null: there is none.
const layer::Value* entry_at(const layer::Dictionary& top, std::string_view key) {
  const layer::Dictionary* dictionary = &top;
  for (std::size_t colon = key.find(':'); colon != std::string_view::npos; colon = key.find(':')) {
    const layer::Value* below = dictionary->find(key.substr(0, colon));
    dictionary = below == nullptr ? nullptr : below->get<layer::Dictionary>();
    if (dictionary == nullptr) {
      return nullptr;
    }
    key.remove_prefix(colon + 1);
  }
  return dictionary->find(key);
}

Result<layer::Value> read_plain(const AssetEdit& edit, layer::ValueType type, bool is_array) {
  const std::string& text = edit.value;
  const bool quoted = text.starts_with('"') || text.starts_with('\'');
  if (!is_array && !quoted && type == layer::ValueType::String) {
    return layer::Value(text);
  }
  if (!is_array && !quoted && type == layer::ValueType::Token) {
    return layer::Value(Token(text));
  }
  const layer::TypeName* name = layer::type_name_of(type, is_array);
  if (name == nullptr) {
    return Error(ErrorCode::Unsupported, edit.field.str() + " is no single value")
        .with_prim(edit.object.prim().str())
        .with_rule("edit.unknown-metadata")
        .with_fix("list edits have calls of their own: schemas, arcs, variants");
  }
  auto value = formats::parse_value(text, *name);
  return value ? value : Result<layer::Value>(wrong_metadata(edit, name->name.str()));
}

// ---- arcs

Token field_of(AssetArc::Kind kind) {
  switch (kind) {
    case AssetArc::Kind::Reference:
      return fields::references;
    case AssetArc::Kind::Payload:
      return fields::payload;
    case AssetArc::Kind::Inherit:
      return fields::inheritPaths;
    case AssetArc::Kind::Specialize:
      break;
  }
  return fields::specializes;
}

bool leads_to(const Path& item, const layer::Layer& /*layer*/, const AssetArc& arc) {
  return item == arc.prim;
}

template <class Item>
bool leads_to(const Item& item, const layer::Layer& layer, const AssetArc& arc) {
  const std::string file =
      item.asset_path.empty() ? std::string() : structure::target_of(item.asset_path, layer);
  return file == arc.file && item.prim_path == arc.prim;
}

/// Those of a layer that lead where the arc does.
template <class Item>
std::vector<Item> same_arcs(const layer::Layer& layer, const layer::Spec& spec,
                            const AssetArc& arc) {
  std::vector<Item> found;
  if (const auto* op = spec.get<layer::ListOp<Item>>(field_of(arc.kind))) {
    for (const auto list : edit::kListsThatAdd<Item>) {
      for (const Item& item : op->*list) {
        if (leads_to(item, layer, arc)) {
          found.push_back(item);
        }
      }
    }
  }
  return found;
}

bool has_arc(const layer::Layer& layer, const layer::Spec& spec, const AssetArc& arc) {
  switch (arc.kind) {
    case AssetArc::Kind::Reference:
      return !same_arcs<layer::Reference>(layer, spec, arc).empty();
    case AssetArc::Kind::Payload:
      return !same_arcs<layer::Payload>(layer, spec, arc).empty();
    default:
      return !same_arcs<Path>(layer, spec, arc).empty();
  }
}

template <class Item>
Result<void> withdraw(edit::StageEditor& editor, Path spec, const AssetArc& arc) {
  return editor.edit_layer(editor.target().layer, [&](edit::LayerEditor& specs) -> Result<void> {
    const layer::Spec* found = specs.layer().find(spec);
    for (const Item& item :
         found == nullptr ? std::vector<Item>() : same_arcs<Item>(specs.layer(), *found, arc)) {
      specs.edit_list(spec, field_of(arc.kind), edit::ListEdit<Item>::withdraw(item));
    }
    return {};
  });
}

Result<void> remove_arc(edit::StageEditor& editor, const AssetEdit& edit, Path spec) {
  const layer::LayerPtr layer = editor.layer(editor.target().layer);
  const layer::Spec* found = layer == nullptr ? nullptr : layer->find(spec);
  if (found == nullptr || !has_arc(*layer, *found, *edit.arc)) {
    return Error(ErrorCode::NotFound, "<" + edit.object.str() + "> has no such arc there")
        .in_file(editor.target().layer)
        .with_prim(edit.object.str())
        .with_rule("edit.no-spec")
        .with_fix("name the file and the prim that it leads to, as they are");
  }
  switch (edit.arc->kind) {
    case AssetArc::Kind::Reference:
      return withdraw<layer::Reference>(editor, spec, *edit.arc);
    case AssetArc::Kind::Payload:
      return withdraw<layer::Payload>(editor, spec, *edit.arc);
    default:
      return withdraw<Path>(editor, spec, *edit.arc);
  }
}

Result<void> select_variant(edit::StageEditor& editor, const AssetEdit& edit) {
  const VariantWish wanted = selection_of(edit);
  if (wanted.clears) {
    return editor.clear_variant_selection(edit.object, wanted.set);
  }
  return wanted.variant.empty()
             ? editor.block_variant_selection(edit.object, wanted.set)
             : editor.set_variant_selection(edit.object, wanted.set, wanted.variant);
}

std::vector<const Diagnostic*> findings_of_lost_arcs(const stage::Stage& stage, Path prim,
                                                     const std::string& file) {
  std::vector<const Diagnostic*> found;
  for (const Diagnostic& one : stage.diagnostics()) {
    if ((one.rule == "compose.invalid-asset-path" || one.rule == "compose.unresolved-prim-path") &&
        one.prim == prim.str() && one.file == file) {
      found.push_back(&one);
    }
  }
  return found;
}

}  // namespace

Result<void> check_fits(const stage::Prim& prim, const AssetEdit& edit) {
  switch (edit.kind) {
    case Kind::ApplyApi:
      return edit::check_api(prim, edit.api);
    case Kind::SelectVariant:
      return check_selection(prim, edit);
    case Kind::OrderChildren:
    case Kind::OrderProperties:
      return check_order(prim, edit);
    default:
      return edit.time ? check_time(prim, edit) : Result<void>();
  }
}

bool says(const layer::Layer& layer, const layer::Spec& spec, const AssetEdit& edit) {
  switch (edit.kind) {
    case Kind::SetMetadata:
    case Kind::ClearMetadata: {
      const auto* dictionary = spec.get<layer::Dictionary>(edit.field);
      return spec.has(edit.field) &&
             (edit.kind == Kind::SetMetadata || edit.key.empty() || dictionary == nullptr ||
              entry_at(*dictionary, edit.key) != nullptr);
    }
    case Kind::SelectVariant: {
      const auto* chosen = spec.get<layer::VariantSelections>(fields::variantSelection);
      return chosen != nullptr && chosen->items.contains(selection_of(edit).set);
    }
    case Kind::OrderChildren:
      return spec.has(fields::primOrder);
    case Kind::OrderProperties:
      return spec.has(fields::propertyOrder);
    case Kind::RemoveArc:
      return has_arc(layer, spec, *edit.arc);
    default:
      return false;
  }
}

Result<layer::Value> read_metadata(const stage::Prim& prim, const AssetEdit& edit) {
  const layer::SpecKind kind = kind_of(prim, edit.object);
  if (edit.field == fields::typeName && kind == layer::SpecKind::Prim) {
    return layer::Value(Token(edit.value));
  }
  const layer::MetadataField* field = layer::find_metadata_field(edit.field, kind);
  if (field == nullptr && edit.field != fields::comment) {
    return unknown_metadata(edit, kind);
  }
  const layer::ValueType type = field == nullptr ? layer::ValueType::String : field->type;
  if (edit.kind == Kind::ClearMetadata) {
    return layer::Value();
  }
  if (type != layer::ValueType::Dictionary) {
    return edit.key.empty()
               ? read_plain(edit, type, field != nullptr && field->is_array)
               : Result<layer::Value>(wrong_metadata(edit, "its own: it has no entries"));
  }
  TENON_TRY(layer::Dictionary dictionary, read_dictionary(edit));
  if (edit.key.empty()) {
    return layer::Value(std::move(dictionary));
  }
  return dictionary.items.size() == 1 ? Result<layer::Value>(dictionary.items.begin()->second)
                                      : Result<layer::Value>(wrong_metadata(edit, "one entry"));
}

layer::Value composed_metadata(const stage::Prim& prim, const AssetEdit& edit) {
  const Token name = edit.object.is_property() ? edit.object.name() : Token();
  layer::Value value = name.empty()                 ? prim.metadata(edit.field)
                       : prim.is_relationship(name) ? prim.relationship(name).metadata(edit.field)
                                                    : prim.attribute(name).metadata(edit.field);
  const auto* dictionary = value.get<layer::Dictionary>();
  if (dictionary == nullptr || edit.key.empty()) {
    return value;
  }
  const layer::Value* entry = entry_at(*dictionary, edit.key);
  return entry == nullptr ? layer::Value() : *entry;
}

bool has_metadata(const stage::Prim& prim, const AssetEdit& edit, const layer::Value& asked) {
  if (edit.field == fields::typeName && !edit.object.is_property()) {
    return prim.type_name() == asked.get_or(Token());
  }
  const layer::Value found = composed_metadata(prim, edit);
  const bool is_dictionary = asked.get<layer::Dictionary>() != nullptr;  // weaker entries stay
  return is_dictionary ? found.get<layer::Dictionary>() != nullptr
                       : formats::value_text(found) == formats::value_text(asked);
}

Result<void> author_arc(edit::StageEditor& editor, Path prim, const AssetArc& arc) {
  const edit::ListPosition position =
      arc.first ? edit::ListPosition::FrontOfPrependList : edit::ListPosition::BackOfPrependList;
  const std::string file =
      arc.file.empty() ? std::string()
                       : relative_asset_path(
                             arc.file, std::filesystem::path(editor.target().layer).parent_path());
  switch (arc.kind) {
    case AssetArc::Kind::Reference:
      return editor.edit_references(
          prim, edit::ListEdit<layer::Reference>::add({file, arc.prim, arc.offset, {}}, position));
    case AssetArc::Kind::Payload:
      return editor.edit_payloads(
          prim, edit::ListEdit<layer::Payload>::add({file, arc.prim, arc.offset}, position));
    case AssetArc::Kind::Inherit:
      return editor.edit_inherits(prim, edit::ListEdit<Path>::add(arc.prim, position));
    case AssetArc::Kind::Specialize:
      break;
  }
  return editor.edit_specializes(prim, edit::ListEdit<Path>::add(arc.prim, position));
}

Result<void> author_whole_prim(edit::StageEditor& editor, const AssetEdit& edit, Path spec,
                               const PropertyValue& typed) {
  switch (edit.kind) {
    case Kind::AddArc:
      return author_arc(editor, edit.object, *edit.arc);
    case Kind::RemoveArc:
      return remove_arc(editor, edit, spec);
    case Kind::SelectVariant:
      return select_variant(editor, edit);
    case Kind::OrderChildren:
      return editor.reorder_children(edit.object, edit.names);
    case Kind::OrderProperties:
      return editor.reorder_properties(edit.object, edit.names);
    case Kind::ClearMetadata:
      return editor.clear_metadata(edit.object, edit.field, edit.key);
    default:
      break;
  }
  if (edit.field == fields::typeName && !edit.object.is_property()) {
    return editor.set_type_name(edit.object, typed.value.get_or(Token()));
  }
  return editor.set_metadata(edit.object, edit.field, edit.key, typed.value);
}

std::size_t lost_arcs(const stage::Stage& stage, Path prim, const std::string& file) {
  return findings_of_lost_arcs(stage, prim, file).size();
}

Error lost_arc(const stage::Stage& stage, const AssetEdit& edit, const std::string& file) {
  const auto found = findings_of_lost_arcs(stage, edit.object, file);
  const Diagnostic& why = *found.back();
  std::vector<std::string> names;
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    if (layer->identifier() == (edit.arc->file.empty() ? file : edit.arc->file)) {
      for (const layer::Layer::Entry& entry : layer->entries()) {
        if (entry.path.is_prim() && !entry.path.has_variants()) {
          names.push_back(entry.path.str());
        }
      }
    }
  }
  constexpr std::size_t kMostNames = 20000;  // the search takes long
  names.resize(std::min(names.size(), kMostNames));
  return Error(ErrorCode::NotFound, why.message)
      .in_file(why.file)
      .with_prim(why.prim)
      .with_rule("edit.no-target")
      .with_fix(meant(edit.arc->prim.str(), names, why.fix));
}

}  // namespace tenon
