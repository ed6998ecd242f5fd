// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A prim may have a spec in each variant of the prims above it: all that have its path without
// variant selections are edited. Targets and arcs never hold selections, so that they are compared
// with that path.
#include "tenon/asset/editing/spec_edits.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "tenon/asset/editing/edit_refusals.h"
#include "tenon/edit/default_prim.h"
#include "tenon/layer/arcs.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

namespace fields = layer::fields;

/// Those of the prim for which `is_wanted` holds, such as Path::is_prim.
std::vector<Path> specs_of(const layer::Layer& layer, Path prim, bool (Path::*is_wanted)() const) {
  std::vector<Path> found;
  for (const layer::Layer::Entry& entry : layer.entries()) {
    if ((entry.path.*is_wanted)() && entry.path.strip_variants() == prim) {
      found.push_back(entry.path);
    }
  }
  return found;
}

template <class T>
std::vector<std::vector<T>*> all_lists(layer::ListOp<T>& op) {
  return {&op.explicit_items, &op.prepended, &op.appended, &op.deleted, &op.added, &op.ordered};
}

/// The arcs of a spec that lead to the prim or below, within its layer stack.
template <class Arc>
bool leads_to(const layer::Spec& spec, Token field, Path prim) {
  const auto* op = spec.get<layer::ListOp<Arc>>(field);
  if (op == nullptr) {
    return false;
  }
  layer::ListOp<Arc> copy = *op;
  for (const auto* list : all_lists(copy)) {
    for (const Arc& arc : *list) {
      if constexpr (std::is_same_v<Arc, Path>) {
        if (arc.has_prefix(prim)) {
          return true;
        }
      } else if (arc.asset_path.empty() && arc.prim_path.has_prefix(prim)) {
        return true;
      }
    }
  }
  return false;
}

Result<void> check_no_arc_leads_to(const layer::Layer& layer, Path prim) {
  for (const layer::Layer::Entry& entry : layer.entries()) {
    const layer::Spec* spec = entry.path.is_prim_or_variant() ? layer.find(entry.path) : nullptr;
    if (spec == nullptr || entry.path.strip_variants().has_prefix(prim)) {
      continue;
    }
    if (leads_to<layer::Reference>(*spec, fields::references, prim) ||
        leads_to<layer::Payload>(*spec, fields::payload, prim) ||
        leads_to<Path>(*spec, fields::inheritPaths, prim) ||
        leads_to<Path>(*spec, fields::specializes, prim)) {
      return used_by_arc(entry.path, prim).in_file(layer.identifier()).at(spec->line, 1);
    }
  }
  return {};
}

/// Takes all that begins with `prim` out of the lists of a field; nothing changes where none does.
bool drop_from(edit::LayerEditor& editor, Path property, Token field, Path prim) {
  auto op = editor.get_or(property, field, layer::ListOp<Path>{});
  bool changed = false;
  for (std::vector<Path>* list : all_lists(op)) {
    changed = std::erase_if(*list, [&](Path path) { return path.has_prefix(prim); }) > 0 || changed;
  }
  if (changed) {
    // One that replaces weaker lists goes on hiding them when it is empty.
    op.empty() ? editor.erase(property, field)
               : editor.set(property, field, layer::Value(std::move(op)));
  }
  return changed;
}

/// The same of path expressions: what names the prim matches nothing.
bool drop_from_expressions(edit::LayerEditor& editor, Path property, Path prim) {
  const layer::Spec* spec = editor.layer().find(property);
  const layer::Value* found = spec == nullptr ? nullptr : spec->find(fields::default_value);
  layer::Value value = found == nullptr ? layer::Value() : *found;
  const bool changed = layer::map_paths(
      value, property.prim(), [&](Path path) { return path.has_prefix(prim) ? Path() : path; });
  if (changed) {
    editor.set(property, fields::default_value, std::move(value));
  }
  return changed;
}

