// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/authoring/author_asset.h"
#include "tenon/asset/edit_asset.h"

namespace tenon {

/// What edits did, or with `dry_run` would do: {"dryRun", "written", "edits": [{"object", "api",
/// "file", "line", "spec", "why", "before", "after", "metadata", "mesh", "variants", "hasEffect"}],
/// "physics": [{"variant", "differences": rows of answers::difference_json}], "files": [{"file",
/// "diff", "keptLayout"}]}. "written": that the files are to be written, which an edit without
/// effect is not, and a dry run neither; the exit code is 1 for a missing layer, too. "diff" is
/// null for what is no text, "variant" where there is no set "Physics", "metadata" (the name of one
/// of the stage) and "mesh" (where a shape comes from) for all other edits.
answers::Json edited_json(const std::vector<AssetEdit>& edits, const EditedAsset& asset,
                          bool dry_run);

/// What was made by new_asset: {"file", "upAxis", "metersPerUnit", "kilogramsPerUnit",
/// "defaultPrim", "timeCodesPerSecond", "startTimeCode", "endTimeCode"}; null: not written.
answers::Json new_json(const std::string& file, const NewAsset& made);

/// The difference of a text as JSON, as patch(1) reads it; null for what is no text.
answers::Json text_difference_json(const std::string& name, const std::string& before,
                                   const std::string& after, bool is_text);

}  // namespace tenon
