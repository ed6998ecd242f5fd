// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/editing/edit_refusals.h"

#include <utility>

#include "tenon/asset/edit_file_choice.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/property_value.h"

namespace tenon {

using Kind = AssetEdit::Kind;

Error no_prim_in_any_variant(Path prim) {
  return Error(ErrorCode::NotFound, "there is no prim <" + prim.str() + ">, in no variant")
      .with_prim(prim.str())
      .with_rule("edit.no-prim")
      .with_fix("tenon tree lists all prims");
}

Result<void> check_in_no_package(const std::string& identifier) {
  if (!bytes::is_in_package(identifier)) {
    return {};
  }
  return Error(ErrorCode::Unsupported, "files in a package cannot be edited in place")
      .in_file(identifier)
      .with_rule("edit.in-package")
      .with_fix("tenon zip PACKAGE --extract FOLDER unpacks it");
}

Result<void> check_object(const AssetEdit& edit) {
  const Path path = edit.object;
  const bool of_prim = edit.is_about_api() || edit.is_about_prim();
  const bool of_stage = edit.kind == Kind::SetStageMetadata;
  const bool fits = of_stage  ? path.is_absolute_root()
                    : of_prim ? path.is_prim()
                              : path.kind() == PathKind::Property;
  if (fits && path.is_absolute() && !path.has_variants()) {
    return {};
  }
  return not_a_path(path.str(), of_prim ? "prim" : "property");
}

Error already_there(const stage::Prim& prim) {
  const std::string type = prim.type_name().empty() ? "without a type" : prim.type_name().str();
  return Error(ErrorCode::Invalid, "<" + prim.path().str() + "> is there already, a prim " +
                                       (prim.type_name().empty() ? type : "of type " + type))
      .with_prim(prim.path().str())
      .with_rule("edit.prim-exists")
      .with_fix("choose another path, or remove it first: tenon remove ASSET " + prim.path().str());
}

Error used_by_arc(Path from, Path prim) {
  return Error(ErrorCode::Invalid, named(from) + " is made of <" + prim.str() + "> by an arc")
      .with_prim(prim.str())
      .with_rule("edit.in-use")
      .with_fix("remove that prim first, or let its arc lead elsewhere");
}

Error hidden(const stage::Stage& stage, const std::string& shown, const AssetEdit& edit,
             const std::string& file) {
  const Token property = edit.object.is_property() ? edit.object.name() : Token();
  const auto sources = stage::opinion_sources(stage, edit.object.prim(), property);
  const stage::OpinionSource* stronger = nullptr;
  for (const auto& source : sources) {
    if (source.layer->identifier() == file) {
      break;
    }
    if (speaks(source, edit)) {
      stronger = &source;
      break;
    }
    // Where no layer has the same field, the strongest with any is the best guess.
    if (stronger == nullptr && source.spec->fields().size() > 0) {
      stronger = &source;
    }
  }
  const std::string where = shown.empty() ? "" : " under Physics=" + shown;
  Error error(ErrorCode::Invalid, "what " + file_part(file) + " says about <" + edit.object.str() +
                                      "> does not count" + where + ": a stronger opinion hides it");
  const std::uint32_t line = stronger == nullptr ? 0 : stronger->spec->line;
  const std::string place = stronger == nullptr ? "another layer" : stronger->layer->identifier();
  return std::move(std::move(error).in_file(place).at(line, line == 0 ? 0 : 1))
      .with_prim(edit.object.prim().str())
      .with_rule("edit.hidden")
      .with_fix("edit that file, with --in or --engine, or clear the value there");
}

Result<edit::EditTarget> target_of(edit::StageEditor& editor, const stage::LayerSite& site,
                                   const std::string& layer, const AssetEdit& edit) {
  edit::EditTarget target = edit::site_target(site, layer);
  if (!edit.inside) {
    return target;
  }
  const auto& [prim, set, variant] = *edit.inside;
  if (!edit.object.prim().has_prefix(prim) || edit.is_about_specs() || site.path != prim) {
    return Error(ErrorCode::Invalid,
                 edit.is_about_specs()
                     ? "this edit is of all files at once, not of one variant"
                     : "<" + edit.object.str() + "> has no place in a variant of " + named(prim))
        .with_prim(edit.object.prim().str())
        .with_rule("edit.outside-target")
        .with_fix("make it outside of the variant");
  }
  TENON_CHECK(editor.set_target(std::move(target)));
  return editor.variant_target(prim, set, variant);
}

Error with_file_fix(Error error) {
  const std::string& rule = error.diagnostic().rule;
  if (rule == "edit.no-spec") {
    return std::move(error).with_fix("tenon where names the files that do");
  }
  return rule == "edit.outside-target" ? std::move(error).with_fix("name another file with --in")
                                       : std::move(error);
}

}  // namespace tenon