/// What the layer itself says that names the prim: its default prim, its relocates. What was
/// relocated there does not come back to where it was.
bool drop_from_layer(edit::LayerEditor& editor, Path prim) {
  const Path root = Path::absolute_root();
  const Path default_prim = edit::default_prim_path(editor.layer().default_prim());
  const bool is_default = !default_prim.empty() && default_prim.has_prefix(prim);
  if (is_default) {
    editor.erase(root, fields::defaultPrim);
  }
  auto relocates = editor.get_or(root, fields::layerRelocates, layer::Relocates{});
  bool changed = std::erase_if(relocates.pairs,
                               [&](const auto& pair) { return pair.first.has_prefix(prim); }) > 0;
  for (auto& [source, target] : relocates.pairs) {
    if (!target.empty() && target.has_prefix(prim)) {
      target = Path();
      changed = true;
    }
  }
  if (changed) {
    relocates.pairs.empty()
        ? editor.erase(root, fields::layerRelocates)
        : editor.set(root, fields::layerRelocates, layer::Value(std::move(relocates)));
  }
  return is_default || changed;
}

/// An arc to `arc.to`, in that file or one of the same name: where a path leads is not kept.
template <class T>
bool rename_in(T& one, const stage::Dependents::Arc& arc, Path now) {
  const auto name_of = [](const std::string& path) {
    return std::string_view(path).substr(path.find_last_of('/') + 1);
  };
  const bool leads = !one.asset_path.empty() && one.prim_path == arc.to &&
                     name_of(one.asset_path) == name_of(arc.file);
  if (leads) {
    one.prim_path = now;
  }
  return leads;
}

template <class T>
bool rename_in_list(edit::LayerEditor& editor, Path spec, Token field,
                    const stage::Dependents::Arc& arc, Path now) {
  auto op = editor.get_or(spec, field, layer::ListOp<T>{});
  bool changed = false;
  for (std::vector<T>* list : all_lists(op)) {
    for (T& one : *list) {
      changed = rename_in(one, arc, now) || changed;
    }
  }
  if (changed) {
    editor.set(spec, field, layer::Value(std::move(op)));
  }
  return changed;
}

/// A property that was there for its targets and has none now, and no metadata either.
bool is_done(const edit::LayerEditor& editor, Path property) {
  const layer::Spec* spec = editor.layer().find(property);
  if (spec == nullptr || spec->kind != layer::SpecKind::Relationship) {
    return false;
  }
  const auto is_of_declaration = [](const layer::Field& field) {
    return field.name == fields::custom || field.name == fields::variability;
  };
  const auto& all = spec->fields();
  return std::all_of(all.begin(), all.end(), is_of_declaration);
}

/// Looks which of some prims paths are at or below.
class Mentions {
 public:
  explicit Mentions(const std::set<Path>& prims) : prims_(prims) {}

  void note(Path path) {
    for (Path at = path; !at.empty() && !at.is_absolute_root(); at = at.parent()) {
      if (prims_.contains(at)) {
        found_.insert(at);
      }
    }
  }

  void note_value(Path spec, const layer::Value& value) {
    note_list<Path>(value);
    layer::Value copy = value;
    layer::map_paths(copy, spec.prim(), [this](Path path) {
      note(path);
      return path;
    });
    note_list<layer::Reference>(value);
    note_list<layer::Payload>(value);
    if (const auto* relocates = value.get<layer::Relocates>()) {
      for (const auto& [source, target] : relocates->pairs) {
        note(source);
        note(target);
      }
    }
  }

  const std::set<Path>& found() const { return found_; }

 private:
  void note_item(Path path) { note(path); }
  template <class Arc>
  void note_item(const Arc& arc) {
    note(arc.asset_path.empty() ? arc.prim_path : Path());
  }

  template <class T>
  void note_list(const layer::Value& value) {
    if (const auto* op = value.get<layer::ListOp<T>>()) {
      layer::ListOp<T> copy = *op;
      for (const std::vector<T>* list : all_lists(copy)) {
        for (const T& item : *list) {
          note_item(item);
        }
      }
    }
  }

  const std::set<Path>& prims_;
  std::set<Path> found_;
};

}  // namespace

std::set<Path> mentioned_prims(const layer::Layer& layer, const std::set<Path>& prims) {
  Mentions mentions(prims);
  mentions.note(edit::default_prim_path(layer.default_prim()));
  for (const layer::Layer::Entry& entry : layer.entries()) {
    mentions.note(entry.path.strip_variants());
    for (const layer::Field& field : entry.spec.fields()) {
      mentions.note_value(entry.path, field.value);
    }
  }
  return mentions.found();
}

