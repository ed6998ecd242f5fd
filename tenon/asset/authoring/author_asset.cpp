// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/authoring/author_asset.h"

#include <utility>

#include "tenon/asset/authoring/remove_edits.h"
#include "tenon/asset/layers/asset_layers.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/fields.h"
#include "tenon/property_value.h"

namespace tenon {
namespace {

using ReadRequest = Result<std::vector<AssetEdit>> (*)(const Stages&, const AuthoringRequest&,
                                                       const std::string&);

Result<AuthoredAsset> author(const std::string& path, const AuthoringRequest& request,
                             const EditOptions& options, ReadRequest read,
                             Diagnostics& diagnostics) {
  Diagnostics ignored;  // of opening: edit_asset opens again and reports
  AuthoredAsset authored;
  {
    TENON_TRY(AssetEditor editor, AssetEditor::open(path, options, ignored));
    TENON_TRY(const auto views, editor.views());
    Stages stages;
    for (const AssetEditor::View& view : views) {
      stages.push_back(view.stage);
    }
    TENON_TRY(authored.edits, read(stages, request, options.engine));
  }
  TENON_TRY(authored.asset, edit_asset(path, authored.edits, options, diagnostics));
  return authored;
}

}  // namespace

Result<MadeFile> new_asset(const std::string& file, const NewAsset& wanted) {
  if (!is_identifier(wanted.default_prim)) {
    return Error(ErrorCode::Invalid, "\"" + wanted.default_prim + "\" is not a prim name")
        .with_rule("edit.bad-name")
        .with_fix("use letters, digits and '_', no digit in front");
  }
  edit::StageEditor editor = edit::StageEditor::in_memory(bytes::absolute_file_path(file));
  const Path root = Path::absolute_root();
  const Token name(wanted.default_prim);
  TENON_CHECK(editor.set_metadata(root, layer::fields::defaultPrim, layer::Value(name)));
  TENON_CHECK(
      editor.set_metadata(root, Token("metersPerUnit"), layer::Value(wanted.meters_per_unit)));
  TENON_CHECK(editor.set_metadata(root, Token("kilogramsPerUnit"),
                                  layer::Value(wanted.kilograms_per_unit)));
  TENON_CHECK(editor.set_metadata(root, Token("upAxis"), layer::Value(Token(wanted.up_axis))));
  TENON_CHECK(editor.define_prim(root.child(name), Token("Xform")));
  const layer::LayerPtr made = editor.layer(bytes::absolute_file_path(file));
  TENON_TRY(std::string contents, new_contents(*made, file));
  return MadeFile{file, std::move(contents)};
}

Result<AuthoredAsset> add_to_asset(const std::string& path, const AuthoringRequest& request,
                                   const EditOptions& options, Diagnostics& diagnostics) {
  return author(path, request, options, add_edits, diagnostics);
}

Result<AuthoredAsset> remove_from_asset(const std::string& path, const AuthoringRequest& request,
                                        const EditOptions& options, Diagnostics& diagnostics) {
  return author(path, request, options, remove_edits, diagnostics);
}

Result<AuthoredAsset> rename_in_asset(const std::string& path, const std::string& prim,
                                      const std::string& name, const EditOptions& options,
                                      Diagnostics& diagnostics) {
  const auto object = Path::parse(prim);
  if (!object || !object->is_absolute() || !object->is_prim()) {
    return not_a_path(prim, "prim");
  }
  AssetEdit edit;
  edit.kind = AssetEdit::Kind::RenamePrim;
  edit.object = *object;
  edit.value = name;
  edit.may_rest = true;
  AuthoredAsset authored{{edit}, {}};
  TENON_TRY(authored.asset, edit_asset(path, authored.edits, options, diagnostics));
  return authored;
}

}  // namespace tenon
