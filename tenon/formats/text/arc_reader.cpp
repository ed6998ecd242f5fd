// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// References, payloads, inherits, specializes and sublayers are lists of targets, some with
// parameters in parentheses; relocates are pairs of paths. Inherits, specializes and relocates are
// made absolute here, so that no later code needs to know where they stood. References and payloads
// have to be absolute as written. A list is stored only after it was read as a whole, so one with a
// fault leaves nothing in the layer.
#include "tenon/formats/text/arc_reader.h"

#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"

namespace tenon::formats::text {
namespace {

using layer::LayerOffset;
using layer::Value;

/// Takes "None" or "[...]" or one item; `item()` reads one.
template <class Item>
bool read_none_or_list(Cursor& cursor, Item item) {
  if (cursor.accept_word("None")) {
    return true;
  }
  if (!cursor.accept('[')) {
    return item();
  }
  cursor.skip_multi_line();
  return cursor.accept(']') || read_items(cursor, ']', "of the list", item);
}

bool read_offset_part(Cursor& cursor, LayerOffset& offset) {
  const bool is_offset = cursor.accept_word("offset");
  if (!is_offset && !cursor.accept_word("scale")) {
    return cursor.fail_expected("`offset` or `scale`");
  }
  return read_assignment(cursor) && read_double(cursor, is_offset ? offset.offset : offset.scale);
}

/// `(offset = 1; scale = 2)` when it is there; `extra()` reads another entry or does nothing.
template <class Extra>
bool read_arc_parameters(Cursor& cursor, LayerOffset& offset, Extra extra) {
  const std::size_t before = cursor.offset();
  cursor.skip_inline();
  if (!cursor.accept('(')) {
    cursor.seek(before);
    return true;
  }
  return read_statements(cursor, ')', "after the offset", [&] {
    bool taken = false;
    return extra(taken) && (taken || read_offset_part(cursor, offset));
  });
}

/// `@asset@</prim>`, `@asset@` or `</prim>`.
template <class Arc>
bool read_arc_target(Cursor& cursor, Arc& arc) {
  const std::size_t start = cursor.offset();
  if (cursor.peek() == '@') {
    if (!read_asset_path(cursor, arc.asset_path)) {
      return false;
    }
    if (arc.asset_path.empty()) {
      return cursor.fail_at(start, ErrorCode::Parse, "text.arc", "this asset path is empty",
                            "name a file, or leave @@ out to mean this layer stack");
    }
    const std::size_t after = cursor.offset();
    cursor.skip_inline();
    if (cursor.peek() != '<') {
      cursor.seek(after);
      return true;
    }
  } else if (cursor.peek() != '<') {
    return cursor.fail_expected("an asset path @file.usda@, a prim path </Prim>, '[' or None");
  }
  const std::size_t path_start = cursor.offset();
  if (!read_path(cursor, arc.prim_path)) {
    return false;
  }
  if (arc.prim_path.empty() ||
      (arc.prim_path.is_prim() && arc.prim_path.is_absolute() && !arc.prim_path.has_variants())) {
    return true;
  }
  return cursor.fail_at(
      path_start, ErrorCode::Parse, "text.arc",
      "<" + arc.prim_path.str() + "> is not an absolute prim path without variant selections");
}

bool check_relocate(Cursor& cursor, std::size_t start, Path path, bool may_be_empty) {
  const bool fits = path.empty() ? may_be_empty : path.is_prim() && !path.has_variants();
  return fits || cursor.fail_at(start, ErrorCode::Parse, "text.relocates",
                                "<" + path.str() + "> is not a prim path, as relocates need it");
}

bool read_relocate(Cursor& cursor, layer::Relocates& relocates) {
  std::size_t start = cursor.offset();
  Path source;
  Path target;
  if (!read_path(cursor, source) || !check_relocate(cursor, start, source, false)) {
    return false;
  }
  cursor.skip_inline();
  if (!cursor.expect(':', "between the two paths of a relocate")) {
    return false;
  }
  cursor.skip_inline();
  start = cursor.offset();
  if (!read_path(cursor, target) || !check_relocate(cursor, start, target, true)) {
    return false;
  }
  const Path root = Path::absolute_root();
  relocates.pairs.emplace_back(source.absolute(root), target.absolute(root));
  return true;
}

}  // namespace

bool read_assignment(Cursor& cursor) {
  cursor.skip_inline();
  if (!cursor.expect('=', "before the value")) {
    return false;
  }
  cursor.skip_inline();
  return true;
}

bool read_path_list(Cursor& cursor, std::vector<Path>& paths) {
  return read_none_or_list(cursor, [&] {
    if (cursor.peek() != '<') {
      return cursor.fail_expected("a path such as </World/Body>, '[' or None");
    }
    return read_path(cursor, paths.emplace_back());
  });
}

bool read_references(LayerState& state, Path prim, ListEdit edit) {
  Cursor& cursor = state.cursor;
  if (!read_assignment(cursor)) {
    return false;
  }
  const std::size_t start = cursor.offset();
  std::vector<layer::Reference> items;
  const bool ok = read_none_or_list(cursor, [&] {
    layer::Reference& item = items.emplace_back();
    return read_arc_target(cursor, item) &&
           read_arc_parameters(cursor, item.offset, [&](bool& taken) {
             taken = cursor.accept_word("customData");
             return !taken ||
                    (read_assignment(cursor) && read_dictionary(cursor, item.custom_data));
           });
  });
  if (!ok || !check_items(cursor, start, edit, items)) {
    return false;
  }
  set_items(state.layer.create(prim, layer::SpecKind::Prim), layer::fields::references, edit,
            std::move(items));
  return true;
}

bool read_payload(LayerState& state, Path prim, ListEdit edit) {
  Cursor& cursor = state.cursor;
  if (!read_assignment(cursor)) {
    return false;
  }
  const std::size_t start = cursor.offset();
  std::vector<layer::Payload> items;
  const bool ok = read_none_or_list(cursor, [&] {
    layer::Payload& item = items.emplace_back();
    return read_arc_target(cursor, item) &&
           read_arc_parameters(cursor, item.offset, [](bool&) { return true; });
  });
  if (!ok || !check_items(cursor, start, edit, items)) {
    return false;
  }
  set_items(state.layer.create(prim, layer::SpecKind::Prim), layer::fields::payload, edit,
            std::move(items));
  return true;
}

bool read_prim_paths(LayerState& state, Path prim, Token field, ListEdit edit) {
  Cursor& cursor = state.cursor;
  if (!read_assignment(cursor)) {
    return false;
  }
  const std::size_t start = cursor.offset();
  std::vector<Path> items;
  if (!read_path_list(cursor, items)) {
    return false;
  }
  for (Path& item : items) {
    const Path path = item.absolute(prim.prim());
    if (path.empty() || !path.is_prim() || path.has_variants()) {
      const auto number = static_cast<std::size_t>(&item - items.data());
      return cursor.fail_at(offset_of_item(cursor.text(), start, number), ErrorCode::Parse,
                            "text.arc",
                            "<" + item.str() + "> is not a prim path without variant selections");
    }
    item = path;
  }
  if (!check_items(cursor, start, edit, items)) {
    return false;
  }
  set_items(state.layer.create(prim, layer::SpecKind::Prim), field, edit, std::move(items));
  return true;
}

bool read_sublayers(LayerState& state) {
  Cursor& cursor = state.cursor;
  if (!read_assignment(cursor) || !cursor.expect('[', "before the sublayers")) {
    return false;
  }
  std::vector<std::string> paths;
  std::vector<LayerOffset> offsets;
  cursor.skip_multi_line();
  const bool ok =
      cursor.accept(']') || read_items(cursor, ']', "of the sublayers", [&] {
        return read_asset_path(cursor, paths.emplace_back()) &&
               read_arc_parameters(cursor, offsets.emplace_back(), [](bool&) { return true; });
      });
  if (ok && !paths.empty()) {
    state.layer.root().set(layer::fields::subLayers, Value(std::move(paths)));
    state.layer.root().set(layer::fields::subLayerOffsets, Value(std::move(offsets)));
  }
  return ok;
}

bool read_layer_relocates(LayerState& state) {
  Cursor& cursor = state.cursor;
  if (!read_assignment(cursor) || !cursor.expect('{', "before the relocates")) {
    return false;
  }
  layer::Relocates relocates;
  cursor.skip_multi_line();
  const bool ok = cursor.accept('}') || read_items(cursor, '}', "of the relocates", [&] {
                    return read_relocate(cursor, relocates);
                  });
  if (ok) {
    state.layer.root().set(layer::fields::layerRelocates, Value(std::move(relocates)));
  }
  return ok;
}

}  // namespace tenon::formats::text
