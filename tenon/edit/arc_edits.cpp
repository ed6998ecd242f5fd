// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Arcs to other prims and layers, and variants.
#include <algorithm>
#include <cmath>

#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/fields.h"

namespace tenon::edit {

using layer::Value;
namespace fields = layer::fields;

namespace {

Error bad_arc(Path prim, const std::string& what, const std::string& fix) {
  return Error(ErrorCode::Invalid, what)
      .with_prim(prim.str())
      .with_rule("edit.bad-path")
      .with_fix(fix);
}

bool is_arc_target(Path path) {
  return path.is_absolute() && path.is_prim() && !path.has_variants();
}

template <class T>
Result<void> check_distinct(Path prim, const std::vector<T>& items) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    if (std::find(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(i), items[i]) !=
        items.begin() + static_cast<std::ptrdiff_t>(i)) {
      return bad_arc(prim, "the list names one item twice", "name each item once");
    }
  }
  return {};
}

Result<void> check_offset(Path prim, const layer::LayerOffset& offset) {
  if (std::isfinite(offset.offset) && std::isfinite(offset.scale)) {
    return {};
  }
  return bad_arc(prim, "the layer offset is not a finite number", "give finite numbers");
}

/// Prim paths of internal arcs are mapped through the edit target; root prims name classes and the
/// like beside what an arc brings in and stay.
Result<void> map_arc(const EditTarget& place, Path prim, Path& path) {
  if (!is_arc_target(path)) {
    return bad_arc(prim, "<" + path.str() + "> is not an absolute prim path",
                   "name a prim from the root, without variant selections");
  }
  if (path.parent().is_absolute_root()) {
    return {};
  }
  const Path mapped = place.target_path(path);
  if (mapped.empty()) {
    return outside_target(path, place.layer);
  }
  path = mapped;
  return {};
}

}  // namespace

template <class Arc>
Result<void> StageEditor::edit_arcs(Path prim, Token field, ListEdit<Arc> edit) {
  for (Arc& arc : edit.items) {
    TENON_CHECK(check_offset(prim, arc.offset));
    if (arc.asset_path.empty() && !arc.prim_path.empty()) {
      TENON_CHECK(map_arc(target_, prim, arc.prim_path));
    } else if (!arc.prim_path.empty() && !is_arc_target(arc.prim_path)) {
      return bad_arc(prim, "<" + arc.prim_path.str() + "> is not an absolute prim path",
                     "name a prim from the root, without variant selections");
    }
  }
  TENON_CHECK(check_distinct(prim, edit.items));
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.edit_list(path, field, edit);
    return {};
  });
}

Result<void> StageEditor::edit_references(Path prim, ListEdit<layer::Reference> edit) {
  return edit_arcs(prim, fields::references, std::move(edit));
}

Result<void> StageEditor::edit_payloads(Path prim, ListEdit<layer::Payload> edit) {
  return edit_arcs(prim, fields::payload, std::move(edit));
}

Result<void> StageEditor::edit_class_arcs(Path prim, Token field, ListEdit<Path> edit) {
  for (Path& path : edit.items) {
    TENON_CHECK(map_arc(target_, prim, path));
  }
  TENON_CHECK(check_distinct(prim, edit.items));
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.edit_list(path, field, edit);
    return {};
  });
}

Result<void> StageEditor::edit_inherits(Path prim, ListEdit<Path> edit) {
  return edit_class_arcs(prim, fields::inheritPaths, std::move(edit));
}

Result<void> StageEditor::edit_specializes(Path prim, ListEdit<Path> edit) {
  return edit_class_arcs(prim, fields::specializes, std::move(edit));
}

// Of the target layer

Result<void> StageEditor::insert_sublayer(std::size_t index, std::string asset_path,
                                          layer::LayerOffset offset) {
  const Path root = Path::absolute_root();
  TENON_CHECK(check_offset(root, offset));
  return edit([&](LayerEditor& editor) -> Result<void> {
    std::vector<std::string> paths = editor.layer().sublayers();
    std::vector<layer::LayerOffset> offsets;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      offsets.push_back(editor.layer().sublayer_offset(i));
    }
    const bool known = std::find(paths.begin(), paths.end(), asset_path) != paths.end();
    if (index > paths.size() || asset_path.empty() || known) {
      return bad_arc(root,
                     known ? "@" + asset_path + "@ is a sublayer already"
                           : "@" + asset_path + "@ cannot be sublayer " + std::to_string(index),
                     "give a path that is not there yet and an index up to their number");
    }
    const auto at = static_cast<std::ptrdiff_t>(index);
    paths.insert(paths.begin() + at, asset_path);
    offsets.insert(offsets.begin() + at, offset);
    editor.set(root, fields::subLayers, Value(std::move(paths)));
    editor.set(root, fields::subLayerOffsets, Value(std::move(offsets)));
    return {};
  });
}

Result<void> StageEditor::remove_sublayer(std::size_t index) {
  const Path root = Path::absolute_root();
  return edit([&](LayerEditor& editor) -> Result<void> {
    std::vector<std::string> paths = editor.layer().sublayers();
    if (index >= paths.size()) {
      return bad_arc(root, "there is no sublayer " + std::to_string(index),
                     "give an index below their number");
    }
    std::vector<layer::LayerOffset> offsets;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      offsets.push_back(editor.layer().sublayer_offset(i));
    }
    const auto at = static_cast<std::ptrdiff_t>(index);
    paths.erase(paths.begin() + at);
    offsets.erase(offsets.begin() + at);
    if (paths.empty()) {
      editor.erase(root, fields::subLayers);
      editor.erase(root, fields::subLayerOffsets);
      return {};
    }
    editor.set(root, fields::subLayers, Value(std::move(paths)));
    editor.set(root, fields::subLayerOffsets, Value(std::move(offsets)));
    return {};
  });
}

Result<void> StageEditor::set_relocates(layer::Relocates relocates) {
  const Path root = Path::absolute_root();
  for (const auto& [source, target] : relocates.pairs) {
    if (!is_arc_target(source) || (!target.empty() && !is_arc_target(target))) {
      return bad_arc(root, "<" + source.str() + "> to <" + target.str() + "> is not a relocate",
                     "name two prims from the root, or no target to delete the source");
    }
  }
  return edit([&](LayerEditor& editor) -> Result<void> {
    relocates.pairs.empty() ? editor.erase(root, fields::layerRelocates)
                            : editor.set(root, fields::layerRelocates, Value(std::move(relocates)));
    return {};
  });
}

// Variants

Result<void> StageEditor::add_variant_set(Path prim, const std::string& set,
                                          ListPosition position) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) {
    return editor.create_variant_set(path, set, position);
  });
}

Result<void> StageEditor::add_variant(Path prim, const std::string& set, const std::string& variant,
                                      ListPosition position) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    TENON_CHECK(editor.create_variant_set(path, set, position));
    return editor.create_variant(path, set, variant);
  });
}

Result<void> StageEditor::set_variant_selection(Path prim, const std::string& set,
                                                const std::string& variant) {
  const bool is_expression = variant.size() > 1 && variant.front() == '`' && variant.back() == '`';
  if (!is_variant_name(set) || !(is_expression || is_variant_name(variant))) {
    return bad_variant(set, variant);
  }
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.select_variant(path, set, variant);
    return {};
  });
}

Result<void> StageEditor::clear_variant_selection(Path prim, const std::string& set) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.clear_selection(path, set);
    return {};
  });
}

Result<void> StageEditor::block_variant_selection(Path prim, const std::string& set) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.select_variant(path, set, {});
    return {};
  });
}

}  // namespace tenon::edit
