// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/apply_edits.h"

#include <algorithm>

#include "tenon/edit/layer_editor.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::check {
namespace {

bool same_place(const SpecEdit& a, const SpecEdit& b) {
  return a.path == b.path && a.field == b.field && a.added_api == b.added_api &&
         a.removed_api == b.removed_api;
}

/// Puts a name into the list of applied schemas, or takes it out; an empty list goes.
void edit_apis(const SpecEdit& edit, edit::LayerEditor& editor) {
  namespace fields = layer::fields;
  auto op = editor.get_or(edit.path, fields::apiSchemas, layer::ListOp<Token>{});
  if (!edit.added_api.empty()) {
    (op.is_explicit ? op.explicit_items : op.prepended).push_back(edit.added_api);
  }
  for (std::vector<Token>* list :
       {&op.explicit_items, &op.prepended, &op.appended, &op.added, &op.ordered}) {
    std::erase(*list, edit.removed_api);
  }
  if (op.empty()) {
    editor.erase(edit.path, fields::apiSchemas);
  } else {
    editor.set(edit.path, fields::apiSchemas, layer::Value(std::move(op)));
  }
}

Result<void> apply_one(const SpecEdit& edit, edit::LayerEditor& editor) {
  if (!edit.type_name.empty() && !editor.layer().has(edit.path)) {
    const auto variability =
        edit.uniform ? layer::Variability::Uniform : layer::Variability::Varying;
    TENON_CHECK(editor.create_attribute(edit.path, edit.type_name, variability, false));
  }
  if (!editor.layer().has(edit.path)) {
    return Error(ErrorCode::NotFound, "there is no spec <" + edit.path.str() + "> to correct")
        .in_file(edit.layer);
  }
  if (!edit.added_api.empty() || !edit.removed_api.empty()) {
    edit_apis(edit, editor);
  } else if (edit.value.empty()) {
    editor.erase(edit.path, edit.field);
  } else {
    editor.set(edit.path, edit.field, edit.value);
  }
  return {};
}

}  // namespace

std::map<std::string, std::vector<SpecEdit>> edits_by_layer(const std::vector<Finding>& findings) {
  std::map<std::string, std::vector<SpecEdit>> layers;
  for (const Finding& finding : findings) {
    if (!finding.fix) {
      continue;
    }
    for (const SpecEdit& edit : finding.fix->edits) {
      std::vector<SpecEdit>& edits = layers[edit.layer];
      const bool known = std::any_of(edits.begin(), edits.end(),
                                     [&](const SpecEdit& e) { return same_place(e, edit); });
      if (!known) {
        edits.push_back(edit);
      }
    }
  }
  return layers;
}

Result<void> apply_edits(const std::vector<SpecEdit>& edits, layer::Layer& layer) {
  edit::LayerEditor editor(layer);
  for (const SpecEdit& edit : edits) {
    TENON_CHECK(apply_one(edit, editor));
  }
  return {};
}

}  // namespace tenon::check
