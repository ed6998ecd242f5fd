// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// When a prim moves, what names it in its layer stack follows.
#include "tenon/edit/default_prim.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/layer/fields.h"

namespace tenon::edit {
namespace {

using layer::Value;
namespace fields = layer::fields;

struct Move {
  Path from;
  Path to;
};

bool follow(Path& path, const Move& move) {
  const Path now = path.replace_prefix(move.from, move.to);
  const bool changed = !(now == path);
  path = now;
  return changed;
}

template <class Arc>
bool follow(Arc& arc, const Move& move) {
  return arc.asset_path.empty() && !arc.prim_path.empty() && follow(arc.prim_path, move);
}

template <class T>
bool follow_list(Value& value, const Move& move) {
  const auto* op = value.get<layer::ListOp<T>>();
  if (op == nullptr) {
    return false;
  }
  layer::ListOp<T> now = *op;
  bool changed = false;
  for (std::vector<T>* list : {&now.explicit_items, &now.prepended, &now.appended, &now.deleted,
                               &now.added, &now.ordered}) {
    for (T& item : *list) {
      changed = follow(item, move) || changed;
    }
  }
  if (changed) {
    value = Value(std::move(now));
  }
  return changed;
}

bool follow_relocates(Value& value, const Move& move) {
  const auto* relocates = value.get<layer::Relocates>();
  if (relocates == nullptr) {
    return false;
  }
  layer::Relocates now = *relocates;
  bool changed = false;
  for (auto& [source, target] : now.pairs) {
    changed = follow(source, move) || changed;
    changed = (!target.empty() && follow(target, move)) || changed;
  }
  if (changed) {
    value = Value(std::move(now));
  }
  return changed;
}

bool follow_default_prim(Value& value, const Move& move) {
  const auto* text = value.get<Token>();
  Path path = text == nullptr ? Path() : default_prim_path(*text);
  if (path.empty() || !follow(path, move)) {
    return false;
  }
  const bool as_name = text->view().front() != '/' && path.parent().is_absolute_root();
  value = Value(as_name ? path.name() : Token(path.str()));
  return true;
}

bool follow_field(Token name, Value& value, const Move& move) {
  if (name == fields::targetPaths || name == fields::connectionPaths ||
      name == fields::inheritPaths || name == fields::specializes) {
    return follow_list<Path>(value, move);
  }
  if (name == fields::references) {
    return follow_list<layer::Reference>(value, move);
  }
  if (name == fields::payload) {
    return follow_list<layer::Payload>(value, move);
  }
  if (name == fields::layerRelocates) {
    return follow_relocates(value, move);
  }
  return name == fields::defaultPrim && follow_default_prim(value, move);
}

}  // namespace

void LayerEditor::retarget(Path from, Path to) {
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
      if (follow_field(field.name, value, {from, to})) {
        set(path, field.name, std::move(value));
      }
    }
  }
}

}  // namespace tenon::edit
