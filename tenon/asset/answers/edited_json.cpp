// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/answers/edited_json.h"

#include <algorithm>
#include <utility>

#include "tenon/answers/difference_json.h"
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
  row["metadata"] = or_null(edit.field);
  row["variants"] = place.variants;
  row["mesh"] = edit.mesh == nullptr ? Json(nullptr) : Json(edit.mesh->about);
  return row;
}

Json physics_json(const EditedAsset& asset) {
  Json effects = Json::array();
  for (const PhysicsEffect& effect : asset.physics) {
    Json rows = Json::array();
    for (const scene::SceneDifference& difference : effect.differences) {
      rows.push_back(answers::difference_json(difference));
    }
    effects.push_back({{"variant", or_null(effect.variant)}, {"differences", std::move(rows)}});
  }
  return effects;
}

}  // namespace

Json text_difference_json(const std::string& name, const std::string& before,
                          const std::string& after, bool is_text) {
  return is_text ? Json(diff::unified_diff(name, before, after)) : Json(nullptr);
}

Json new_json(const std::string& file, const NewAsset& made) {
  const auto number = [](double value) { return Json(value); };
  return {{"file", shown_path(file)},
          {"timeCodesPerSecond", or_null(made.time_codes_per_second, number)},
          {"startTimeCode", or_null(made.start_time_code, number)},
          {"endTimeCode", or_null(made.end_time_code, number)},
          {"upAxis", made.up_axis},
          {"metersPerUnit", made.meters_per_unit},
          {"kilogramsPerUnit", made.kilograms_per_unit},
          {"defaultPrim", made.default_prim}};
}

Json edited_json(const std::vector<AssetEdit>& edits, const EditedAsset& asset, bool dry_run) {
  Json places = Json::array();
  for (const EditedPlace& place : asset.places) {
    Json row = place_json(edits[place.edit], place);
    row["hasEffect"] = std::find(asset.without_effect.begin(), asset.without_effect.end(),
                                 place.edit) == asset.without_effect.end();
    places.push_back(std::move(row));
  }
  Json files = Json::array();
  for (const EditedFile& file : asset.files) {
    const std::string name = shown_path(file.path);
    files.push_back({{"file", name},
                     {"diff", text_difference_json(name, file.before, file.after, file.text)},
                     {"keptLayout", file.kept_layout}});
  }
  return {{"dryRun", dry_run},
          {"written", !dry_run && asset.without_effect.empty() && !asset.files.empty()},
          {"edits", std::move(places)},
          {"physics", physics_json(asset)},
          {"files", std::move(files)}};
}

}  // namespace tenon
