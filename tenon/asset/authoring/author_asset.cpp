// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/authoring/author_asset.h"

#include <functional>
#include <utility>

#include "tenon/asset/authoring/remove_edits.h"
#include "tenon/asset/layers/asset_layers.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/fields.h"
#include "tenon/property_value.h"

namespace tenon {
namespace {

using ReadRequest = std::function<Result<std::vector<AssetEdit>>(const Stages&)>;

/// What an arc names must be a layer; else the prim would stay empty.
Result<void> check_opens(const AssetArc& arc, const bytes::Files& files) {
  TENON_TRY(const auto contents, files->open(arc.file, {}));
  Diagnostics ignored;
  const bool opens = formats::format_of(*contents) == formats::LayerFormat::Package ||
                     formats::read_layer(contents, arc.file, ignored);
  if (opens) {
    return {};
  }
  const std::string name = shown_path(arc.file);
  return Error(ErrorCode::Invalid, "it cannot be read as USD, so nothing can reference it")
      .in_file(arc.file)
      .with_rule("edit.not-a-layer")
      .with_fix("name a .usd, .usda, .usdc or .usdz file; tenon check " + shell_word(name) +
                " says what is wrong with a USD file, tenon convert reads URDF, SDF and MJCF");
}

Result<AuthoredAsset> author(const std::string& path, const EditOptions& options,
                             const ReadRequest& read, Diagnostics& diagnostics) {
  Diagnostics ignored;  // of opening: edit_asset opens again and reports
  AuthoredAsset authored;
  {
    TENON_TRY(AssetEditor editor, AssetEditor::open(path, options, ignored));
    TENON_TRY(const auto views, editor.views());
    Stages stages;
    for (const AssetEditor::View& view : views) {
      stages.push_back(view.stage);
    }
    TENON_TRY(authored.edits, read(stages));
    for (const AssetEdit& edit : authored.edits) {
      if (edit.arc) {
        TENON_CHECK(check_opens(*edit.arc, options.open.files));
      }
    }
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
  for (const auto& [field, value] : {std::pair("timeCodesPerSecond", wanted.time_codes_per_second),
                                     std::pair("startTimeCode", wanted.start_time_code),
                                     std::pair("endTimeCode", wanted.end_time_code)}) {
    if (value) {
      TENON_CHECK(editor.set_metadata(root, Token(field), layer::Value(*value)));
    }
  }
  TENON_CHECK(editor.define_prim(root.child(name), Token("Xform")));
  const layer::LayerPtr made = editor.layer(bytes::absolute_file_path(file));
  TENON_TRY(std::string contents, new_contents(*made, file));
  return MadeFile{file, std::move(contents)};
}

Result<AuthoredAsset> add_to_asset(const std::string& path, const AuthoringRequest& request,
                                   const EditOptions& options, Diagnostics& diagnostics) {
  const auto read = [&](const Stages& stages) {
    return add_edits(stages, request, options, diagnostics);
  };
  return author(path, options, read, diagnostics);
}

Result<AuthoredAsset> remove_from_asset(const std::string& path, const AuthoringRequest& request,
                                        const EditOptions& options, Diagnostics& diagnostics) {
  const auto read = [&](const Stages& stages) {
    return remove_edits(stages, request, options.engine);
  };
  return author(path, options, read, diagnostics);
}

Result<AuthoredAsset> rename_in_asset(const std::string& path, const std::string& named,
                                      const std::string& name, const EditOptions& options,
                                      Diagnostics& diagnostics) {
  const auto object = Path::parse(named);
  const bool fits = object && object->is_absolute() && (object->is_prim() || object->is_property());
  if (!fits) {
    return not_a_path(named, "prim or property");
  }
  AssetEdit edit;
  edit.kind = object->is_prim() ? AssetEdit::Kind::RenamePrim : AssetEdit::Kind::RenameProperty;
  edit.object = *object;
  edit.value = name;
  edit.may_rest = true;
  AuthoredAsset authored{{edit}, {}};
  TENON_TRY(authored.asset, edit_asset(path, authored.edits, options, diagnostics));
  return authored;
}

}  // namespace tenon
