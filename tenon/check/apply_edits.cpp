// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/apply_edits.h"

#include <algorithm>

#include "tenon/edit/layer_editor.h"

namespace tenon::check {
namespace {

bool same_place(const SpecEdit& a, const SpecEdit& b) {
  return a.path == b.path && a.field == b.field && a.added_api == b.added_api &&
         a.removed_api == b.removed_api && a.new_name == b.new_name;
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
  if (!edit.new_name.empty()) {
    TENON_CHECK(editor.rename_property(edit.path, edit.new_name));
    editor.retarget(edit.path, edit.path.parent().property(edit.new_name));
  } else if (!edit.added_api.empty()) {
    editor.add_api(edit.path, edit.added_api);
  } else if (!edit.removed_api.empty()) {
    editor.withdraw_api(edit.path, edit.removed_api);
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
