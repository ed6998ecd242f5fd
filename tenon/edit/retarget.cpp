// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// When a prim moves, what names it in its layer stack follows.
#include "tenon/edit/default_prim.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/layer/fields.h"

namespace tenon::edit {
namespace {

using layer::Value;
namespace fields = layer::fields;

using Moves = std::map<Path, Path>;

/// Paths with targets in them name prims in several places.
bool follow_each(Path& path, const Moves& moves) {
  const Path before = path;
  for (auto move = moves.rbegin(); move != moves.rend(); ++move) {  // what is below comes first
    path = path.replace_prefix(move->first, move->second);
  }
  return !(path == before);
}

bool follow(Path& path, const Moves& moves) {
  const bool is_plain = path.is_prim_or_variant() ||
                        (path.is_direct_property() && path.parent().is_prim_or_variant());
  if (moves.size() == 1 || !is_plain) {
    return follow_each(path, moves);
  }
  bool changed = false;
  for (Path at = path; !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    const auto move = moves.find(at);
    if (move != moves.end()) {
      path = path.replace_prefix(at, move->second);
      changed = true;
    }
  }
  return changed;
}

template <class Arc>
bool follow(Arc& arc, const Moves& moves) {
  return arc.asset_path.empty() && !arc.prim_path.empty() && follow(arc.prim_path, moves);
}

template <class T>
bool follow_list(Value& value, const Moves& moves) {
  const auto* op = value.get<layer::ListOp<T>>();
  if (op == nullptr) {
    return false;
  }
  layer::ListOp<T> now = *op;
  bool changed = false;
  for (std::vector<T>* list : {&now.explicit_items, &now.prepended, &now.appended, &now.deleted,
                               &now.added, &now.ordered}) {
    for (T& item : *list) {
      changed = follow(item, moves) || changed;
    }
  }
  if (changed) {
    value = Value(std::move(now));
  }
  return changed;
}

bool follow_relocates(Value& value, const Moves& moves) {
  const auto* relocates = value.get<layer::Relocates>();
  if (relocates == nullptr) {
    return false;
  }
  layer::Relocates now = *relocates;
  bool changed = false;
  for (auto& [source, target] : now.pairs) {
    changed = follow(source, moves) || changed;
    changed = (!target.empty() && follow(target, moves)) || changed;
  }
  if (changed) {
    value = Value(std::move(now));
  }
  return changed;
}

bool follow_default_prim(Value& value, const Moves& moves) {
  const auto* text = value.get<Token>();
  Path path = text == nullptr ? Path() : default_prim_path(*text);
  if (path.empty() || !follow(path, moves)) {
    return false;
  }
  const bool as_name = text->view().front() != '/' && path.parent().is_absolute_root();
  value = Value(as_name ? path.name() : Token(path.str()));
  return true;
}

bool follow_expressions(Path spec, Value& value, const Moves& moves) {
  return layer::map_paths(value, spec.prim(), [&moves](Path path) {
    follow(path, moves);
    return path;
  });
}

bool follow_field(Path spec, Token name, Value& value, const Moves& moves) {
  if (name == fields::targetPaths || name == fields::connectionPaths ||
      name == fields::inheritPaths || name == fields::specializes) {
    return follow_list<Path>(value, moves);
  }
  if (name == fields::references) {
    return follow_list<layer::Reference>(value, moves);
  }
  if (name == fields::payload) {
    return follow_list<layer::Payload>(value, moves);
  }
  if (name == fields::layerRelocates) {
    return follow_relocates(value, moves);
  }
  return name == fields::defaultPrim ? follow_default_prim(value, moves)
                                     : follow_expressions(spec, value, moves);
}

}  // namespace

void LayerEditor::retarget(const Moves& moves) {
  std::vector<Path> paths;
  for (const layer::Layer::Entry& entry : layer_->entries()) {
    if (!entry.path.empty()) {
      paths.push_back(entry.path);
    }
  }
  for (const Path path : paths) {
    const layer::Spec* spec = layer_->find(path);
    const layer::FieldList spec_fields = spec == nullptr ? layer::FieldList() : spec->field_list();
    for (const layer::Field& field : spec_fields.items()) {
      Value value = field.value;
      if (follow_field(path, field.name, value, moves)) {
        set(path, field.name, std::move(value));
      }
    }
  }
}

}  // namespace tenon::edit