Result<std::vector<Path>> remove_prim_specs(edit::LayerEditor& editor, Path prim) {
  TENON_CHECK(check_no_arc_leads_to(editor.layer(), prim));
  std::vector<Path> changed = specs_of(editor.layer(), prim, &Path::is_prim);
  for (const Path spec : changed) {
    TENON_CHECK(editor.remove_prim(spec));
  }
  if (drop_from_layer(editor, prim)) {
    changed.push_back(Path::absolute_root());
  }
  std::vector<Path> properties;
  for (const layer::Layer::Entry& entry : editor.layer().entries()) {
    if (entry.path.kind() == PathKind::Property) {
      properties.push_back(entry.path);
    }
  }
  for (const Path property : properties) {
    const bool targets = drop_from(editor, property, fields::targetPaths, prim);
    const bool connections = drop_from(editor, property, fields::connectionPaths, prim);
    const bool expressions = drop_from_expressions(editor, property, prim);
    if (targets || connections || expressions) {
      changed.push_back(property);
    }
    if (targets && is_done(editor, property)) {
      TENON_CHECK(editor.remove_property(property));
    }
  }
  return changed;
}

Result<std::vector<Path>> rename_prim_specs(edit::LayerEditor& editor, const std::set<Path>& prims,
                                            Token name) {
  std::vector<Path> specs;
  for (const layer::Layer::Entry& entry : editor.layer().entries()) {
    if (entry.path.is_prim() && prims.contains(entry.path.strip_variants())) {
      specs.push_back(entry.path);
    }
  }
  // What is below another one comes first.
  std::stable_sort(specs.begin(), specs.end(),
                   [](Path a, Path b) { return a.depth() > b.depth(); });
  std::vector<Path> changed;
  for (const Path spec : specs) {
    const Path moved = spec.parent().child(name);
    TENON_CHECK(editor.move_prim(spec, moved));
    changed.push_back(moved);
  }
  std::map<Path, Path> moves;
  for (const Path prim : prims) {
    moves.emplace(prim, prim.parent().child(name));
  }
  editor.retarget(moves);
  return changed;
}

std::vector<Path> rename_in_asset_arcs(edit::LayerEditor& editor, const stage::Dependents::Arc& arc,
                                       Token name) {
  const Path now = arc.to.replace_prefix(arc.prim, arc.prim.parent().child(name));
  std::vector<Path> changed;
  for (const Path spec : specs_of(editor.layer(), arc.from, &Path::is_prim_or_variant)) {
    const bool references =
        rename_in_list<layer::Reference>(editor, spec, fields::references, arc, now);
    const bool payloads = rename_in_list<layer::Payload>(editor, spec, fields::payload, arc, now);
    if (references || payloads) {
      changed.push_back(spec);
    }
  }
  return changed;
}

Result<std::vector<Path>> rename_property_specs(edit::LayerEditor& editor,
                                                const std::set<Path>& prims, Token name,
                                                Token now) {
  std::vector<Path> specs;  // those in variants, too
  for (const layer::Layer::Entry& entry : editor.layer().entries()) {
    if (entry.path.is_property() && entry.path.name() == name &&
        prims.contains(entry.path.parent().strip_variants())) {
      specs.push_back(entry.path);
    }
  }
  std::vector<Path> changed;
  for (const Path spec : specs) {
    TENON_CHECK(editor.rename_property(spec, now));
    changed.push_back(spec.parent().property(now));
  }
  std::map<Path, Path> moves;
  for (const Path prim : prims) {
    moves.emplace(prim.property(name), prim.property(now));
  }
  editor.retarget(moves);
  return changed;
}

Result<std::vector<Path>> remove_variant_specs(edit::LayerEditor& editor, Path prim,
                                               const std::string& set, const std::string& variant) {
  std::vector<Path> changed;
  for (const Path spec : specs_of(editor.layer(), prim, &Path::is_prim)) {
    const Path place = spec.variant_selection(Token(set), Token(variant));
    if (!editor.layer().has(place)) {
      continue;
    }
    TENON_CHECK(editor.remove_prim(place));
    changed.push_back(spec);
    const Path of_set = spec.variant_selection(Token(set), Token());
    if (editor.layer().children(of_set, fields::variantChildren).empty()) {
      TENON_CHECK(editor.remove_prim(of_set));
      editor.edit_list(spec, fields::variantSetNames, edit::ListEdit<std::string>::withdraw(set));
      editor.clear_selection(spec, set);
    }
  }
  return changed;
}

}  // namespace tenon
