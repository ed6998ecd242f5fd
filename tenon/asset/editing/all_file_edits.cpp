// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every file that may define a prim has it at one path (prim_sites.h), so that its specs are edited
// layer by layer, whichever variants are selected; the scenes are composed afterwards and show
// whether another file, which is not the asset's own, still has it.
#include "tenon/asset/editing/all_file_edits.h"

#include <algorithm>
#include <utility>

#include "tenon/asset/editing/dependent_edits.h"
#include "tenon/asset/editing/path_texts.h"
#include "tenon/asset/editing/prim_sites.h"
#include "tenon/asset/editing/spec_edits.h"
#include "tenon/asset/editing/stage_metadata.h"
#include "tenon/layer/fields.h"

namespace tenon {
namespace {

using Kind = AssetEdit::Kind;

Result<std::vector<Path>> rename_with_texts(edit::LayerEditor& editor, Path site, Token name) {
  TENON_TRY(std::vector<Path> changed, rename_prim_specs(editor, {site}, name));
  for (const Path spec :
       follow_in_texts(editor, PrimMoves{std::pair(site, site.parent().child(name))})) {
    changed.push_back(spec);
  }
  return changed;
}

Result<std::vector<Path>> edit_specs(edit::LayerEditor& editor, Path site, const AssetEdit& edit) {
  switch (edit.kind) {
    case Kind::RemovePrim:
      return remove_prim_specs(editor, site);
    case Kind::RenamePrim:
      return rename_with_texts(editor, site, Token(edit.value));
    case Kind::RenameProperty:
      return rename_property_specs(editor, {site}, edit.object.name(), Token(edit.value));
    default:
      break;
  }
  const std::size_t equals = edit.value.find('=');
  return remove_variant_specs(editor, site, edit.value.substr(0, equals),
                              edit.value.substr(equals + 1));
}

Error nothing_to_edit(const AssetEdit& edit) {
  const std::string what =
      edit.kind == Kind::RemoveVariant ? "has the variant " + edit.value : "says anything about it";
  return Error(ErrorCode::NotFound,
               "no file of the asset's own " + what + ": <" + edit.object.str() + ">")
      .with_prim(edit.object.str())
      .with_rule("edit.no-spec")
      .with_fix("tenon where names the files that do");
}

bool is_renaming(const AssetEdit& edit) {
  return edit.kind == Kind::RenamePrim || edit.kind == Kind::RenameProperty;
}

/// The same of a property; that schemas declare it does not count.
Result<void> check_new_property(const AllFiles& files, const AssetEdit& edit) {
  const Path prim = edit.object.prim();
  if (!is_namespaced_identifier(edit.value)) {
    return Error(ErrorCode::Invalid, "\"" + edit.value + "\" is no name of a property")
        .with_prim(prim.str())
        .with_rule("edit.bad-name")
        .with_fix("use identifiers joined by ':', as in physics:mass");
  }
  for (const auto& stage : files.stages) {
    const stage::Prim found = stage->prim(prim);
    if (found && !found.attribute(Token(edit.value)).spec_stack().empty()) {
      return Error(ErrorCode::Invalid,
                   "<" + prim.property(Token(edit.value)).str() + "> is there already")
          .with_prim(prim.str())
          .with_rule("edit.property-exists")
          .with_fix("choose another name, or remove it first: tenon set ASSET --clear " +
                    prim.property(Token(edit.value)).str());
    }
  }
  return {};
}

/// A name that is free under every selection.
Result<void> check_new_name(const AllFiles& files, const AssetEdit& edit) {
  if (edit.kind == Kind::RenameProperty) {
    return check_new_property(files, edit);
  }
  if (!is_identifier(edit.value)) {
    return Error(ErrorCode::Invalid, "\"" + edit.value + "\" is not a prim name")
        .with_prim(edit.object.str())
        .with_rule("edit.bad-name")
        .with_fix("use letters, digits and '_', no digit in front");
  }
  const Path to = edit.object.parent().child(Token(edit.value));
  for (const auto& stage : files.stages) {
    if (stage->prim(to)) {
      return Error(ErrorCode::Invalid, named(to) + " is there already")
          .with_prim(edit.object.str())
          .with_rule("edit.prim-exists")
          .with_fix("choose another name");
    }
  }
  return {};
}

std::string type_of(const AllFiles& files, Path prim) {
  for (const auto& stage : files.stages) {
    if (const stage::Prim found = stage->prim(prim)) {
      return found.type_name().empty() ? "prim" : found.type_name().str();
    }
  }
  return {};
}

EditedPlace place_of(const AllFiles& files, const AssetEdit& edit, const std::string& file,
                     Path spec) {
  EditedPlace place;
  place.file = file;
  place.spec = spec;
  const bool of_target = (spec.is_property() && edit.kind != Kind::RenameProperty) ||
                         spec.is_absolute_root();  // the default prim
  const bool removes = edit.kind == Kind::RemovePrim;
  if (!of_target) {
    place.before = removes                            ? type_of(files, edit.object)
                   : edit.kind == Kind::RemoveVariant ? edit.value
                                                      : edit.object.name().str();
    place.after = is_renaming(edit) ? edit.value : "";
  }
  place.why = of_target ? "it named what is gone" : "defined in this file";
  if (removes && !of_target) {
    place.spec = spec.parent();  // what is there to be shown
  }
  return place;
}

/// In the files that define the prim.
Result<std::vector<EditedPlace>> edit_own(const AllFiles& files, const PrimSites& sites,
                                          const AssetEdit& edit) {
  std::vector<EditedPlace> places;
  for (const auto& [layer, site] : sites) {
    edit::StageEditor* editor = files.editor_of(layer);
    if (editor == nullptr) {
      continue;
    }
    TENON_CHECK(editor->edit_layer(
        layer, [&, at = site, &file = layer](edit::LayerEditor& specs) -> Result<void> {
          TENON_TRY(const std::vector<Path> changed, edit_specs(specs, at, edit));
          for (const Path spec : changed) {
            places.push_back(place_of(files, edit, file, spec));
          }
          return {};
        }));
  }
  return places.empty() ? Result<std::vector<EditedPlace>>(nothing_to_edit(edit))
                        : Result<std::vector<EditedPlace>>(std::move(places));
}

}  // namespace

Result<EditedSpecs> edit_in_all_files(const AllFiles& files, const AssetEdit& edit) {
  EditedSpecs edited;
  if (edit.kind == Kind::SetStageMetadata) {
    TENON_TRY(EditedPlace place, set_stage_metadata(files, edit, files.diagnostics));
    edited.places.push_back(std::move(place));
    return edited;
  }
  if (is_renaming(edit)) {
    TENON_CHECK(check_new_name(files, edit));
  }
  TENON_TRY(const PrimSites sites, own_sites(files.stages, files.roles, edit.object.prim()));
  TENON_TRY(const stage::Dependents dependents, dependents_in(files, sites, edit));
  TENON_TRY(edited.places, edit_own(files, sites, edit));
  TENON_TRY(EditedSpecs more, edit_dependents(files, dependents, edit));
  edited.places.insert(edited.places.end(), more.places.begin(), more.places.end());
  edited.dependents = std::move(more.dependents);
  return edited;
}

Result<std::string> file_that_goes(const AllFiles& files, const AssetEdit& edit) {
  const std::string set = std::string(structure::kPhysicsSet) + "=";
  const bool of_engine = edit.kind == Kind::RemoveVariant && edit.value.starts_with(set);
  const structure::Role role =
      of_engine ? structure::role_of_physics_variant(edit.value.substr(set.size()))
                : structure::Role::Other;
  if (!structure::is_engine(role) || role == structure::Role::Engine) {
    return std::string();
  }
  for (const auto& [file, has] : files.roles) {
    edit::StageEditor* editor = has == role ? files.editor_of(file) : nullptr;
    const layer::LayerPtr layer = editor == nullptr ? nullptr : editor->layer(file);
    if (layer == nullptr) {
      continue;
    }
    if (!layer->children(Path::absolute_root(), layer::fields::primChildren).empty()) {
      return Error(ErrorCode::Invalid, "the file of the variant " + edit.value + " says something")
          .in_file(file)
          .with_rule("edit.in-use")
          .with_fix("remove that first, or take the variant alone: tenon remove ASSET " +
                    edit.object.str() + "=variant --variant " + edit.value);
    }
    return file;
  }
  return std::string();
}

namespace {

/// The prim or property that the edit is about, with an opinion.
bool is_there(const stage::Stage& stage, const AssetEdit& edit) {
  const stage::Prim prim = stage.prim(edit.object.prim());
  return prim && (edit.kind != Kind::RenameProperty ||
                  !prim.attribute(edit.object.name()).spec_stack().empty());
}

}  // namespace

Result<void> check_done_in_all_files(const stage::Stage& stage, const AssetEdit& edit) {
  if (edit.kind == Kind::SetStageMetadata) {
    return has_stage_metadata(stage, edit)
               ? Result<void>()
               : Error(ErrorCode::Invalid, edit.field.str() + " of the root layer does not count")
                     .with_rule("edit.hidden")
                     .with_fix("a session layer sets it: leave it out");
  }
  if (edit.kind == Kind::RemoveVariant || !is_there(stage, edit)) {
    return {};
  }
  return Error(ErrorCode::Invalid,
               "<" + edit.object.str() +
                   "> is still there: a file that is not the asset's own has it")
      .with_prim(edit.object.str())
      .with_rule("edit.hidden")
      .with_fix("tenon where names the files that define it");
}

}  // namespace tenon
