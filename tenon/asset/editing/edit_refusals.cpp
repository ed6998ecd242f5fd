// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/editing/edit_refusals.h"

#include <utility>

#include "tenon/asset/edit_value.h"
#include "tenon/bytes/asset_resolver.h"

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

Error with_file_fix(Error error) {
  const std::string& rule = error.diagnostic().rule;
  if (rule == "edit.no-spec") {
    return std::move(error).with_fix("tenon where names the files that do");
  }
  return rule == "edit.outside-target" ? std::move(error).with_fix("name another file with --in")
                                       : std::move(error);
}

}  // namespace tenon
