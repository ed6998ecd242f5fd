// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/updating/updated_json.h"

#include "tenon/answers/opinions.h"
#include "tenon/answers/or_null.h"
#include "tenon/base/text/shown_path.h"

namespace tenon {
namespace {

using answers::Json;
using answers::or_null;
using diff::MergeConflict;

const char* kind_name(MergeConflict::Kind kind) {
  return kind == MergeConflict::Kind::Values            ? "values"
         : kind == MergeConflict::Kind::RemovedBySource ? "removedBySource"
                                                        : "removedByEdit";
}

Json shown_value(const layer::Value& value) {
  return value.empty() ? Json(nullptr) : Json(answers::short_value_text(value));
}

Json conflict_json(const UpdateConflict& conflict, diff::Side keep) {
  const MergeConflict& what = conflict.what;
  return {{"file", conflict.file},
          {"kind", kind_name(what.kind)},
          {"prim", or_null(what.path.empty() ? std::string() : what.path.prim_or_variant().str())},
          {"property", or_null(what.path.is_property() ? what.path.name().str() : std::string())},
          {"field", or_null(what.field.str())},
          {"key", or_null(what.key)},
          {"base", shown_value(what.base)},
          {"edit", shown_value(what.edited)},
          {"source", shown_value(what.source)},
          {"kept", keep == diff::Side::Edits ? "edit" : "source"}};
}

}  // namespace

Json updated_json(const UpdatedAsset& asset, diff::Side keep) {
  Json files = Json::array();
  for (const EditedFile& file : asset.files) {
    files.push_back({{"file", shown_path(file.path)}, {"removed", file.removed}});
  }
  Json moved = Json::array();
  for (const auto& [from, to] : asset.moved) {
    moved.push_back({{"from", from.str()}, {"to", to.str()}});
  }
  Json conflicts = Json::array();
  for (const UpdateConflict& conflict : asset.conflicts) {
    conflicts.push_back(conflict_json(conflict, keep));
  }
  return {{"files", std::move(files)},
          {"edits", asset.edits},
          {"changes", asset.changes},
          {"moved", std::move(moved)},
          {"conflicts", std::move(conflicts)}};
}

answers::Json with_updated(answers::Json answer, const UpdatedAsset& asset, diff::Side keep) {
  answer["updated"] = updated_json(asset, keep);
  return answer;
}

}  // namespace tenon
