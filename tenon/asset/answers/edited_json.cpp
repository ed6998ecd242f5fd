// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/edited_json.h"

#include "tenon/answers/or_null.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/diff/unified_diff.h"

namespace tenon {
namespace {

using answers::Json;
using answers::or_null;

Json place_json(const AssetEdit& edit, const EditedPlace& place) {
  Json row = {{"object", edit.object.str()},     {"api", or_null(edit.api)},
              {"file", shown_path(place.file)},  {"line", or_null(place.line)},
              {"spec", place.spec.str()},        {"why", place.why},
              {"before", or_null(place.before)}, {"after", or_null(place.after)}};
  row["variants"] = place.variants;
  return row;
}

}  // namespace

Json text_difference_json(const std::string& name, const std::string& before,
                          const std::string& after, bool is_text) {
  return is_text ? Json(diff::unified_diff(name, before, after)) : Json(nullptr);
}

Json edited_json(const std::vector<AssetEdit>& edits, const EditedAsset& asset, bool dry_run) {
  Json places = Json::array();
  for (const EditedPlace& place : asset.places) {
    places.push_back(place_json(edits[place.edit], place));
  }
  Json files = Json::array();
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    files.push_back({{"file", name},
                     {"diff", text_difference_json(name, file.before, file.after, file.text)},
                     {"keptLayout", file.kept_layout}});
  }
  return {{"dryRun", dry_run}, {"edits", std::move(places)}, {"files", std::move(files)}};
}

}  // namespace tenon
