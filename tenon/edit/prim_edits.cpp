// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Prims: where their specs go, and what makes, moves and removes them.

#include "tenon/edit/composed_view.h"
#include "tenon/edit/edit_errors.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/composed_type.h"

namespace tenon::edit {

using layer::Specifier;
using layer::Value;
namespace fields = layer::fields;

namespace {

Result<void> check_prim_path(Path prim) {
  if (!prim.is_absolute() || !prim.is_prim_or_root() || prim.has_variants()) {
    return bad_path(prim, "the path of a prim");
  }
  return {};
}

Error hidden(Path prim) {
  return Error(ErrorCode::Invalid, "<" + prim.str() +
                                       "> would not be defined: it is below an inactive prim, or "
                                       "the edit target does not contribute to it")
      .with_prim(prim.str())
      .with_rule("edit.hidden")
      .with_fix("activate the prims above it, or choose another edit target");
}

Result<void> check_comes_over_no_arc(const FoundPrim& found, Path prim) {
  for (const compose::Node& node : found.index->nodes()) {
    if (node.due_to_ancestor && node.has_opinions()) {
      const std::string& layer = node.layer_stack->identifier();
      Message message = "<" + prim.str() + "> comes over an arc of a prim above it, with <" +
                        node.path.str() + "> of " + layer;
      message.about(node.path, RelatedRole::Prim, layer);
      return Error(ErrorCode::Invalid, message)
          .with_prim(prim.str())
          .with_rule("edit.bad-move")
          .with_fix("author a relocate, or move the prim where the arc leads");
    }
  }
  return {};
}

/// An over without anything in it.
bool says_nothing(const layer::Layer& layer, Path prim) {
  const layer::Spec* spec = layer.find(prim);
  if (spec == nullptr || spec->get_or(fields::specifier, Specifier::Over) != Specifier::Over) {
    return false;
  }
  const layer::FieldList list = spec->field_list();
  return std::all_of(list.items().begin(), list.items().end(), [](const layer::Field& field) {
    const auto* names = field.value.get<std::vector<Token>>();
    return field.name == fields::specifier || (names != nullptr && names->empty());
  });
}

}  // namespace

Result<FoundPrim> StageEditor::find_prim(Path prim) {
  TENON_CHECK(check_prim_path(prim));
  const FoundPrim found = view().prim(prim);
  if (!found) {
    return no_prim(prim);
  }
  return found;
}

/// Opinions of the local stack have no effect inside instances.
Result<void> StageEditor::check_editable(Path prim) {
  const bool local = [&] {
    for (const compose::StackedLayer& stacked : view().layer_stack().layers) {
      if (stacked.layer->identifier() == target_.layer) {
        return true;
      }
    }
    return false;
  }();
  if (!local || target_.spec_path(prim) != prim) {
    return {};
  }
  // The prim may not be there yet: its nearest ancestor decides.
  for (Path at = prim; !at.empty(); at = at.parent()) {
    if (const FoundPrim found = view().prim(at)) {
      const bool inside = found.below_instance || (at != prim && found.index->instanceable);
      return inside ? Result<void>(instance_proxy(prim)) : Result<void>();
    }
  }
  return {};
}

Result<Path> StageEditor::place(Path scene_path) const {
  const Path path = target_.spec_path(scene_path);
  if (path.empty()) {
    return outside_target(scene_path, target_.layer);
  }
  return path;
}

Result<void> StageEditor::edit_prim(Path prim,
                                    const Function<Result<void>(LayerEditor&, Path)>& work) {
  TENON_CHECK(find_prim(prim));
  TENON_CHECK(check_editable(prim));
  TENON_TRY(const Path path, place(prim));
  return edit([&](LayerEditor& editor) -> Result<void> {
    TENON_CHECK(editor.create_prim(path));
    return work(editor, path);
  });
}

/// One ancestor of a prim to define.
Result<void> StageEditor::define_step(Path prim, Token type_name) {
  const FoundPrim found = view().prim(prim);
  if (found && found.defined &&
      (type_name.empty() || stage::composed_type_name(*found.index) == type_name)) {
    return {};
  }
  TENON_CHECK(check_editable(prim));
  TENON_TRY(const Path path, place(prim));
  const auto author = [&](LayerEditor& editor) -> Result<void> {
    TENON_CHECK(editor.create_prim(path));
    editor.set(path, fields::specifier, Specifier::Def);
    if (!type_name.empty()) {
      editor.set(path, fields::typeName, type_name);
    }
    return {};
  };
  TENON_CHECK(edit(author));
  const FoundPrim made = view().prim(prim);
  return made && made.defined ? Result<void>() : Result<void>(hidden(prim));
}

Result<void> StageEditor::define_prim(Path prim, Token type_name) {
  TENON_CHECK(check_prim_path(prim));
  TENON_CHECK(check_editable(prim));
  return as_one_step([&]() -> Result<void> {
    for (const Path at : prim.prefixes()) {
      if (!at.is_absolute_root()) {
        TENON_CHECK(define_step(at, at == prim ? type_name : Token()));
      }
    }
    return {};
  });
}

Result<void> StageEditor::override_prim(Path prim) {
  TENON_CHECK(check_prim_path(prim));
  TENON_CHECK(check_editable(prim));
  if (view().prim(prim)) {
    return {};
  }
  TENON_TRY(const Path path, place(prim));
  return as_one_step([&]() -> Result<void> {
    TENON_CHECK(edit([&](LayerEditor& editor) { return editor.create_prim(path); }));
    return view().prim(prim) ? Result<void>() : Result<void>(hidden(prim));
  });
}

Result<void> StageEditor::create_class(Path prim) {
  TENON_CHECK(check_prim_path(prim));
  TENON_CHECK(check_editable(prim));
  const FoundPrim found = view().prim(prim);
  if (found && found.defined && stage::composed_specifier(*found.index) != Specifier::Class) {
    return wrong_kind(prim, "a prim that is not a class already");
  }
  if (found && found.abstract) {
    return {};
  }
  return as_one_step([&]() -> Result<void> {
    TENON_CHECK(define_prim(prim));
    return edit_prim(prim, [](LayerEditor& editor, Path path) -> Result<void> {
      editor.set(path, fields::specifier, Specifier::Class);
      return {};
    });
  });
}

Result<void> StageEditor::remove_prim(Path prim) {
  TENON_CHECK(check_prim_path(prim));
  TENON_TRY(const Path path, place(prim));
  if (!path.is_prim()) {
    return Error(ErrorCode::Invalid, "<" + path.str() + "> is the edit target itself")
        .with_prim(prim.str())
        .with_rule("edit.bad-path")
        .with_fix("remove it through an edit target above it");
  }
  return edit([&](LayerEditor& editor) { return editor.remove_prim(path); });
}

Result<void> StageEditor::remove_silent_prim(Path prim) {
  TENON_TRY(const Path path, place(prim));
  return edit([&](LayerEditor& editor) -> Result<void> {
    for (Path at = path; at.is_prim() && says_nothing(editor.layer(), at); at = at.parent()) {
      TENON_CHECK(editor.remove_prim(at));
    }
    return {};
  });
}

Result<void> StageEditor::move_prim(Path from, Path to) {
  TENON_TRY(const FoundPrim found, find_prim(from));
  TENON_CHECK(check_prim_path(to));
  TENON_CHECK(check_comes_over_no_arc(found, from));
  if (view().prim(to) || !view().prim(to.parent())) {
    return Error(ErrorCode::Invalid, view().prim(to) ? named(to) + " is there already"
                                                     : "there is no " + named(to.parent()))
        .with_prim(from.str())
        .with_rule("edit.bad-move")
        .with_fix("choose another path");
  }
  std::vector<std::string> layers;
  for (const compose::StackedLayer& stacked : view().layer_stack().layers) {
    layers.push_back(stacked.layer->identifier());
  }
  TENON_CHECK(check_editable(from));
  TENON_CHECK(check_editable(to));
  const auto move = [&](LayerEditor& editor) -> Result<void> {
    if (editor.layer().has(from)) {
      TENON_CHECK(editor.create_prim(to.parent()));
      TENON_CHECK(editor.move_prim(from, to));
    }
    editor.retarget(from, to);
    return {};
  };
  return as_one_step([&]() -> Result<void> {
    for (const std::string& identifier : layers) {
      TENON_CHECK(edit_layer(identifier, move));
    }
    return {};
  });
}

Result<void> StageEditor::set_type_name(Path prim, Token type_name) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.set(path, fields::typeName, type_name);
    return {};
  });
}

Result<void> StageEditor::reorder_children(Path prim, std::vector<Token> names) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.set(path, fields::primOrder, Value(std::move(names)));
    return {};
  });
}

Result<void> StageEditor::reorder_properties(Path prim, std::vector<Token> names) {
  return edit_prim(prim, [&](LayerEditor& editor, Path path) -> Result<void> {
    editor.set(path, fields::propertyOrder, Value(std::move(names)));
    return {};
  });
}

Result<void> StageEditor::set_active(Path prim, bool active) {
  return set_metadata(prim, fields::active, Value(active));
}

Result<void> StageEditor::set_instanceable(Path prim, bool instanceable) {
  return set_metadata(prim, fields::instanceable, Value(instanceable));
}

Result<void> StageEditor::set_kind(Path prim, Token kind) {
  return set_metadata(prim, fields::kind, Value(kind));
}

}  // namespace tenon::edit
