// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Typed edits of masses and drives look at the composed scene, with the first variant of "Physics"
// that has physics; the others are made of the text alone.
#include "tenon/asset/edit_request.h"

#include <algorithm>
#include <functional>

#include "tenon/asset/editing/engine_forms.h"
#include "tenon/asset/editing/stage_metadata.h"
#include "tenon/asset/typed_edits.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/open_stage.h"
#include "tenon/physics/read_physics.h"
#include "tenon/property_value.h"
#include "tenon/structure/layout.h"

namespace tenon {
namespace {

/// Whether it suits the edit is checked with the edit.
Result<Path> read_path(const std::string& text, const std::string& kind) {
  auto path = Path::parse(text);
  if (path && path->is_absolute()) {
    return path;
  }
  return not_a_path(text, kind);
}

Result<AssetEdit> assigned(const std::string& text, const std::string& type) {
  AssetEdit edit;
  TENON_TRY(const PropertyAssignment parts, read_assignment(text));
  edit.kind = parts.kind == AssignmentKind::Add      ? AssetEdit::Kind::AddTargets
              : parts.kind == AssignmentKind::Remove ? AssetEdit::Kind::RemoveTargets
                                                     : AssetEdit::Kind::SetProperty;
  edit.object = parts.property;
  edit.value = parts.value;
  edit.type_name = Token(type);
  return edit;
}

Result<AssetEdit> api_edit(const std::string& text, AssetEdit::Kind kind) {
  const auto parts = split_assignment(text);
  if (!parts) {
    return Error(parts.error()).with_fix("write PRIM=SCHEMA, as in /hand/palm=PhysicsMassAPI");
  }
  AssetEdit edit;
  edit.kind = kind;
  TENON_TRY(edit.object, read_path(parts->first, "prim"));
  edit.api = Token(parts->second);
  return edit;
}

/// The typed edits look at joints and units: at the scene with physics, whichever variant has it.
Result<stage::Stage> scene_with_physics(const std::string& asset, OpenOptions open) {
  Diagnostics ignored;  // the edit composes again and reports
  TENON_TRY(stage::Stage stage, tenon::open(asset, open, ignored));
  const stage::Prim root = stage.default_prim();
  if (!root || !open.physics_variant.empty()) {
    return stage;
  }
  const std::string set(structure::kPhysicsSet);
  const auto names = root.variant_names(set);
  const auto known = structure::known_physics_variants();
  const auto found = std::find_if(known.rbegin(), known.rend(), [&](std::string_view variant) {
    return std::find(names.begin(), names.end(), variant) != names.end();
  });
  if (found == known.rend()) {
    return stage;
  }
  open.physics_variant = *found;
  return tenon::open(asset, open, ignored);
}

using ReadEdits = std::function<Result<std::vector<AssetEdit>>(const std::string&)>;

/// What one argument asks for is one wish.
Result<void> add_typed(const std::vector<std::string>& texts, const ReadEdits& read,
                       std::vector<AssetEdit>& edits) {
  for (const std::string& text : texts) {
    TENON_TRY(std::vector<AssetEdit> more, read(text));
    const std::size_t wish = edits.size();
    for (AssetEdit& edit : more) {
      edit.wish = wish;
      edits.push_back(std::move(edit));
    }
  }
  return {};
}

Result<void> add_filters(const std::string& asset, const EditRequest& request,
                         const EditOptions& options, std::vector<AssetEdit>& edits) {
  if (request.filter.empty() && !request.filter_overlaps) {
    return {};
  }
  TENON_TRY(const stage::Stage stage, scene_with_physics(asset, options.open));
  Diagnostics ignored;  // the edit reads it again and reports
  const scene::PhysicsScene scene = physics::read_physics(stage, {}, ignored);
  TENON_CHECK(add_typed(
      request.filter, [&](const std::string& text) { return filter_edits(stage, scene, text); },
      edits));
  if (request.filter_overlaps) {
    for (AssetEdit& edit : overlap_edits(stage, scene)) {
      edits.push_back(std::move(edit));
    }
  }
  return {};
}

Result<void> add_typed(const std::string& asset, const EditRequest& request,
                       const EditOptions& options, std::vector<AssetEdit>& edits) {
  TENON_CHECK(add_typed(request.collider, collider_edits, edits));
  TENON_CHECK(add_typed(request.material, material_edits, edits));
  TENON_CHECK(add_filters(asset, request, options, edits));
  TENON_CHECK(add_typed(
      request.mimic, [&](const std::string& text) { return mimic_edits(text, options.engine); },
      edits));
  if (request.mass.empty() && request.drive.empty()) {
    return {};
  }
  TENON_TRY(const stage::Stage stage, scene_with_physics(asset, options.open));
  TENON_CHECK(add_typed(
      request.mass, [&](const std::string& text) { return mass_edits(stage, text); }, edits));
  return add_typed(
      request.drive, [&](const std::string& text) { return drive_edits(stage, text); }, edits);
}

}  // namespace

Result<std::vector<AssetEdit>> read_edits(const std::string& asset, const EditRequest& request,
                                          const EditOptions& options) {
  if (!request.layer.empty() && !options.layer.empty()) {
    return Error(ErrorCode::Invalid, "--layer sets metadata of the file that is named first")
        .with_rule("edit.bad-argument")
        .with_fix("leave --in out, or name that file: tenon set " + shell_word(options.layer) +
                  " --layer " + shell_word(request.layer.front()));
  }
  TENON_TRY(std::vector<AssetEdit> edits, stage_metadata_edits(request.layer));
  for (const std::string& text : request.remove) {
    TENON_TRY(AssetEdit edit, api_edit(text, AssetEdit::Kind::RemoveApi));
    edits.push_back(std::move(edit));
  }
  for (const std::string& text : request.apply) {
    TENON_TRY(AssetEdit edit, api_edit(text, AssetEdit::Kind::ApplyApi));
    edits.push_back(std::move(edit));
  }
  TENON_CHECK(add_typed(asset, request, options, edits));
  for (const std::string& text : request.assignments) {
    TENON_TRY(AssetEdit edit, assigned(text, request.type));
    edits.push_back(std::move(edit));
  }
  for (const std::string& text : request.clear) {
    AssetEdit edit;
    edit.kind = AssetEdit::Kind::ClearProperty;
    TENON_TRY(edit.object, read_path(text, "property"));
    edits.push_back(std::move(edit));
  }
  if (edits.empty() && options.engine.empty() && !request.filter_overlaps) {
    return Error(ErrorCode::Invalid, "nothing to set").with_fix("name a property: PATH.attr=VALUE");
  }
  if (request.all_engines) {
    return with_engine_forms(asset, std::move(edits), options);
  }
  return edits;
}

}  // namespace tenon
