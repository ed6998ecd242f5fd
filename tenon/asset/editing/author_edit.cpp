// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// One edit becomes calls of edit::StageEditor at its edit target. Several calls are one step of the
// history, so that an edit that fails leaves nothing behind. Long arrays of meshes go into the
// layer as values, not by way of text.
#include "tenon/asset/editing/author_edit.h"

#include <algorithm>
#include <string>

#include "tenon/asset/editing/whole_prim_edits.h"
#include "tenon/edit/apply_list_edit.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/layer/fields.h"
#include "tenon/mesh/mesh_shape.h"

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
    TENON_CHECK(edit.time ? editor.clear_value(edit.object, *edit.time)
                : edit.kind == Kind::ClearProperty
                    ? editor.remove_property(edit.object)
                    : remove_api(editor, edit.object, spec, edit.api));
    return edit.tidy ? editor.remove_silent_prim(edit.object.prim()) : Result<void>();
  });
}

layer::Value extent_value(const std::vector<Vec3f>& points) {
  const auto [low, high] = mesh::extent_of(points);
  return layer::Value(std::vector<Vec3f>{low, high});
}

/// Writes what a Mesh shows; `spec` is the prim in the layer.
Result<void> write_mesh(edit::LayerEditor& editor, Path spec, const MeshGeometry& mesh) {
  const auto set = [&](const char* name, const char* type, layer::Value value,
                       const char* interpolation = nullptr,
                       layer::Variability variability =
                           layer::Variability::Varying) -> Result<void> {
    const Path property = spec.property(Token(name));
    TENON_CHECK(editor.create_attribute(property, Token(type), variability, false));
    editor.set(property, fields::default_value, std::move(value));
    if (interpolation != nullptr) {
      editor.set(property, Token("interpolation"), layer::Value(Token(interpolation)));
    }
    return {};
  };
  const mesh::PolygonMesh& shape = mesh.shape;
  TENON_CHECK(set("extent", "float3[]", extent_value(shape.points)));
  TENON_CHECK(set("faceVertexCounts", "int[]", layer::Value(shape.face_counts)));
  TENON_CHECK(set("faceVertexIndices", "int[]", layer::Value(shape.face_points)));
  const bool flat = shape.normals.empty();
  TENON_CHECK(set("normals", "normal3f[]",
                  layer::Value(flat ? mesh::face_normals(shape) : shape.normals),
                  flat ? "uniform" : "faceVarying"));
  TENON_CHECK(set("points", "point3f[]", layer::Value(shape.points)));
  if (!mesh.colors.empty()) {
    TENON_CHECK(set("primvars:displayColor", "color3f[]", layer::Value(mesh.colors),
                    mesh.colors.size() == 1 ? "constant" : "uniform"));
  }
  if (!shape.texture_coordinates.empty()) {
    TENON_CHECK(
        set("primvars:st", "texCoord2f[]", layer::Value(shape.texture_coordinates), "faceVarying"));
  }
  return set("subdivisionScheme", "token", layer::Value(Token("none")), nullptr,
             layer::Variability::Uniform);
}

Result<void> define_prim(edit::StageEditor& editor, const AssetEdit& edit, Path spec) {
  return editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(editor.define_prim(edit.object, edit.type_name));
    if (edit.mesh != nullptr) {
      return editor.edit_layer(editor.target().layer, [&](edit::LayerEditor& specs) {
        return write_mesh(specs, spec, *edit.mesh);
      });
    }
    return edit.arc ? author_arc(editor, edit.object, *edit.arc) : Result<void>();
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

Result<void> connect(edit::StageEditor& editor, const AssetEdit& edit, const PropertyValue& typed) {
  if (typed.is_relationship) {
    return Error(ErrorCode::Invalid, "<" + edit.object.str() + "> is a relationship")
        .with_prim(edit.object.prim().str())
        .with_rule("edit.type-mismatch")
        .with_fix("attributes have connections; set the targets of a relationship");
  }
  return editor.as_one_step([&]() -> Result<void> {
    TENON_CHECK(
        editor.create_attribute(edit.object, typed.type_name, typed.custom, typed.variability));
    return editor.edit_connections(edit.object, edit.targets.empty()
                                                    ? edit::ListEdit<Path>::clear()
                                                    : edit::ListEdit<Path>::set(edit.targets));
  });
}

/// A property gets its value, or its targets.
Result<void> set_property(edit::StageEditor& editor, const AssetEdit& edit,
                          const PropertyValue& typed) {
  const Path object = edit.object;
  return editor.as_one_step([&]() -> Result<void> {
    if (typed.is_relationship) {
      TENON_CHECK(editor.create_relationship(object, typed.custom));
      return editor.edit_targets(object, edit::ListEdit<Path>::set(typed.targets));
    }
    TENON_CHECK(editor.create_attribute(object, typed.type_name, typed.custom, typed.variability));
    return editor.set_value(object, typed.value,
                            edit.time ? stage::Time(*edit.time) : stage::Time());
  });
}

}  // namespace

Result<void> author_edit(edit::StageEditor& editor, const AssetEdit& edit, Path spec,
                         const PropertyValue& typed) {
  if (edit.is_about_specs()) {
    return Error(ErrorCode::Invalid, "this edit is of all files at once");
  }
  switch (edit.kind) {
    case Kind::SetProperty:
      return set_property(editor, edit, typed);
    case Kind::ClearProperty:
    case Kind::RemoveApi:
      return take_away(editor, edit, spec);
    case Kind::ApplyApi:
      return editor.as_one_step([&]() -> Result<void> {
        TENON_CHECK(editor.withdraw_applied_schema(edit.object, edit.api));  // a deletion, too
        return editor.apply_api(edit.object, edit.api);
      });
    case Kind::AddTargets:
    case Kind::RemoveTargets:
      return edit_target_list(editor, edit, typed);
    case Kind::Connect:
      return connect(editor, edit, typed);
    case Kind::DefinePrim:
      return define_prim(editor, edit, spec);
    case Kind::AddVariant:
      return add_variant(editor, edit);
    default:
      return author_whole_prim(editor, edit, spec, typed);
  }
}

}  // namespace tenon
