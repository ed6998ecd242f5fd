// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/editing/author_edit.h"

#include <algorithm>
#include <filesystem>
#include <string>

#include "tenon/asset/layers/relative_path.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

namespace fields = layer::fields;
using Kind = AssetEdit::Kind;

/// Takes back what the file itself says where that suffices, so that adding and removing leave
/// nothing behind; else deletes the schema from weaker layers.
Result<void> remove_api(edit::StageEditor& editor, Path prim, Path spec, Token api) {
  layer::ListOp<Token> op;
  if (const layer::LayerPtr layer = editor.layer(editor.target().layer);
      layer && layer->has(spec)) {
    op = layer->find(spec)->get_or(fields::apiSchemas, std::move(op));
  }
  const bool deletes = std::find(op.deleted.begin(), op.deleted.end(), api) != op.deleted.end();
  return edit::adds(op, api) && !deletes ? editor.withdraw_applied_schema(prim, api)
                                         : editor.remove_applied_schema(prim, api);
}

Result<void> take_away(edit::StageEditor& editor, const AssetEdit& edit, Path spec) {
  return editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(edit.kind == Kind::ClearProperty ? editor.remove_property(edit.object)
                                                 : remove_api(editor, edit.object, spec, edit.api));
    return edit.tidy ? editor.remove_silent_prim(edit.object.prim()) : Result<void>();
  });
}

/// As the layer at the editor's target names the file.
std::string name_from_layer(const edit::StageEditor& editor, const std::string& file) {
  return relative_asset_path(file, std::filesystem::path(editor.target().layer).parent_path());
}

Result<void> define_prim(edit::StageEditor& editor, const AssetEdit& edit) {
  return editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.define_prim(edit.object, edit.type_name));
    if (!edit.arc) {
      return {};
    }
    const std::string name = name_from_layer(editor, edit.arc->file);
    if (edit.arc->payload) {
      layer::Payload payload{name, edit.arc->prim, {}};
      return editor.edit_payloads(edit.object, edit::ListEdit<layer::Payload>::add(payload));
    }
    layer::Reference reference{name, edit.arc->prim, {}, {}};
    return editor.edit_references(edit.object, edit::ListEdit<layer::Reference>::add(reference));
  });
}

Result<void> add_variant(edit::StageEditor& editor, const AssetEdit& edit) {
  const std::size_t equals = edit.value.find('=');
  return editor.add_variant(edit.object, edit.value.substr(0, equals),
                            edit.value.substr(equals + 1));
}

Result<void> edit_target_list(edit::StageEditor& editor, const AssetEdit& edit,
                              const PropertyValue& typed) {
  if (!typed.is_relationship) {
    return not_a_list(edit.object);
  }
  return editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.create_relationship(edit.object, typed.custom));
    const bool takes_back = edit.tidy && !edit.layer.empty();
    for (const Path target : typed.targets) {
      TENON_CHECK(editor.edit_targets(
          edit.object, edit.kind == Kind::AddTargets ? edit::ListEdit<Path>::add(target)
                       : takes_back                  ? edit::ListEdit<Path>::withdraw(target)
                                                     : edit::ListEdit<Path>::remove(target)));
    }
    return {};
  });
}

}  // namespace

Result<void> author_edit(edit::StageEditor& editor, const AssetEdit& edit, Path spec,
                         const PropertyValue& typed) {
  const Path object = edit.object;
  switch (edit.kind) {
    case Kind::ClearProperty:
    case Kind::RemoveApi:
      return take_away(editor, edit, spec);
    case Kind::DefinePrim:
      return define_prim(editor, edit);
    case Kind::AddVariant:
      return add_variant(editor, edit);
    case Kind::RemoveVariant:
    case Kind::RemovePrim:
    case Kind::RenamePrim:
    case Kind::RenameProperty:
      return Error(ErrorCode::Invalid, "this edit is of all files at once");
    case Kind::ApplyApi:
      return editor.as_one_step([&]() -> Result<void> {
        TENON_CHECK(editor.withdraw_applied_schema(object, edit.api));  // a deletion, too
        return editor.apply_api(object, edit.api);
      });
    case Kind::AddTargets:
    case Kind::RemoveTargets:
      return edit_target_list(editor, edit, typed);
    case Kind::SetProperty:
      break;
  }
  return editor.as_one_step([&]() -> Result<void> {
    if (typed.is_relationship) {
      TENON_CHECK(editor.create_relationship(object, typed.custom));
      return editor.edit_targets(object, edit::ListEdit<Path>::set(typed.targets));
    }
    TENON_CHECK(editor.create_attribute(object, typed.type_name, typed.custom, typed.variability));
    return editor.set_value(object, typed.value);
  });
}

}  // namespace tenon
